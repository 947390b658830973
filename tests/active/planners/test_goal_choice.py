import math

import numpy as np

from ial.active.belief import Belief, Groups
from ial.active.explored_area import ExploredArea
from ial.active.planners.goal_choice import GoalChoice
from ial.active.planners.hops import Hops
from ial.active.planners.known_frontiers import KnownFrontiers
from ial.active.planners.outlook import Outlook
from ial.active.planners.route import Route
from ial.active.simulated_robot import SimulatedRobot
from ial.active.virtual_sensors import VirtualSensors
from ial.contractors.boxes import Boxes
from ial.maps.grids.alike_plans import alike_plan
from ial.maps.grids.occupancy_grid import OccupancyGrid
from ial.pose import Pose
from tests.active.closed_plans import cells_plan
from tests.active.scenes import belief, robot

ROUTE = Route(hops=Hops(0.3))


class Scene:
    """A robot after its first look, and goals for it."""

    def __init__(self, grid: OccupancyGrid, start: Pose) -> None:
        self.known: Belief = belief(grid)
        self.driving: SimulatedRobot = robot(grid, start)
        self.area = ExploredArea(grid)
        outlook = Outlook(VirtualSensors(grid), 0.2)
        self.goals = GoalChoice(outlook, KnownFrontiers(self.area, 4, ROUTE), ROUTE)
        self.known.update(None, self.driving.look())
        self.stand()

    def stand(self) -> None:
        assert self.known.view is not None
        self.area.add(self.known.view)
        self.groups: Groups = self.known.groups()
        self.goals.stand(self.known, self.groups, done=True)
        self.space = ROUTE.space(self.known, self.groups)


def test_a_goal_is_driven_to_until_it_is_reached_or_tells_nothing_more() -> None:
    scene = Scene(alike_plan("office"), Pose(4.5, 9.5, 0.5))
    assert scene.groups.parts > 4
    decision = scene.goals.choose(scene.known, scene.groups, scene.space, 1)
    parts = 0
    for number in range(2, 40):
        assert decision.drive is not None
        assert scene.goals.has_goal
        driven = scene.driving.drive(decision.drive)
        assert not driven.collided
        scene.known.update(driven.motion, driven.reading)
        scene.stand()
        further = scene.goals.further(scene.known, scene.groups, scene.space, number)
        if further is None:
            break
        assert further.goes_on
        assert (further.target, further.stage) == (decision.target, decision.stage)
        decision, parts = further, parts + 1
    assert 0 < parts < 36
    assert not scene.goals.has_goal
    assert scene.goals.further(scene.known, scene.groups, scene.space, 20) is None


def test_no_goal_is_chosen_twice_in_a_round() -> None:
    scene = Scene(alike_plan("rooms"), Pose(1.2, 4.0, 0.5))
    targets = []
    for number in range(4):
        target = scene.goals.choose(scene.known, scene.groups, scene.space, number).target
        assert target is not None
        assert all(math.dist(target, other) >= ROUTE.near_m / 2.0 for other in targets)
        targets.append(target)
    assert all(each <= 4 for each in scene.goals.open)


def test_where_no_view_tells_anything_that_is_said() -> None:
    first, second = Pose(1.2, 3.4, 0.3), Pose(7.0, 3.4, 0.3)
    scene = Scene(cells_plan(), first)
    at = np.array([(each.x, each.y, each.theta) for each in (first, second)])
    assert scene.known.poses.contain(at[0]).any()
    assert scene.known.poses.contain(at[1]).any()
    groups = Groups(at, Boxes.around(at, [0.01] * 3), np.arange(2))
    decision = scene.goals.choose(scene.known, groups, ROUTE.space(scene.known, groups), 1)
    assert (decision.drive, decision.stage) == (None, "exhausted")
    assert "views 0.5 m apart" in decision.reason
    assert not scene.goals.has_goal


def test_where_no_way_is_safe_no_goal_is_tried() -> None:
    scene = Scene(alike_plan("rooms"), Pose(1.2, 4.0, 0.5))
    scene.known.safe_ways = lambda turns, _: np.where(np.arange(len(turns)) % 2, -1.0, 0.0)  # type: ignore[method-assign]
    decision = scene.goals.choose(scene.known, scene.groups, scene.space, 1)
    assert (decision.drive, decision.stage) == (None, "exhausted")
    assert decision.reason == "in none of 72 directions is a way safe wherever the robot is"
