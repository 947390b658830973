import json
from fractions import Fraction
from pathlib import Path

import cv2
import numpy as np
import pytest

from ial.errors import MapError
from ial.maps.grids.map_file import write_map
from ial.maps.grids.map_warning import MapWarning
from ial.maps.grids.occupancy_grid import OccupancyGrid
from ial.maps.polygons.environment import Environment, load_environment
from ial.maps.polygons.wkt import parse_wkt
from ial.pose import Pose

RING = [[0, 0], [8, 0], [8, 4], [0, 4], [0, 0]]
HOLE = [[1, 1], [1, 2], [2, 2], [2, 1], [1, 1]]
WKT = "POLYGON ((0 0, 8 0, 8 4, 0 4, 0 0), (1 1, 1 2, 2 2, 2 1, 1 1))"
GEOJSON = json.dumps({"type": "Polygon", "coordinates": [RING, HOLE]})
CANONICAL = '{"polygons": [{"outer": [["0","0"],["8","0"],["8","4"],["0","4"]], "holes": [[["1","1"],["1","2"],["2","2"],["2","1"]]]}]}'
SVG = '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0,0 H8 V-4 h-8 Z M1-1 l0-1 1 0 0 1z"/></svg>'


@pytest.mark.parametrize(
    ("name", "text"), [("a.wkt", WKT), ("a.geojson", GEOJSON), ("a.json", CANONICAL), ("a.svg", SVG)], ids=lambda value: value[:6]
)
def test_the_same_environment_in_every_format(name: str, text: str, tmp_path: Path) -> None:
    path = tmp_path / name
    path.write_text(text)
    environment = load_environment(path)
    assert environment.area == 31
    assert environment.bounds == (0, 0, 8, 4)
    assert environment.polygons == parse_wkt(WKT)


def test_the_free_cells_of_a_map_are_the_environment(tmp_path: Path) -> None:
    cells = np.zeros((5, 7), dtype=np.uint8)
    cells[2, 3] = 1
    cells[0, 0] = 2
    write_map(OccupancyGrid(cells, 0.05), tmp_path / "map.yaml")
    environment = load_environment(tmp_path / "map.yaml")
    assert environment.cell == Fraction(1, 20)
    assert environment.area == Fraction(33, 400)
    assert environment.bounds == (0, 0, Fraction(7, 20), Fraction(1, 4))


def test_places_are_in_the_map_frame_unless_the_grid_is_turned_in_it(tmp_path: Path) -> None:
    cells = np.zeros((5, 7), dtype=np.uint8)
    write_map(OccupancyGrid(cells, 0.05, Pose(-1.5, 2.25)), tmp_path / "map.yaml")
    assert load_environment(tmp_path / "map.yaml").bounds == (Fraction(-3, 2), Fraction(9, 4), Fraction(-23, 20), Fraction(5, 2))
    write_map(OccupancyGrid(cells, 0.05, Pose(-1.5, 2.25, 0.5)), tmp_path / "turned.yaml")
    with pytest.warns(MapWarning, match=r"turned by 0.5 rad"):
        assert load_environment(tmp_path / "turned.yaml").bounds == (0, 0, Fraction(7, 20), Fraction(1, 4))


def test_files_that_cannot_be_read_are_named(tmp_path: Path) -> None:
    with pytest.raises(MapError, match=r"nowhere\.wkt: the environment cannot be read"):
        load_environment(tmp_path / "nowhere.wkt")
    with pytest.raises(MapError, match=r"a\.xyz: the environment does not exist"):
        load_environment(tmp_path / "a.xyz")
    (tmp_path / "a.xyz").write_text("")
    with pytest.raises(MapError, match=r"a\.xyz: this is no environment"):
        load_environment(tmp_path / "a.xyz")
    (tmp_path / "a.wkt").write_bytes(b"\xff\xfe")
    with pytest.raises(MapError, match="no text in UTF-8"):
        load_environment(tmp_path / "a.wkt")
    (tmp_path / "a.wkt").write_text("POLYGON ((0 0, 1 0))")
    with pytest.raises(MapError, match=r"a\.wkt: the ring at token 3 is open"):
        load_environment(tmp_path / "a.wkt")
    (tmp_path / "a.json").write_text('{"polygons": []}')
    with pytest.raises(MapError, match="no free space"):
        load_environment(tmp_path / "a.json")
    with pytest.raises(MapError, match="no free space"):
        Environment(())


def test_a_picture_is_an_environment_whose_pixels_are_so_wide(tmp_path: Path) -> None:
    pixels = np.full((3, 4), 255, dtype=np.uint8)
    pixels[0, 0] = 0  # the upper left corner is a wall
    cv2.imwrite(str(tmp_path / "plan.png"), pixels)
    for resolution in ("1/3", Fraction(1, 3)):
        environment = load_environment(tmp_path / "plan.png", resolution=resolution)
        assert (environment.cell, environment.bounds, environment.area) == (Fraction(1, 3), (0, 0, Fraction(4, 3), 1), Fraction(11, 9))
        assert (Fraction(1, 3), Fraction(2, 3)) in environment.polygons[0].outer
        assert (0, 1) not in environment.polygons[0].outer
    assert load_environment(tmp_path / "plan.png", 0.05).cell == Fraction(1, 20)


def test_a_picture_needs_a_resolution_and_nothing_else_takes_one(tmp_path: Path) -> None:
    cv2.imwrite(str(tmp_path / "plan.png"), np.full((3, 4), 255, dtype=np.uint8))
    cv2.imwrite(str(tmp_path / "dark.png"), np.zeros((3, 4), dtype=np.uint8))
    write_map(OccupancyGrid(np.zeros((5, 7), dtype=np.uint8), 0.05), tmp_path / "map.yaml")
    (tmp_path / "a.wkt").write_text(WKT)
    with pytest.raises(MapError, match=r"plan\.png: .*the width of a pixel in metres \(--resolution\)"):
        load_environment(tmp_path / "plan.png")
    for name in ("a.wkt", "map.yaml"):
        with pytest.raises(MapError, match=r"give a resolution for a picture \(\.png"):
            load_environment(tmp_path / name, "0.05")
    for wrong, message in (
        ("wide", "no number"),
        ("0", "the resolution is 0"),
        ("1e999", "the resolution: '1e999' is too large"),
        (float("nan"), "no number"),
    ):
        with pytest.raises(MapError, match=message):
            load_environment(tmp_path / "plan.png", wrong)
    with pytest.raises(MapError, match=r"dark\.png: no cell of the grid is free"):
        load_environment(tmp_path / "dark.png", 1.0)
