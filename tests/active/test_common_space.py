import math
from itertools import pairwise

import numpy as np

from ial.active.belief import Groups
from ial.active.clearance_field import ClearanceField
from ial.active.common_space import CommonSpace, in_robot_frame, moved_along
from ial.active.safe_way import Distances
from ial.contractors.boxes import Boxes
from ial.pose import Pose
from tests.active.scenes import CLEARANCE_M, RADIUS_M, room

GRID = room()
FIELD = ClearanceField.of(GRID, CLEARANCE_M)
KEPT = Distances(RADIUS_M, CLEARANCE_M)


def space(*poses: tuple[float, float, float]) -> CommonSpace:
    at = np.array(poses)
    return CommonSpace(at[0], Groups(at, Boxes.around(at, [0.01, 0.01, 0.01]), np.arange(len(at))), FIELD, KEPT, 0.25)


def test_a_way_leads_around_a_pillar_and_keeps_the_radius() -> None:
    made = space((2.0, 1.7, 0.0))
    place = made.nearest(4.5, 1.7, 0.3)
    assert place is not None
    path = [(2.0, 1.7), *made.path(place)]
    assert math.dist(path[-1], (4.5, 1.7)) < 0.3
    assert all(math.dist(one, other) < 0.6 for one, other in pairwise(path))
    assert (FIELD.at(*np.array(path[1:]).T) >= RADIUS_M).all()


def test_with_a_second_pose_only_what_is_free_for_both_is_left() -> None:
    one, both = space((2.0, 1.0, 0.0)), space((2.0, 1.0, 0.0), (4.5, 1.0, 0.0))
    assert one.nearest(5.3, 1.0, 0.3) is not None
    assert both.nearest(5.3, 1.0, 0.3) is None, "that would be outside of the room"
    place = both.nearest(2.7, 1.0, 0.3)
    assert place is not None
    assert both.cost_m(place) >= math.dist(both.point(place), (2.0, 1.0)) - 0.25
    assert len(both.views(1)) < len(one.views(1))


def test_frames() -> None:
    pose = Pose(1.0, 2.0, 0.5 * math.pi)
    ((ahead, aside),) = in_robot_frame(pose, [(1.0, 3.0)])
    assert np.allclose([ahead, aside], [1.0, 0.0])
    moved = moved_along(np.array([[1.0, 2.0, 0.5 * math.pi]]), [1.0, 0.0], [0.5, 0.0])
    assert np.allclose(moved, [[[0.5, 3.0, 0.5 * math.pi]], [[1.0, 2.0, 0.5 * math.pi]]])


def test_towards_what_cannot_be_reached_it_comes_as_near_as_it_can() -> None:
    both = space((2.0, 1.0, 0.0), (4.5, 1.0, 0.0))
    place = both.towards(5.3, 1.0)
    assert place is not None
    near = math.dist(both.point(place), (5.3, 1.0))
    assert near > 0.5
    assert near <= min(math.dist(both.point(each), (5.3, 1.0)) for each in both.views(1)) + 0.5
    assert both.towards(20.0, 1.0) is None
