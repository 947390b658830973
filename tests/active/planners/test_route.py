import math

import numpy as np

from ial.active.belief import Belief
from ial.active.planners.route import Place, Route
from ial.active.simulated_robot import SimulatedRobot
from ial.pose import Pose
from tests.active.scenes import belief, robot, room

GRID, START = room(), Pose(2.2, 1.7, 0.4)
ROUTE = Route()


def looked() -> tuple[Belief, SimulatedRobot]:
    known, driving = belief(GRID), robot(GRID, START)
    known.update(None, driving.look())
    return known, driving


def seen_from_start(x: float, y: float) -> Place:
    at = START.inverse() @ Pose(x, y, 0.0)
    return at.x, at.y


def test_a_robot_gets_to_the_other_side_of_a_pillar() -> None:
    known, driving = looked()
    place = seen_from_start(4.6, 1.7)
    drives = 0
    while drives < 12:
        drive = ROUTE.towards(known, ROUTE.space(known, known.groups()), place)
        if drive is None:
            break
        driven = driving.drive(drive)
        assert not driven.collided
        known.update(driven.motion, driven.reading)
        drives += 1
    assert 2 <= drives < 12
    assert math.hypot(driving.pose.x - 4.6, driving.pose.y - 1.7) < ROUTE.near_m / 2.0 + 0.2


def test_places_keep_their_names_while_it_drives() -> None:
    known, driving = looked()
    place = seen_from_start(4.6, 1.7)
    for _ in range(3):
        space = ROUTE.space(known, known.groups())
        at = ROUTE.in_map(known, space, place)
        assert math.hypot(at.x - 4.6, at.y - 1.7) < 0.4
        assert np.allclose(ROUTE.in_start(known, space, at.x, at.y), place)
        drive = ROUTE.towards(known, space, place)
        assert drive is not None
        driven = driving.drive(drive)
        known.update(driven.motion, driven.reading)


def test_what_cannot_be_reached_costs_without_end() -> None:
    known, _ = looked()
    space = ROUTE.space(known, known.groups())
    near, far, outside = (ROUTE.cost_m(known, space, seen_from_start(x, 1.0)) for x in (3.0, 5.0, 9.0))
    assert 0.5 < near < far < 12.0
    assert outside == math.inf
    assert ROUTE.towards(known, space, seen_from_start(9.0, 1.0)) is None
    assert ROUTE.towards(known, space, (0.1, 0.0)) is None, "it is there"
