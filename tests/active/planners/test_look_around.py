import dataclasses
import math

import numpy as np
import pytest

from ial.active.belief import Belief
from ial.active.common_space import CommonSpace
from ial.active.exploration import explore
from ial.active.planners.look_around import LookAround
from ial.active.planners.outlook import Outlook, seen_part
from ial.active.planners.route import Route
from ial.active.planners.two_stage import TwoStagePlanner
from ial.active.simulated_robot import SimulatedRobot
from ial.active.virtual_sensors import VirtualSensors
from ial.datasets.walk import random_walk
from ial.maps.grids.alike_plans import alike_plan
from ial.pose import Pose
from tests.active.scenes import LIDAR, belief, robot

GRID = alike_plan("rooms")


def narrow(start: Pose, field_rad: float, seed: int = 0) -> SimulatedRobot:
    """A robot that sees as much ahead."""
    made = robot(GRID, start, seed)
    made.lidar = dataclasses.replace(LIDAR, angle_min=-0.5 * field_rad, angle_increment=field_rad / LIDAR.beams)
    return made


def scene(field_rad: float) -> tuple[Belief, SimulatedRobot, LookAround, CommonSpace]:
    known, driving = belief(GRID), narrow(Pose(2.1, 4.5, 0.3), field_rad)
    known.update(None, driving.look())
    made = LookAround(Outlook(VirtualSensors(GRID), 0.2))
    made.begin(known)
    return known, driving, made, Route().space(known, known.groups(most=24))


@pytest.mark.parametrize(("field_rad", "turns"), [(2.0 * math.pi, 0), (1.9 * math.pi, 0), (1.5 * math.pi, 1), (math.pi, 1), (1.0, 6)])
def test_it_turns_until_it_has_seen_all(field_rad: float, turns: int) -> None:
    known, driving, around, space = scene(field_rad)
    assert seen_part(known) == pytest.approx(field_rad / (2.0 * math.pi))
    assert around.has_seen_all(known) == (turns == 0)
    known.safe_ways = lambda turns, _: np.zeros(len(turns))  # type: ignore[method-assign]
    turned = []
    while around.begun:
        decision = around.further(known, known.groups(most=24), space)
        if decision is None:
            break
        assert decision.drive is not None
        assert decision.drive.distance_m == 0.0
        turned.append(decision.drive.turn_rad)
    assert turned == pytest.approx([2.0 * math.pi / (turns + 1)] * turns)
    assert around.has_seen_all(known)
    driven = driving.drive(dataclasses.replace(decision.drive, distance_m=0.5)) if turned else None
    if driven is not None:
        known.update(driven.motion, driven.reading)
        assert not around.has_seen_all(known), "it is elsewhere"


def test_it_does_not_turn_where_that_is_not_safe_or_tells_nothing() -> None:
    known, _, around, space = scene(math.pi)
    known.safe_ways = lambda turns, _: np.full(len(turns), -1.0)  # type: ignore[method-assign]
    assert around.further(known, known.groups(most=24), space) is None
    assert around.unsafe
    assert not around.has_seen_all(known)
    around.begin(known)
    assert around.further(known, known.groups(most=1), space) is None, "of one place there is nothing to tell"
    assert not around.unsafe


@pytest.mark.slow
def test_a_robot_that_sees_one_half_is_localized() -> None:
    for seed in (0, 1):  # without looking around, the first came to an end with three rooms left
        known, driving = belief(GRID), narrow(random_walk(GRID, 1, seed, clearance_m=0.5)[0], math.pi, seed)
        for step in explore(known, driving, TwoStagePlanner(known), 60):
            assert step.estimate.poses.contains(GRID.pose_to_grid(driving.pose))
            assert not step.collided
        assert step.estimate.status == "localized"
