"""Tests of random walks."""

import math

import numpy as np
import pytest

from ial.datasets.walk import random_walk
from ial.errors import MapError
from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, OccupancyGrid
from ial.pose import Pose


def _grid() -> OccupancyGrid:
    cells = np.full((40, 60), OCCUPIED, dtype=np.uint8)
    cells[5:35, 5:55] = FREE
    cells[15:25, 20:30] = OCCUPIED
    return OccupancyGrid(cells, 0.1, Pose(2.0, -1.0, 1.0))


def test_a_walk_keeps_clear_of_walls_and_within_its_steps() -> None:
    grid = _grid()
    walls = (np.argwhere(grid.mask(OCCUPIED)) + 0.5) * grid.resolution
    for seed in range(5):
        path = random_walk(grid, 200, seed, step_m=0.2, turn_rad=0.3, clearance_m=0.3)
        assert len(path) == 200
        for before, after in zip([path[0], *path], path, strict=False):
            step = before.inverse() @ after
            assert math.hypot(step.x, step.y) <= 0.2 + 1e-9
            assert abs(step.theta) <= 0.3 + 1e-9
            at = grid.origin.inverse() @ after
            assert np.hypot(walls[:, 0] - at.y, walls[:, 1] - at.x).min() > 0.3 - grid.resolution
        assert math.dist((path[0].x, path[0].y), (path[-1].x, path[-1].y)) > 0.0


def test_the_seed_decides() -> None:
    assert random_walk(_grid(), 20, 1) == random_walk(_grid(), 20, 1)
    assert random_walk(_grid(), 20, 1) != random_walk(_grid(), 20, 2)


def test_a_narrow_map_lowers_the_clearance() -> None:
    cells = np.full((5, 30), OCCUPIED, dtype=np.uint8)
    cells[2, 1:29] = FREE
    assert len(random_walk(OccupancyGrid(cells, 0.1), 50, 3, clearance_m=1.0)) == 50


def test_a_map_without_free_cells_is_refused() -> None:
    with pytest.raises(MapError, match="no cell of the map is free"):
        random_walk(OccupancyGrid(np.ones((3, 3), dtype=np.uint8), 0.1), 5, 1)
