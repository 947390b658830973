from fractions import Fraction
from itertools import pairwise

import pytest

from ial.bouncing.bump_timing import BumpTiming
from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.rays.real_robot import RealPose, RealRobot
from ial.bouncing.simulated_log import simulated_log
from ial.errors import ConfigError
from tests.bouncing.judged_runs import WORLDS

TIMING = BumpTiming(Fraction(3, 10), Fraction(3, 2), Fraction(1, 10), Fraction(1, 50))
_NEAR = Fraction(1, 10**20)


def driven(seed: int, legs: int = 12) -> tuple[RealRobot, tuple[Fraction, Fraction], list[RealPose]]:
    robot = RealRobot(WORLDS["hall"], Fraction(100), Fraction(1, 4), bounds=ExecutionBounds(turn_deg=Fraction(2)), seed=seed)
    x, y, _ = robot.pose
    return robot, (x, y), [pose for _ in range(legs) for pose in robot.leg()]


def test_ways_lie_within_what_the_times_and_the_bounds_say_and_reach_both_ends() -> None:
    shorter = longer = 0
    for seed in range(40):
        _, start, poses = driven(seed)
        events = simulated_log(start, poses, TIMING, seed)
        places = [start, *((pose.x_m, pose.y_m) for pose in poses if pose.observation)]
        assert [event.kind for event in events] == ["start"] + ["bump"] * (len(places) - 1)
        for (before, after), (a, b) in zip(pairwise(events), pairwise(places), strict=True):
            time = TIMING.drive_s(before, after)
            square = (a[0] - b[0]) ** 2 + (a[1] - b[1]) ** 2
            least = max(Fraction(0), TIMING.speed_m_s * Fraction(49, 50) * (time - TIMING.clock_s))
            most = TIMING.speed_m_s * Fraction(51, 50) * (time + TIMING.clock_s)
            assert max(least - _NEAR, Fraction(0)) ** 2 <= square <= (most + _NEAR) ** 2
            shorter += square < (least + Fraction(1, 10**6)) ** 2 and least > 0
            longer += square > (most - Fraction(1, 10**6)) ** 2
    assert min(shorter, longer) > 5


def test_the_same_seed_gives_the_same_log_in_whole_nanoseconds() -> None:
    _, start, poses = driven(1)
    place = (*start, Fraction(0))
    events = simulated_log(start, poses, TIMING, 5, place)
    assert events == simulated_log(start, poses, TIMING, 5, place) != simulated_log(start, poses, TIMING, 6, place)
    assert events[0].place == place
    assert all((event.time_s * 10**9).denominator == 1 for event in events)


def test_a_clock_that_is_better_than_what_can_be_written_is_refused() -> None:
    _, start, poses = driven(1)
    simulated_log(start, poses, BumpTiming(Fraction(1), clock_s=Fraction(1, 10**9)), 1)
    with pytest.raises(ConfigError, match="give --clock-error 1e-9 or more"):
        simulated_log(start, poses, BumpTiming(Fraction(1)), 1)
