import dataclasses

import numpy as np
import pytest

from ial.active.belief import Belief
from ial.active.decision import Planner
from ial.active.exploration import explore
from ial.active.planners.entropy import EntropyPlanner, TargetPlanner
from ial.active.planners.nearest_frontier import NearestFrontierPlanner
from ial.active.planners.random_walk import RandomPlanner
from ial.active.planners.two_stage import Options, TwoStagePlanner
from ial.datasets.walk import random_walk
from ial.errors import ConfigError
from ial.maps.grids.alike_plans import alike_plan
from ial.pose import Pose
from tests.active.scenes import LIDAR, belief, robot, room


def planner(name: str, known: Belief) -> Planner[Belief]:
    if name in ("direction", "guaranteed"):
        return TwoStagePlanner(known, Options(guaranteed=name == "guaranteed"))
    if name == "entropy":
        return EntropyPlanner(known)
    if name == "target":
        return TargetPlanner(known)
    return RandomPlanner() if name == "random" else NearestFrontierPlanner(known)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["direction", "guaranteed", "entropy", "target", "random", "frontier"])
@pytest.mark.parametrize("plan", ["rooms", "detached"])
def test_the_truth_is_never_lost_and_nothing_is_touched(name: str, plan: str) -> None:
    grid = alike_plan(plan)
    ends = set()
    for seed in range(2):
        known, driving = belief(grid), robot(grid, random_walk(grid, 1, seed, clearance_m=0.5)[0], seed, adversarial=seed == 1)
        for step in explore(known, driving, planner(name, known), 25):
            assert step.estimate.poses.contains(grid.pose_to_grid(driving.pose))
            assert not step.collided
        ends.add(step.estimate.status)
    assert driving.collisions == 0
    if name == "direction":
        assert ends == {"localized"}


@pytest.mark.slow
def test_where_the_map_is_symmetric_that_is_said() -> None:
    grid = alike_plan("ring")
    for seed in range(2):
        known, driving = belief(grid), robot(grid, random_walk(grid, 1, seed, clearance_m=0.5)[0], seed)
        *_, last = explore(known, driving, TwoStagePlanner(known), 60)
        assert last.estimate.status == "symmetric"


def test_it_ends_where_nothing_is_safe() -> None:
    grid = room()
    known, driving = belief(grid), robot(grid, Pose(1.5, 1.0, 0.0))
    known.update(None, driving.look())
    known.safe_ways = lambda turns, most: np.full(len(turns), -1.0)  # type: ignore[method-assign]
    decision = RandomPlanner().choose(known)
    assert decision.drive is None
    assert decision.stage == "exhausted"


def test_what_cannot_be_explored() -> None:
    grid = room()
    known, driving = belief(grid), robot(grid, Pose(1.5, 1.0, 0.0))
    with pytest.raises(ConfigError, match="at most -1 drives"):
        next(explore(known, driving, RandomPlanner(), -1))
    driving.lidar = dataclasses.replace(LIDAR, range_min=20.0, range_max=30.0)  # nothing is so far away
    with pytest.raises(ConfigError, match="no usable beam"):
        next(explore(known, driving, RandomPlanner()))
