import math

import numpy as np

from ial.active.bumps import Bumps
from ial.pose import Pose


def test_there_is_a_limit_before_a_bump_and_none_elsewhere() -> None:
    bumps = Bumps(0.2)
    bumps.add(Pose(1.0, 0.0, 0.0))  # what was touched is 1.2 m ahead of the start
    limits = bumps.limits_m(Pose(0.0, 0.0, 0.0), np.array([0.0, 0.1, 0.5, math.pi]))
    assert limits.tolist()[2:] == [math.inf, math.inf]
    assert math.isclose(limits[0], 1.2 - 1.2 * 0.2)
    assert limits[0] < limits[1] < 1.2


def test_from_where_it_was_stopped_it_goes_back_but_not_on() -> None:
    bumps = Bumps(0.2)
    bumps.add(Pose(1.0, 2.0, 0.5 * math.pi))
    on, back = bumps.limits_m(Pose(1.0, 2.0, 0.5 * math.pi), np.array([0.0, math.pi])).tolist()
    assert on < 0.0
    assert back == math.inf
