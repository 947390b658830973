import math

import numpy as np
import pytest

from ial.active.belief import Belief
from ial.active.planners.hops import Hops
from ial.pose import Pose
from tests.active.scenes import CLEARANCE_M, belief, distance_to_walls, robot, room

GRID = room()
AT = Pose(1.0, 1.7, 0.0)  # the pillar begins 2 m ahead
HOPS = Hops(0.8)


@pytest.fixture(scope="module")
def known() -> Belief:
    made = belief(GRID)
    made.update(None, robot(GRID, AT).look())
    return made


def test_a_straight_way_is_cut_into_hops(known: Belief) -> None:
    ahead, short = HOPS.straight(known, 0.0, 5.0), HOPS.straight(known, 0.0, 0.3)
    assert ahead is not None
    assert short is not None
    assert (ahead.turn_rad, ahead.distance_m, short.distance_m) == (0.0, 0.8, 0.3)


def test_where_not_even_the_shortest_is_safe_there_is_none(known: Belief) -> None:
    behind = Hops(5.0).straight(known, math.pi, 5.0)
    assert behind is not None
    assert distance_to_walls(GRID, AT.x - behind.distance_m, AT.y) >= CLEARANCE_M
    known_there = belief(GRID)
    known_there.update(None, robot(GRID, Pose(0.5, 1.7, 0.0)).look())
    assert HOPS.straight(known_there, math.pi, 5.0) is None


def test_a_path_is_cut_short_where_that_is_safe(known: Belief) -> None:
    around = [(0.5, 0.0), (0.7, 0.4), (1.0, 0.8), (1.5, 1.1), (2.5, 1.1)]  # to the left of the pillar
    drive = Hops(2.0).along(known, around)
    assert drive is not None
    assert drive.distance_m > 1.2, "not from point to point"
    end = AT @ Pose(0.0, 0.0, drive.turn_rad) @ Pose(drive.distance_m, 0.0, 0.0)
    assert distance_to_walls(GRID, end.x, end.y) >= CLEARANCE_M
    assert min(np.hypot(AT.x + x - end.x, AT.y + y - end.y) for x, y in around) < 0.3


def test_along_what_is_not_safe_there_is_none(known: Belief) -> None:
    assert HOPS.along(known, [(0.05, 0.0), (0.0, 0.05)]) is None, "shorter than the shortest"
    known_there = belief(GRID)
    known_there.update(None, robot(GRID, Pose(0.5, 1.7, 0.0)).look())
    assert HOPS.along(known_there, [(-0.2, 0.0), (-0.4, 0.0)]) is None
