from pathlib import Path

import pytest

from ial.results.bouncing.basin_picture import draw_basins
from ial.results.bouncing.ground import BRIGHT
from tests.results.bouncing.drawn_filter import built, pixels, read


def test_periodic_cells_have_the_full_colour_of_their_group(tmp_path: Path) -> None:
    _, grounds, maps = built(["room"])
    draw_basins(tmp_path / "a.png", maps, grounds)
    assert pixels(read(tmp_path / "a.png"), BRIGHT[0]) > 1000


@pytest.mark.slow
@pytest.mark.parametrize("headings", [4, 24])
def test_basins_of_several_environments_and_of_merged_headings(tmp_path: Path, headings: int) -> None:
    _, grounds, maps = built(["room", "nook"], headings)
    draw_basins(tmp_path / "a.png", maps, grounds)
    image = read(tmp_path / "a.png")
    assert min(pixels(image, BRIGHT[0]), pixels(image, BRIGHT[1])) > 500
