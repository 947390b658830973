from pathlib import Path

import pytest

from ial.errors import OutputError
from ial.results.bouncing.cycle_picture import draw_cycles
from ial.results.bouncing.ground import BRIGHT, BounceGround
from ial.results.palette import UNKNOWN
from tests.results.bouncing.drawn_filter import built, pixels, read


def test_cycles_are_drawn_on_every_environment_they_are_in(tmp_path: Path) -> None:
    made, grounds, _ = built(["room", "nook"])
    draw_cycles(tmp_path / "a.png", made, grounds)
    image = read(tmp_path / "a.png")
    assert pixels(image, BRIGHT[0]) + pixels(image, "#c1121f") > 200
    assert pixels(image, "#4a5058") > 1000  # walls
    assert pixels(image, UNKNOWN) < 100  # edges of letters


@pytest.mark.slow
def test_a_filter_without_its_environment_shows_the_cells_it_knows(tmp_path: Path) -> None:
    made, _, _ = built(["room"])
    grounds = BounceGround.of_setting(made.setting, [(made.places.row, made.places.column)])
    assert grounds[0].raster.free[made.places.row, made.places.column].all()
    draw_cycles(tmp_path / "a.png", made, grounds)
    image = read(tmp_path / "a.png")
    assert pixels(image, UNKNOWN) > 1000
    assert pixels(image, "#4a5058") == 0


def test_a_folder_that_does_not_exist(tmp_path: Path) -> None:
    made, grounds, _ = built(["room"])
    with pytest.raises(OutputError, match="cannot be written"):
        draw_cycles(tmp_path / "nowhere" / "a.png", made, grounds)
