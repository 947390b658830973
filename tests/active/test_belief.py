import numpy as np

from ial.active.robot import Drive
from ial.pose import Pose
from tests.active.scenes import belief, robot, room


def test_it_holds_the_truth_and_its_groups_lie_in_the_set() -> None:
    grid = room()
    known, driving = belief(grid), robot(grid, Pose(1.5, 1.0, 0.3))
    assert (known.status, known.bad_part, known.range_m, known.view) == ("blind", 0.0, 0.0, None)
    known.update(None, driving.look())
    for _ in range(4):
        driven = driving.drive(Drive(0.2, 0.4))
        estimate = known.update(driven.motion, driven.reading)
        assert estimate.poses.contains(grid.pose_to_grid(driving.pose))
        groups = known.groups()
        for pose, row in zip(groups.poses, range(len(groups)), strict=True):
            assert known.poses.contain(pose).any()
            assert groups.hulls.contain(pose)[row]
    assert known.range_m == 4.0
    assert 0.0 < known.bad_part < 0.5
    there = Pose(1.5, 1.0, 0.3) @ known.moved
    assert np.hypot(there.x - driving.pose.x, there.y - driving.pose.y) < 0.2


def test_of_many_groups_some_of_every_part_are_left() -> None:
    grid = room()
    known = belief(grid)
    known.update(None, robot(grid, Pose(1.5, 1.0, 0.3)).look())
    every, few = known.groups(0.02, 10_000), known.groups(0.02, 8)
    assert len(few) == min(8, len(every))
    assert set(few.component.tolist()) == set(every.component.tolist())
