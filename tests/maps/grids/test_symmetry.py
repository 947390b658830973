import math

import numpy as np
import pytest

from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, UNKNOWN, OccupancyGrid
from ial.maps.grids.symmetry import symmetries


def test_the_rotations_are_those_of_the_turned_arrays() -> None:
    random = np.random.default_rng(1)
    numbers = set()
    for _ in range(300):
        side, other = random.integers(1, 5, 2)
        shape = (side, side if random.random() < 0.7 else other)
        part = random.choice([FREE, OCCUPIED, UNKNOWN], shape, p=[0.4, 0.4, 0.2]).astype(np.uint8)
        if random.random() < 0.5:
            part = np.concatenate([part, np.rot90(part, 2)], axis=int(random.integers(2)))
        cells = np.full((part.shape[0] + 3, part.shape[1] + 2), UNKNOWN, dtype=np.uint8)
        cells[1:-2, 1:-1] = part
        grid = OccupancyGrid(cells, 1.0)
        rows, columns = (np.flatnonzero((cells != UNKNOWN).any(axis=axis)) for axis in (1, 0))
        expected: list[float] = []
        if len(rows):
            inner = cells[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]
            expected = [0.5 * math.pi * turns for turns in (1, 2, 3) if np.array_equal(np.rot90(inner, turns), inner)]
        rotations = symmetries(grid, (FREE,))
        assert [each.theta % (2.0 * math.pi) for each in rotations] == pytest.approx(expected)
        numbers.add(len(rotations))
    assert numbers == {0, 1, 3}
