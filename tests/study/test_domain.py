import numpy as np
import pytest

from ial.lidar.configuration.config import LocalizerConfig
from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, UNKNOWN, OccupancyGrid
from ial.study.domain import Domain
from ial.study.obstacles import Obstacles


def holds(*points: tuple[float, float], radius: float = 0.0, unknown: bool = False) -> list[bool]:
    cells = np.full((10, 10), FREE, dtype=np.uint8)
    cells[:, 0] = OCCUPIED
    cells[9, 9] = UNKNOWN
    grid = OccupancyGrid(cells, 0.5)
    config = LocalizerConfig(domain="free_or_unknown" if unknown else "free", robot_radius_m=radius)
    return [bool(each) for each in Domain(grid, config, Obstacles(grid)).holds(np.array(points))]


def test_free_cells_hold_the_robot() -> None:
    assert holds((0.75, 1.0), (1.0, 1.0), (0.25, 1.0), (-0.25, 1.0), (5.25, 1.0), (1.0, 5.25)) == [True, True, *[False] * 4]


def test_an_edge_with_an_occupied_cell_is_not_certain() -> None:
    assert holds((0.5, 1.0), (0.5 + 1e-8, 1.0), (0.5 - 1e-8, 1.0)) == [False, True, False]


@pytest.mark.parametrize("unknown", [False, True])
def test_unknown_cells_belong_to_it_on_request(unknown: bool) -> None:
    assert holds((4.75, 4.75), unknown=unknown) == [unknown]


def test_a_cell_without_room_anywhere_is_left_out() -> None:
    """The walls' cells end at 0.5 m: from the next cell they are at most 0.5 m away, from the one behind it at most 1 m."""
    points = ((0.51, 1.0), (1.01, 1.0))
    assert holds(*points, radius=0.49) == [True, True]
    assert holds(*points, radius=0.51) == [False, True]
    assert holds(*points, radius=1.01) == [False, False]
