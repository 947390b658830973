from fractions import Fraction
from itertools import islice

import pytest

from ial.bouncing.automata.table import FilterTable
from ial.bouncing.bump_timing import BumpTiming
from ial.bouncing.cells.headings import Headings
from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.filters.bounce_filter import BounceFilter
from ial.bouncing.filters.building import build_filter
from ial.bouncing.filters.bump_tracker import BumpTracker
from ial.bouncing.filters.goal import Goal
from ial.bouncing.filters.robust_building import build_robust_filter
from ial.bouncing.filters.robust_filter import RobustFilter
from ial.bouncing.filters.table_legs import TableLegs
from ial.bouncing.rays.real_robot import RealRobot
from ial.bouncing.simulated_log import simulated_log
from ial.errors import ConfigError, StreamError
from tests.bouncing.judged_runs import ARMS, WORLDS, holds, robots

HALF = Fraction(1, 2)
TIMING = BumpTiming(Fraction(1, 2), Fraction(1), Fraction(1, 10), Fraction(1, 100))
ERRORS = ExecutionBounds(Fraction(1), Fraction(1, 100), 1)


@pytest.fixture(scope="module")
def exact() -> BounceFilter:
    return build_filter({"hall": WORLDS["hall"]}, Headings.of_angle(Fraction(90)), Fraction(1), HALF)


@pytest.fixture(scope="module")
def robust() -> RobustFilter:
    headings = Headings.of_angle(Fraction(90), 24, Fraction(4))
    return build_robust_filter({"arms": ARMS}, headings, HALF, Goal(width=Fraction(4)), ERRORS, Fraction(2, 5), 4000)


def test_an_exact_filter_is_told_the_stream_of_a_robot_that_keeps_to_its_cells(exact: BounceFilter) -> None:
    localized = 0
    for seed, robot in enumerate(robots(WORLDS["hall"], exact, 20)):
        x, y, _ = robot.pose
        poses = list(islice(robot.run(), 120))
        tracker, states = BumpTracker(TableLegs(exact, TIMING)), exact.table.run(pose.observation for pose in poses)
        after = [state for pose, state in zip(poses, states, strict=True) if pose.observation]
        for event in simulated_log((x, y), poses, TIMING, seed):
            tracker.take(event)
            if event.kind == "bump":
                assert tracker.states == after[tracker.bumps - 1]
        localized += tracker.localized
    assert localized > 15


@pytest.mark.slow
def test_a_disk_with_a_clock_is_never_told_to_be_where_it_is_not(robust: RobustFilter) -> None:
    localized, bounds = 0, ExecutionBounds(turn_deg=ERRORS.turn_deg)
    for seed in range(150):
        robot = RealRobot(ARMS, Fraction(90), Fraction(2), Fraction(2, 5), bounds, seed)
        x, y, _ = robot.pose
        poses = list(islice(robot.run(), 80))
        tracker, bumps = BumpTracker(TableLegs(robust, TIMING)), [pose for pose in poses if pose.observation]
        for event in simulated_log((x, y), poses, TIMING, seed):
            tracker.take(event)
            assert not tracker.legs.empty(tracker.states)
            if event.kind == "bump" and tracker.localized:
                assert any(holds(robust, place, bumps[tracker.bumps - 1]) for place in robust.where(tracker.states))
                localized += 1
    assert localized > 20


def test_a_pause_of_any_length_is_followed_as_step_by_step(exact: BounceFilter) -> None:
    """In a table whose states go around as long as there is no bump, too."""
    successors = [[1, 4], [2, 4], [3, 0], [1, 2], [4, 4]]
    table = FilterTable(*(type(exact.table.successors)((5, 2), dtype="int32") for _ in range(1)), *[exact.table.colours] * 3)
    table.successors[:] = successors
    made = BounceFilter(table, exact.places, exact.setting)
    legs = TableLegs(made, BumpTiming(Fraction(1)))
    for state in range(5):
        for count in (*range(12), 3001, 3002, 3003):
            assert legs.leg(state, Fraction(count), "line 2") == table.run([0] * count + [1], state)[-1]
        assert legs.leg(state, Fraction(3 * 10**40 + 4), "line 2") == legs.leg(state, Fraction(4), "line 2")


def test_a_bump_with_no_start_is_refused(exact: BounceFilter) -> None:
    with pytest.raises(StreamError, match="line 2: a bump with no start before it.* build a filter with --rays"):
        TableLegs(exact, TIMING).untimed("line 2")


def test_filters_whose_steps_times_do_not_tell_are_refused(robust: RobustFilter) -> None:
    eight = build_filter({"hall": WORLDS["hall"]}, Headings.of_angle(Fraction(90), 8), Fraction(1), HALF)
    with pytest.raises(ConfigError, match="not equally long in all headings"):
        TableLegs(eight, TIMING)
    long = build_filter({"hall": WORLDS["hall"]}, Headings.of_angle(Fraction(90), 4, Fraction(3, 2)), Fraction(1), HALF)
    with pytest.raises(ConfigError, match="step of whole cells"):
        TableLegs(long, TIMING)
    with pytest.raises(ConfigError, match="build one with --count-error 2"):
        TableLegs(robust, BumpTiming(Fraction(1), clock_s=Fraction(3)))
