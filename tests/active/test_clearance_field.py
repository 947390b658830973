import numpy as np
import pytest

from ial.active.clearance_field import ClearanceField
from ial.errors import MapError
from tests.active.scenes import distance_to_walls, room


def test_it_is_a_lower_bound_and_a_close_one() -> None:
    grid = room()
    field = ClearanceField.of(grid, 0.2)
    random = np.random.default_rng(0)
    for x, y in random.uniform([0.0, 0.0], [6.0, 4.0], (400, 2)).tolist():
        exact = distance_to_walls(grid, x, y)
        bound = float(field.at(x, y))
        assert bound <= exact + 1e-12
        assert exact <= bound + 2.0**0.5 * field.place_m + 1e-9


def test_outside_there_is_none() -> None:
    field = ClearanceField.of(room(), 0.2)
    assert field.at([-0.1, 7.0, 3.0], [1.0, 1.0, 9.0]).tolist() == [0.0, 0.0, 0.0]


def test_the_border_of_a_map_is_no_way_out() -> None:
    grid = room()
    cells = grid.cells.copy()
    cells[:, 0] = cells[2, 2]  # free up to the border
    field = ClearanceField.of(type(grid)(cells, grid.resolution), 0.2)
    assert float(field.at(0.01, 2.0)) <= 0.01


def test_a_robot_that_fits_nowhere_is_refused() -> None:
    with pytest.raises(MapError, match="no free space for a robot that keeps 3 m"):
        ClearanceField.of(room(), 3.0)
