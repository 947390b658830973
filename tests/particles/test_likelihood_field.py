import math

import numpy as np
import pytest

from ial.errors import ConfigError
from ial.maps.grids.occupancy_grid import OCCUPIED, UNKNOWN, OccupancyGrid
from ial.particles.likelihood_field import BeamModel, LikelihoodField, score


def small_map(random: np.random.Generator) -> OccupancyGrid:
    cells = np.where(random.random((23, 31)) < 0.05, OCCUPIED, UNKNOWN).astype(np.uint8)
    cells[3, 4] = OCCUPIED
    return OccupancyGrid(cells, 0.1)


def plain_score(grid: OccupancyGrid, model: BeamModel, x: float, y: float, ends: np.ndarray) -> float:
    """The definition, beam by beam; lengths in cells."""
    occupied = np.argwhere(grid.cells == OCCUPIED)
    total = 0.0
    for dx, dy in ends.T:
        column, row = math.floor(x + dx), math.floor(y + dy)
        distance = model.laser_likelihood_max_dist
        if 0 <= column < grid.columns and 0 <= row < grid.rows:
            nearest = min(math.hypot(row - other_row, column - other_column) for other_row, other_column in occupied)
            distance = min(distance, nearest * grid.resolution)
        hit = model.z_hit * math.exp(-(distance**2) / (2.0 * model.sigma_hit**2))
        total += math.log(hit + model.z_rand / model.laser_max_range)
    return total / ends.shape[1]


def test_the_score_of_a_pose_is_that_of_the_definition() -> None:
    random = np.random.default_rng(1)
    grid, model = small_map(random), BeamModel(z_hit=0.9, z_rand=0.1, sigma_hit=0.15, laser_likelihood_max_dist=0.7)
    field = LikelihoodField(grid, model)
    for _ in range(50):
        x, y = random.uniform(-3.0, 34.0, 2)
        ends = random.uniform(-20.0, 20.0, (2, 40))
        ours = score(field.table, np.float32(x), np.float32(y), ends.astype(np.float32), np.empty(40, dtype=np.int32))
        assert ours == pytest.approx(plain_score(grid, model, x, y, ends), abs=1e-5)


def test_end_points_far_outside_count_as_the_largest_distance() -> None:
    grid, model = small_map(np.random.default_rng(2)), BeamModel()
    table, room = LikelihoodField(grid, model).table, np.empty(1, dtype=np.int32)
    for end in ((1e6, 1.0), (-1e6, 1.0), (1.0, 1e6), (1.0, -1e6)):
        ours = score(table, np.float32(5.0), np.float32(5.0), np.array([end], dtype=np.float32).T, room)
        assert ours == pytest.approx(float(model.term(2.0)), abs=1e-6)


@pytest.mark.parametrize("name", ["z_hit", "z_rand", "sigma_hit", "laser_likelihood_max_dist", "laser_max_range", "max_beams"])
@pytest.mark.parametrize("value", [0, -1, math.nan, math.inf])
def test_a_number_that_makes_no_likelihood_is_refused(name: str, value: float) -> None:
    with pytest.raises(ConfigError, match=name):
        BeamModel(**{name: value})
