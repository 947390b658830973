import math

import numpy as np
import pytest

from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, UNKNOWN, OccupancyGrid
from ial.maps.grids.symmetry import symmetries
from ial.pose import Pose

ORIGIN = Pose(12.0, -5.0, 0.7)


def hall(turns: int, feature: bool = False) -> OccupancyGrid:
    """Return a hall of 8 m a side with pillars that looks the same after each of so many turns; a feature in a corner breaks that."""
    cells = np.full((160, 160), FREE, dtype=np.uint8)
    cells[[0, -1], :] = cells[:, [0, -1]] = OCCUPIED
    pillars = np.zeros((160, 160), dtype=np.bool_)
    pillars[30:44, 50:58] = pillars[60:64, 20:40] = pillars[100:104, 20:24] = True
    for quarters in range(0, 4, 4 // turns):
        cells[np.rot90(pillars, quarters)] = OCCUPIED
    if feature:
        cells[120:140, 1:20] = OCCUPIED
    return OccupancyGrid(cells, 0.05, ORIGIN)


def symmetries_of(grid: OccupancyGrid) -> tuple[Pose, ...]:
    return symmetries(grid, (FREE,))


@pytest.mark.parametrize("turns", [1, 2, 4])
def test_quarter_turns_are_found_and_map_walls_onto_walls(turns: int) -> None:
    grid = hall(turns)
    symmetries = symmetries_of(grid)
    assert len(symmetries) == turns - 1
    rows, columns = np.nonzero(grid.mask(OCCUPIED))
    for turn in symmetries:
        for row, column in zip(rows[::97].tolist(), columns[::97].tolist(), strict=True):
            at = turn @ Pose((column + 0.5) * 0.05, (row + 0.5) * 0.05)
            assert grid.mask(OCCUPIED)[math.floor(at.y / 0.05), math.floor(at.x / 0.05)]


def test_a_feature_anywhere_or_an_empty_map_has_no_symmetry() -> None:
    assert symmetries_of(hall(4, feature=True)) == ()
    assert symmetries_of(OccupancyGrid(np.full((5, 7), UNKNOWN, dtype=np.uint8), 0.1)) == ()


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
        symmetries = symmetries_of(grid)
        assert [each.theta % (2.0 * math.pi) for each in symmetries] == pytest.approx(expected)
        numbers.add(len(symmetries))
    assert numbers == {0, 1, 3}
