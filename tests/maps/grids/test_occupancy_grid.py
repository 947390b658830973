"""The occupancy grid: what it refuses, its classes, and its two frames."""

import json
import math

import numpy as np
import pytest

from ial.contractors.boxes import Boxes
from ial.errors import MapError
from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, UNKNOWN, OccupancyGrid, check_usable
from ial.pose import Pose

CELLS = np.array([[0, 1, 2], [0, 0, 1]], dtype=np.uint8)


def test_size_is_that_of_the_cells() -> None:
    grid = OccupancyGrid(CELLS, 0.5)
    assert (grid.rows, grid.columns, grid.width_m, grid.height_m) == (2, 3, 1.5, 1.0)


def test_cells_cannot_be_changed_and_the_array_given_still_can() -> None:
    cells = CELLS.copy()
    grid = OccupancyGrid(cells, 0.5)
    with pytest.raises(ValueError, match="read-only"):
        grid.cells[0, 0] = OCCUPIED
    cells[0, 0] = FREE


@pytest.mark.parametrize(
    ("cells", "text"),
    [
        (np.zeros((0, 3), np.uint8), "3 × 0 cells"),
        (np.zeros((3, 0), np.uint8), "0 × 3 cells"),
        (np.zeros(3, np.uint8), "shape"),
        (np.zeros((2, 2), np.int8), "int8"),
        (np.zeros((2, 2), np.bool_), "bool"),
        (np.full((2, 2), 3, np.uint8), "class 3"),
        (np.zeros((1, 2**16 + 1), np.uint8), r"2\*\*16"),
    ],
)
def test_bad_cells_are_refused(cells: np.ndarray, text: str) -> None:
    with pytest.raises(MapError, match=text):
        OccupancyGrid(cells, 0.05)


def test_a_side_of_two_to_the_sixteen_is_accepted() -> None:
    assert OccupancyGrid(np.zeros((1, 2**16), np.uint8), 0.05).columns == 65536


def test_more_cells_than_two_to_the_thirty_are_refused() -> None:
    with pytest.raises(MapError, match=r"2\*\*30"):
        OccupancyGrid(np.broadcast_to(np.uint8(0), (2**16, 2**15)), 0.05)


@pytest.mark.parametrize("resolution", [0.0, -0.0, -0.05, math.nan, math.inf, -math.inf, 1e-9, 1e6])
def test_bad_resolutions_are_refused(resolution: float) -> None:
    with pytest.raises(MapError, match="resolution"):
        OccupancyGrid(CELLS, resolution)


@pytest.mark.parametrize("origin", [Pose(math.nan, 0, 0), Pose(0, math.inf, 0), Pose(0, 0, math.nan)])
def test_bad_origins_are_refused(origin: Pose) -> None:
    with pytest.raises(MapError, match="origin"):
        OccupancyGrid(CELLS, 0.05, origin)


def test_mask_takes_several_classes() -> None:
    grid = OccupancyGrid(CELLS, 0.5)
    assert grid.mask(OCCUPIED).tolist() == [[False, True, False], [False, False, True]]
    assert grid.mask(FREE, UNKNOWN).tolist() == [[True, False, True], [True, True, False]]
    assert not grid.mask().any()
    with pytest.raises(ValueError, match="no class"):
        grid.mask(3)


def test_frames_by_hand() -> None:
    grid = OccupancyGrid(CELLS, 0.5, Pose(10.0, 20.0, math.pi / 2))
    x, y, theta = grid.to_map([1.0, 0.0], [0.0, 2.0], [0.0, math.pi])
    assert np.allclose(x, [10.0, 8.0])
    assert np.allclose(y, [21.0, 20.0])
    assert np.allclose(theta, [math.pi / 2, -math.pi / 2])


def test_frames_are_inverse_to_each_other() -> None:
    grid = OccupancyGrid(CELLS, 0.5, Pose(-3.0, 7.0, 2.5))
    rng = np.random.default_rng(1)
    x, y, theta = rng.uniform(-50, 50, 100), rng.uniform(-50, 50, 100), rng.uniform(-math.pi, math.pi, 100)
    back = grid.to_map(*grid.to_grid(x, y, theta))
    assert np.allclose(back[0], x)
    assert np.allclose(back[1], y)
    assert np.allclose(np.exp(1j * back[2]), np.exp(1j * theta))
    assert (np.abs(back[2]) <= math.pi).all()
    pose = Pose(1.0, 2.0, 3.0)
    there = grid.pose_to_map(grid.pose_to_grid(pose))
    assert (there.x, there.y, there.theta) == pytest.approx((1.0, 2.0, 3.0))


def test_an_unmoved_grid_keeps_every_bit_of_a_pose() -> None:
    grid = OccupancyGrid(CELLS, 0.5)
    pose = Pose(0.1, -1e-300, math.pi)
    assert grid.pose_to_grid(pose) == pose == grid.pose_to_map(pose)


def test_boxes_go_to_the_map_frame_and_back() -> None:
    grid = OccupancyGrid(CELLS, 0.5, Pose(10.0, 20.0, 0.3))
    box = Boxes.of([(1.0, 1.5), (2.0, 2.5), (0.1, 0.2)])
    there = grid.boxes_to_map(box)
    x, y, theta = grid.to_map(1.25, 2.25, 0.15)
    assert there.contain((float(x), float(y), float(theta))).all()
    back = grid.boxes_to_grid(there)
    assert (back.lower <= box.lower).all()
    assert (back.upper >= box.upper).all()


def test_description_can_be_written_as_json_and_adds_up() -> None:
    content = json.loads(json.dumps(OccupancyGrid(CELLS, 0.5, Pose(1, 2, 0.5)).describe()))
    assert content["cells"] == {"free": 3, "occupied": 2, "unknown": 1}
    assert content["area_m2"] == {"free": 0.75, "occupied": 0.5, "unknown": 0.25}
    assert content["origin"] == {"x": 1, "y": 2, "theta": 0.5}
    assert (content["columns"], content["rows"], content["width_m"], content["height_m"], content["resolution_m"]) == (3, 2, 1.5, 1.0, 0.5)


@pytest.mark.parametrize(("value", "text"), [(FREE, "no occupied cell"), (UNKNOWN, "no occupied cell"), (OCCUPIED, "no free cell")])
def test_maps_of_one_class_are_not_usable(value: int, text: str) -> None:
    with pytest.raises(MapError, match=text):
        check_usable(OccupancyGrid(np.full((3, 3), value, np.uint8), 0.05))


def test_unknown_space_can_be_the_domain() -> None:
    grid = OccupancyGrid(np.array([[OCCUPIED, UNKNOWN]], np.uint8), 0.05)
    check_usable(grid, (FREE, UNKNOWN))
    with pytest.raises(MapError, match="no free cell"):
        check_usable(grid)
    check_usable(OccupancyGrid(CELLS, 0.05))
