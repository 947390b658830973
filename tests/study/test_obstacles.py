import numpy as np
import pytest

from ial.maps.grids.occupancy_grid import OCCUPIED, OccupancyGrid
from ial.study.obstacles import Obstacles


def test_distances_are_those_to_closed_cells() -> None:
    random = np.random.default_rng(5)
    cells = (random.random((20, 30)) < 0.05).astype(np.uint8) * OCCUPIED
    grid = OccupancyGrid(cells, 0.1)
    points = random.uniform(-0.5, 3.5, (300, 2))
    occupied = np.argwhere(cells == OCCUPIED)[:, ::-1] * 0.1
    aside = np.maximum(np.maximum(occupied - points[:, None], points[:, None] - occupied - 0.1), 0.0)
    expected = np.hypot(aside[..., 0], aside[..., 1]).min(axis=1)
    assert Obstacles(grid).distances(points) == pytest.approx(expected, abs=1e-12)
