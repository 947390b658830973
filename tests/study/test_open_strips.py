import math

import numpy as np
import pytest

from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, OccupancyGrid
from ial.study.obstacles import Obstacles
from ial.study.open_strips import open_strips


def wall(gap: slice) -> Obstacles:
    """A wall of one cell thickness across 4 × 4 m, with a gap."""
    cells = np.full((40, 40), FREE, dtype=np.uint8)
    cells[20, :] = OCCUPIED
    cells[20, gap] = FREE
    return Obstacles(OccupancyGrid(cells, 0.1))


@pytest.mark.parametrize(
    ("x", "length", "aside", "is_open"),
    [
        (2.05, 3.0, 0.0, True),
        (2.05, 3.0, 0.3, True),
        (1.8, 3.0, 0.1, False),
        (1.8, 3.0, 0.19, False),
        (1.8, 3.0, 0.21, True),  # the neighbour 0.2 m to the right goes along the wall's end, the next one passes
        (2.3, 3.0, 0.19, False),
        (2.3, 3.0, 0.21, True),
        (1.8, 1.499, 0.0, True),  # it ends before the wall
        (1.8, 1.501, 0.0, False),
        (1.8, -1.0, 0.0, True),
        (1.8, 0.0, 0.0, True),
    ],
)
@pytest.mark.parametrize("turn", [0.0, math.pi])
def test_a_gap_in_a_wall_is_passed_from_both_sides(x: float, length: float, aside: float, is_open: bool, turn: float) -> None:
    y, angle = (0.5, 0.5 * math.pi) if not turn else (3.6, -0.5 * math.pi)
    answers = open_strips(wall(slice(20, 21)), np.array([[x, y]]), np.array([angle]), np.array([length]), aside)
    assert answers.tolist() == [is_open]


def test_a_ray_that_only_touches_is_not_certainly_free() -> None:
    corner, towards = np.array([[1.0, 0.5]]), np.array([0.5 * math.pi])
    obstacles = wall(slice(0, 10))  # its end is at 1.0 m
    assert open_strips(obstacles, corner, towards, np.array([3.0]), 0.0).tolist() == [False]
    for aside, is_open in ((-1e-8, True), (1e-8, False)):
        start = np.array([[1.0 + aside, 0.5]])
        assert open_strips(obstacles, start, towards, np.array([3.0]), 0.0).tolist() == [is_open]


def test_from_outside_the_map_and_within_a_cell() -> None:
    obstacles = wall(slice(0, 0))
    start = np.array([[2.0, -50.0], [2.0, -50.0], [2.05, 2.05], [-9.0, 2.05]])
    angle, length = np.array([0.5, 0.5, 0.0, 0.5]) * math.pi, np.array([51.9, 52.1, 0.01, 80.0])
    assert open_strips(obstacles, start, angle, length, 0.05).tolist() == [True, False, False, True]
