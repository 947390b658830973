"""Random floor plans: connected, closed, reproducible, different."""

import numpy as np
import pytest

from ial.errors import MapError
from ial.maps.grids.floor_plan import floor_plan
from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, check_usable
from ial.maps.grids.ray_casting import cast_rays

SIZES = [(10.0, 4.7, 0.02), (20.0, 20.0, 0.1), (40.0, 30.0, 0.05), (7.0, 30.0, 0.25), (1.0, 1.0, 0.05)]


@pytest.mark.parametrize(("width", "height", "resolution"), SIZES)
@pytest.mark.parametrize("seed", range(10))
def test_border_is_wall_and_free_space_is_in_one_piece(width: float, height: float, resolution: float, seed: int) -> None:
    import cv2

    grid = floor_plan(width, height, resolution, seed)
    assert (grid.columns, grid.rows) == (round(width / resolution), round(height / resolution))
    assert set(np.unique(grid.cells)) == {FREE, OCCUPIED}
    for side in (grid.cells[0], grid.cells[-1], grid.cells[:, 0], grid.cells[:, -1]):
        assert (side == OCCUPIED).all()
    pieces, _ = cv2.connectedComponents(grid.mask(FREE).view(np.uint8), connectivity=4)
    assert pieces == 2  # what is not free, and what is
    check_usable(grid)


def test_the_seed_decides() -> None:
    plans = [floor_plan(30.0, 30.0, 0.1, seed).cells for seed in (1, 1, 2)]
    assert (plans[0] == plans[1]).all()
    assert (plans[0] != plans[2]).mean() > 0.05


def test_the_share_of_walls_is_that_of_a_building() -> None:
    share = floor_plan(100.0, 100.0, 0.05, 3).mask(OCCUPIED).mean()
    assert 0.05 < share < 0.2


@pytest.mark.many
def test_a_scan_tells_places_apart() -> None:
    grid = floor_plan(60.0, 60.0, 0.05, 4)
    rng = np.random.default_rng(9)
    free = np.argwhere(grid.mask(FREE))
    row, column = free[rng.choice(len(free), 300, replace=False)].T
    angles = np.linspace(-np.pi, np.pi, 90, endpoint=False)
    scans = cast_rays(grid.mask(OCCUPIED), 0.05, (column[:, None] + 0.5) * 0.05, (row[:, None] + 0.5) * 0.05, angles)
    assert np.isfinite(scans).all()
    differences = (np.abs(scans[:, None] - scans) > 0.2).mean(axis=2)
    far = np.hypot(row[:, None] - row, column[:, None] - column) * 0.05 > 2.0
    assert differences[far].min() > 0.2


@pytest.mark.parametrize(
    ("width", "height", "resolution"),
    [(0.5, 10, 0.05), (10, np.nan, 0.05), (np.inf, 10, 0.05), (10, 10, 0.0), (10, 10, 0.5), (1e5, 1e5, 0.05), (10, 10, np.nan)],
)
def test_bad_sizes_are_refused(width: float, height: float, resolution: float) -> None:
    with pytest.raises(MapError):
        floor_plan(width, height, resolution, 0)
