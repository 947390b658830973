import math

import numpy as np
import pytest

from ial.active.contact import Contact
from ial.maps.grids.occupancy_grid import OccupancyGrid
from ial.pose import Pose
from tests.active.scenes import distance_to_walls, room


@pytest.mark.parametrize("radius_m", [0.0, 0.12, 0.4])
def test_a_disk_touches_what_is_nearer_than_its_radius(radius_m: float) -> None:
    grid = room()
    contact = Contact(grid, radius_m)
    random = np.random.default_rng(1)
    touching = 0
    for x, y in random.uniform((-0.5, -0.5), (6.5, 4.5), (400, 2)).tolist():
        away = distance_to_walls(grid, x, y)  # negative outside of the map
        touches = contact.touches(Pose(x, y, 0.3))
        assert touches == (away <= 0.0 or away < radius_m)
        touching += touches
    assert 40 < touching < 390


def test_places_are_those_of_the_map_frame() -> None:
    grid = room()
    turned = OccupancyGrid(grid.cells, grid.resolution, Pose(10.0, -3.0, 0.5 * math.pi))
    contact = Contact(turned, 0.3)
    assert not contact.touches(turned.origin @ Pose(1.0, 1.0, 0.0))
    assert contact.touches(turned.origin @ Pose(0.2, 1.0, 0.0))
    assert contact.touches(Pose(1.0, 1.0, 0.0))


@pytest.mark.parametrize("pose", [Pose(math.nan, 1.0, 0.0), Pose(6.0, 1.0, 0.0), Pose(-1e300, 1.0, 0.0)])
def test_what_is_not_in_the_map_is_not_free(pose: Pose) -> None:
    assert Contact(room(), 0.1).touches(pose)
