import dataclasses

import numpy as np
import pytest

from ial.active.belief import Belief
from ial.active.robot import Drive
from ial.lidar.localizer import Localizer
from ial.maps.grids.occupancy_grid import OCCUPIED, OccupancyGrid
from ial.pose import Pose
from tests.active.scenes import LONGEST_S, RADIUS_M, belief, config, distance_to_walls, robot, room


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


@pytest.mark.parametrize("seed", range(3))
def test_what_is_stopped_by_something_keeps_its_radius_only_and_the_set_holds_it(seed: int) -> None:
    grid = room()
    cells = grid.cells.copy()
    cells[18:21, 4:6] = OCCUPIED  # nothing in the map shows it
    world = OccupancyGrid(cells, 0.05)
    known = Belief(Localizer(grid, config=dataclasses.replace(config(0.7), outliers=14)), RADIUS_M, LONGEST_S)
    driving = robot(world, Pose(1.4, 1.0, np.pi), seed)
    known.update(None, driving.look())
    driven = driving.drive(Drive(0.0, 1.0))
    assert driven.collided
    estimate = known.update(driven.motion, driven.reading, collided=driven.collided)
    assert estimate.poses.contains(grid.pose_to_grid(driving.pose))
    near = min(distance_to_walls(grid, *middle) for middle in known.poses.midpoint()[:, :2].tolist())
    assert RADIUS_M - 0.1 < near < 0.7, "it may have been stopped before it had its clearance again"
    assert distance_to_walls(grid, driving.pose.x, driving.pose.y) < 0.6, "a set that kept the clearance would not hold it"
    assert known.distances.now_m == RADIUS_M, "ways are judged for poses that keep no more than that"
    straight, along, back = known.safe_ways([0.0, 0.5 * np.pi, np.pi], 0.8).tolist()
    assert straight < 0.05, "it would run into the same thing"
    assert along == -1.0, "along the wall it has not its clearance"
    if back < 0.0:  # the set is too large to know that
        assert seed
        return
    driven = driving.drive(Drive(np.pi, back))
    assert not driven.collided
    estimate = known.update(driven.motion, driven.reading)
    assert estimate.poses.contains(grid.pose_to_grid(driving.pose))
    assert known.localizer.config.robot_radius_m == 0.7
    assert known.distances.now_m is None
