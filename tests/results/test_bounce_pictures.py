from fractions import Fraction
from pathlib import Path

import cv2
import numpy as np
import numpy.typing as npt
import pytest

from ial.bouncing.cells.cell_map import CellMap
from ial.bouncing.cells.headings import Headings
from ial.bouncing.filters.bounce_filter import BounceFilter
from ial.bouncing.filters.building import build_filter
from ial.errors import FilterError, OutputError
from ial.maps.polygons.environment import Environment
from ial.maps.polygons.outline import outlines
from ial.maps.polygons.raster import rasterize
from ial.results.bouncing.automaton_picture import MOST_STATES, draw_automaton
from ial.results.bouncing.basin_picture import draw_basins
from ial.results.bouncing.cycle_picture import draw_cycles
from ial.results.bouncing.ground import BRIGHT, BounceGround
from ial.results.palette import UNKNOWN, rgb

Image = npt.NDArray[np.uint8]
ROOM = np.ones((4, 6), dtype=np.bool_)
ROOM[2:, :2] = False
NOOK = np.ones((3, 3), dtype=np.bool_)
ENVIRONMENTS = {name: Environment(outlines(free, Fraction(1)), Fraction(1)) for name, free in (("room", ROOM), ("nook", NOOK))}


def built(names: list[str], headings: int = 4) -> tuple[BounceFilter, list[BounceGround], list[CellMap]]:
    chosen = {name: ENVIRONMENTS[name] for name in names}
    turns = Headings.of_angle(Fraction(90), headings)
    grounds = [BounceGround(name, rasterize(each, Fraction(1))) for name, each in chosen.items()]
    return build_filter(chosen, turns), grounds, [CellMap(ground.raster, turns, merge=True) for ground in grounds]


def read(path: Path) -> Image:
    image = cv2.imread(str(path))
    assert image is not None
    assert list(path.parent.iterdir()) == [path], "no half file is left"
    return image[..., ::-1].astype(np.uint8)


def pixels(image: Image, colour: str) -> int:
    return int((np.abs(image - np.array(rgb(colour)) * 255.0).max(axis=2) < 2.0).sum())


def test_cycles_are_drawn_on_every_environment_they_are_in(tmp_path: Path) -> None:
    made, grounds, _ = built(["room", "nook"])
    draw_cycles(tmp_path / "a.png", made, grounds)
    image = read(tmp_path / "a.png")
    assert pixels(image, BRIGHT[0]) + pixels(image, "#c1121f") > 200
    assert pixels(image, "#4a5058") > 1000  # walls
    assert pixels(image, UNKNOWN) < 100  # edges of letters


def test_a_filter_without_its_environment_shows_the_cells_it_knows(tmp_path: Path) -> None:
    made, _, _ = built(["room"])
    grounds = BounceGround.of_setting(made.setting, [(made.places.row, made.places.column)])
    assert grounds[0].raster.free[made.places.row, made.places.column].all()
    draw_cycles(tmp_path / "a.png", made, grounds)
    image = read(tmp_path / "a.png")
    assert pixels(image, UNKNOWN) > 1000
    assert pixels(image, "#4a5058") == 0


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


@pytest.mark.slow
def test_the_automaton_shows_each_cycle_in_its_colour(tmp_path: Path) -> None:
    made, _, _ = built(["room"])
    draw_automaton(tmp_path / "a.png", made.table, "room")
    image = read(tmp_path / "a.png")
    shown = [pixels(image, colour) > 50 for colour in BRIGHT]
    assert shown == [number < made.table.cycles for number in range(len(BRIGHT))]


def test_an_automaton_that_is_one_cycle(tmp_path: Path) -> None:
    alone = Environment(outlines(np.ones((1, 1), dtype=np.bool_), Fraction(1)), Fraction(1))
    draw_automaton(tmp_path / "a.png", build_filter({"alone": alone}, Headings(4, 1)).table, "alone")
    assert pixels(read(tmp_path / "a.png"), BRIGHT[0]) > 50


def test_a_large_automaton_is_refused(tmp_path: Path) -> None:
    hall = Environment(outlines(np.ones((9, 20), dtype=np.bool_), Fraction(1)), Fraction(1))
    table = build_filter({"hall": hall}, Headings(8, 3)).table
    assert len(table) > MOST_STATES
    with pytest.raises(FilterError, match=f"{len(table) - 1} states, and at most {MOST_STATES}"):
        draw_automaton(tmp_path / "a.png", table, "hall")
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_does_not_exist(tmp_path: Path) -> None:
    made, grounds, _ = built(["room"])
    with pytest.raises(OutputError, match="cannot be written"):
        draw_cycles(tmp_path / "nowhere" / "a.png", made, grounds)
