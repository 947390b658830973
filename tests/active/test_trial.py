import pytest

from ial.active.planners.random_walk import RandomPlanner
from ial.active.planners.two_stage import TwoStagePlanner
from ial.active.trial import Trial, revisited
from ial.maps.grids.alike_plans import alike_plan
from ial.pose import Pose
from tests.active.scenes import belief, robot, room


def test_coming_back_is_counted_by_cells() -> None:
    there = [Pose(0.25, 0.25), Pose(2.25, 0.25)]
    assert revisited(there, 0.5) == 0
    assert revisited([*there, there[0]], 0.5) == 4
    assert revisited([*there, there[0], there[1]], 0.5) == 8
    assert revisited([there[0], Pose(0.25, 0.25, 1.0)], 0.5) == 0, "turning is no coming back"
    assert revisited([there[0]], 0.5) == 0


@pytest.mark.slow
def test_a_trial_counts_what_the_robot_did() -> None:
    grid = alike_plan("rooms")
    start = Pose(7.0, 5.5, 1.0)
    known, driving = belief(grid), robot(grid, start)
    done = Trial.of(known, driving, TwoStagePlanner(known), 50)
    assert (done.ended_by, done.lost, done.collisions) == ("localized", 0, 0)
    assert done.drives == len(driving.path) - 1 > 0
    assert 0.0 < done.way_m <= done.drives * 1.1
    assert done.decided_s is not None
    known, driving = belief(grid), robot(grid, start)
    done = Trial.of(known, driving, RandomPlanner(), 1)
    assert (done.ended_by, done.drives) == ("drives", 1)


def test_a_trial_without_a_decision() -> None:
    grid = room()
    known = belief(grid)
    done = Trial.of(known, robot(grid, Pose(1.5, 1.0, 0.3)), RandomPlanner(), 0)
    assert (done.drives, done.way_m, done.revisited, done.decided_s) == (0, 0.0, 0, None)
