from pathlib import Path

import matplotlib.image
import pytest

from ial.compass.planning import localizing_sequence
from ial.errors import MapError
from ial.results.bouncing.page import BouncePage
from ial.results.compass.trace_picture import draw_traces
from tests.maps.polygons.known_polygons import L_SHAPE

SEQUENCE = localizing_sequence(L_SHAPE)


@pytest.mark.slow
def test_a_panel_for_each_start_and_every_way_ends_in_one_place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pages: list[BouncePage] = []
    write = BouncePage.write
    monkeypatch.setattr(BouncePage, "write", lambda page, path: (pages.append(page), write(page, path))[1])
    draw_traces(tmp_path / "traces.png", SEQUENCE, L_SHAPE.outer[:3], "L")
    (page,) = pages
    assert len(page.panels) == 3
    for axes, start in zip(page.panels, L_SHAPE.outer, strict=False):
        way = axes.lines[0].get_xydata().tolist()
        assert len(way) == len(SEQUENCE) + 1
        assert way[0] == list(map(float, start))
        assert way[-1] == list(map(float, SEQUENCE.end))
    assert matplotlib.image.imread(tmp_path / "traces.png").std() > 0.05


def test_a_start_outside_is_refused(tmp_path: Path) -> None:
    with pytest.raises(MapError, match="lies outside of the environment"):
        draw_traces(tmp_path / "traces.png", SEQUENCE, [(3, 3)], "L")  # type: ignore[list-item]
    assert not list(tmp_path.iterdir())
