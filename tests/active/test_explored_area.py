import math

import numpy as np

from ial.active.explored_area import ExploredArea, View
from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, OccupancyGrid
from ial.pose import Pose
from tests.active.scenes import room

CELLS = np.full((40, 120), FREE, dtype=np.uint8)
CELLS[[0, -1]] = OCCUPIED
CELLS[:, [0, -1]] = OCCUPIED
CELLS[:25, 60:63] = OCCUPIED  # a wall with a door above it
TWO_ROOMS = OccupancyGrid(CELLS, 0.05)
ALL_AROUND = (-math.pi, math.pi)


def test_what_a_wall_hides_is_not_seen() -> None:
    area = ExploredArea(TWO_ROOMS)
    area.add(View(Pose(0.0, 0.0, 0.0), 10.0, *ALL_AROUND))
    seen = area.seen(Pose(1.0, 0.5, 0.0))
    assert seen[1:25, 1:60].all()
    assert not seen[1:20, 66:].any()
    assert seen[30:38, 58:64].any()
    assert (TWO_ROOMS.cells[seen] == FREE).all()


def test_frontiers_lie_between_what_was_seen_and_what_was_not() -> None:
    area = ExploredArea(TWO_ROOMS)
    area.add(View(Pose(0.0, 0.0, 0.0), 10.0, *ALL_AROUND))
    frontiers = area.frontiers(Pose(1.0, 0.5, 0.0), 4)
    assert len(frontiers) >= 1
    assert all(each.x > 3.0 for each in frontiers), "behind the wall"
    area.add(View(Pose(3.5, 0.0, 0.0), 10.0, *ALL_AROUND))
    assert area.frontiers(Pose(1.0, 0.5, 0.0), 4) == []


def test_a_short_range_and_a_narrow_view_show_less() -> None:
    grid, start = room(), Pose(1.5, 1.0, 0.0)
    views = [View(Pose(0.0, 0.0, 0.0), *each) for each in ((1.0, *ALL_AROUND), (1.0, -0.5, 0.5), (9.0, *ALL_AROUND))]
    near, ahead, far = (ExploredArea(grid, [view]).seen(start) for view in views)
    assert (ahead <= near).all()
    assert (near <= far).all()
    row, column = np.argwhere(ahead).T
    angles = np.arctan2((row + 0.5) * 0.05 - 1.0, (column + 0.5) * 0.05 - 1.5)
    assert np.abs(angles).max() <= 0.5 + 1e-9
    assert near.sum() * 0.05**2 < math.pi


def test_another_start_is_another_area() -> None:
    area = ExploredArea(room(), [View(Pose(0.5, 0.0, 0.0), 1.0, *ALL_AROUND)])
    one, other = area.seen(Pose(1.0, 1.0, 0.0)).copy(), area.seen(Pose(1.0, 1.0, 1.5)).copy()
    assert (one != other).any()
    assert (area.seen(Pose(1.0, 1.0, 0.0)) == one).all()
