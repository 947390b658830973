import math

import numpy as np

from ial.active.bumps import Bumps
from ial.pose import Pose


def test_a_way_ends_before_a_bump_and_others_stay_as_they_are() -> None:
    bumps = Bumps(0.2)
    bumps.add(Pose(1.0, 0.0, 0.0))  # what was touched is 1.2 m ahead of the start
    turns = np.array([0.0, 0.1, 0.5, math.pi])
    ways = bumps.shortened(Pose(0.0, 0.0, 0.0), turns, np.full(4, 2.0))
    assert ways.tolist()[2:] == [2.0, 2.0]
    assert math.isclose(ways[0], 1.2 - 1.2 * 0.2)
    assert ways[0] < ways[1] < 1.2
    short = np.full(4, 0.5)
    assert bumps.shortened(Pose(0.0, 0.0, 0.0), turns, short).tolist() == short.tolist()


def test_from_where_it_was_stopped_it_goes_back_but_not_on() -> None:
    bumps, turns = Bumps(0.2), np.array([0.0, math.pi])
    bumps.add(Pose(1.0, 2.0, 0.5 * math.pi))
    assert bumps.shortened(Pose(1.0, 2.0, 0.5 * math.pi), turns, np.full(2, 1.0)).tolist() == [-1.0, 1.0]
