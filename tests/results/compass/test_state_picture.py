from pathlib import Path

import matplotlib.image
import pytest

from ial.compass.planning import localizing_sequence
from ial.results.bouncing.page import BouncePage
from ial.results.compass.state_picture import draw_states
from tests.maps.polygons.known_polygons import L_SHAPE


@pytest.mark.slow
def test_a_panel_for_each_information_state(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pages: list[BouncePage] = []
    write = BouncePage.write
    monkeypatch.setattr(BouncePage, "write", lambda page, path: (pages.append(page), write(page, path))[1])
    sequence = localizing_sequence(L_SHAPE)
    draw_states(tmp_path / "states.png", sequence, "L")
    (page,) = pages
    assert len(page.panels) == len(sequence) + 1
    for axes, (pieces, points) in zip(page.panels, sequence.sizes, strict=True):
        *segments, dots = axes.lines
        assert len(segments) == pieces
        assert len(dots.get_xdata()) == points
    assert page.panels[0].get_title(loc="left") == "at first"
    x, y = page.panels[-1].lines[-1].get_data()
    assert (x[0], y[0]) == tuple(map(float, sequence.end))
    assert matplotlib.image.imread(tmp_path / "states.png").std() > 0.05
