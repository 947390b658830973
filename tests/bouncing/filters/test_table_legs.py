import random
from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from itertools import islice
from math import isqrt

import numpy as np
import pytest

from ial.bouncing.automata.table import FilterTable
from ial.bouncing.bump_event import BumpEvent
from ial.bouncing.bump_timing import BumpTiming
from ial.bouncing.cells.headings import Headings
from ial.bouncing.cells.noisy_map import NoisyMap
from ial.bouncing.cells.noisy_model import NoisyModel
from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.filters.bounce_filter import BounceFilter
from ial.bouncing.filters.building import build_filter
from ial.bouncing.filters.bump_tracker import BumpTracker
from ial.bouncing.filters.goal import Goal
from ial.bouncing.filters.robust_building import build_robust_filter
from ial.bouncing.filters.robust_filter import RobustFilter
from ial.bouncing.filters.table_legs import TableLegs
from ial.bouncing.rays.real_robot import RealPose, RealRobot
from ial.bouncing.simulated_log import simulated_log
from ial.errors import ConfigError, StreamError
from tests.bouncing.judged_runs import ARMS, WORLDS, holds, robots

HALF = Fraction(1, 2)
TIMING = BumpTiming(Fraction(1, 2), Fraction(1), Fraction(1, 10), Fraction(1, 100))
TURNS = ExecutionBounds(turn_deg=Fraction(1))


@pytest.fixture(scope="module")
def exact() -> BounceFilter:
    return build_filter({"hall": WORLDS["hall"]}, Headings.of_angle(Fraction(90)), Fraction(1), HALF)


def built(count: int, width: int) -> RobustFilter:
    headings, bounds = Headings.of_angle(Fraction(90), 24, Fraction(4)), ExecutionBounds(TURNS.turn_deg, Fraction(1, 100), count)
    return build_robust_filter({"arms": ARMS}, headings, HALF, Goal(width=Fraction(width)), bounds, Fraction(2, 5), 4000)


@pytest.fixture(scope="module")
def robust() -> RobustFilter:
    return built(1, 4)


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


def exact_clock(start: tuple[Fraction, Fraction], bumps: list[RealPose], seed: int) -> Iterator[BumpEvent]:
    """Events of a robot whose clock is right and whose speed, other in each leg, is wrong by up to its bound."""
    chooser, (x, y), now = random.Random(seed), start, Fraction(0)
    yield BumpEvent(now, "start")
    for pose in bumps:
        way = Fraction(isqrt(int(((pose.x_m - x) ** 2 + (pose.y_m - y) ** 2) * 4**120)), 2**120)
        wrong = TIMING.speed_part * Fraction(chooser.choice([-8, 8, chooser.randint(-8, 8)]), 8)
        now += way / (TIMING.speed_m_s * (1 + wrong)) + (TIMING.turn_s if (x, y) != start else 0)
        yield BumpEvent(now, "bump")
        x, y = pose.x_m, pose.y_m


@pytest.mark.slow
def test_a_disk_with_a_clock_is_never_told_to_be_where_it_is_not() -> None:
    made, timing, localized = built(0, 9), replace(TIMING, clock_s=Fraction(0)), 0
    for seed in range(60):
        robot = RealRobot(ARMS, Fraction(90), Fraction(2), Fraction(2, 5), TURNS, seed)
        x, y, _ = robot.pose
        bumps = [pose for pose in islice(robot.run(), 80) if pose.observation]
        tracker = BumpTracker(TableLegs(made, timing))
        for event in exact_clock((x, y), bumps, seed):
            tracker.take(event)
            assert not tracker.legs.empty(tracker.states)
            if tracker.localized:
                assert any(holds(made, place, bumps[tracker.bumps - 1]) for place in made.where(tracker.states))
                localized += 1
    assert localized > 10


@pytest.mark.slow
def test_a_disk_whose_clock_errs_is_in_the_sets_that_the_states_stand_for(robust: RobustFilter) -> None:
    """Such sets say too little for a state to be localized at a bump, so they are computed beside it."""
    map_ = NoisyMap(ARMS, HALF, robust.setting.headings, robust.bounds, robust.setting.radius)
    model, least = NoisyModel(map_.graph), len(map_.graph)
    for seed in range(60):
        robot = RealRobot(ARMS, Fraction(90), Fraction(2), Fraction(2, 5), TURNS, seed)
        x, y, _ = robot.pose
        poses = list(islice(robot.run(), 80))
        bumps = [pose for pose in poses if pose.observation]
        legs = TableLegs(robust, TIMING)
        tracker, held, before = BumpTracker(legs), model.universe(), None
        for event in simulated_log((x, y), poses, TIMING, seed):
            tracker.take(event)
            if before is not None:
                for _ in range(TIMING.steps(TIMING.drive_s(before, event), legs.step_m)):
                    held = model.step(held, None, 0)
                held = model.step(held, None, 1)
                pose = bumps[tracker.bumps - 1]
                assert set(map_.vertices(pose.x_m, pose.y_m, pose.turn)) & set(held.tolist())
                assert robust.table.uncertainty[tracker.states] >= len(held)
                least = min(least, len(held))
            before = event
    assert least < 0.5 * map_.graph.first


def test_a_pause_of_any_length_is_followed_as_step_by_step(exact: BounceFilter) -> None:
    """In a table whose states go around as long as there is no bump, too."""
    successors = [[1, 4], [2, 4], [3, 0], [1, 2], [4, 4]]
    colours = np.array([1, 1, 2, 1, 3], dtype=np.int32)
    table = FilterTable(np.array(successors, dtype=np.int32), colours, colours.astype(np.int64), colours.astype(np.uint64))
    made = BounceFilter(table, exact.places, exact.setting)
    legs = TableLegs(made, BumpTiming(Fraction(1)))
    for state in range(5):
        for count in (*range(12), 3001, 3002, 3003):
            assert legs.leg(state, Fraction(count), "line 2") == table.run([0] * count + [1], state)[-1]
        assert legs.leg(state, Fraction(3 * 10**40 + 4), "line 2") == legs.leg(state, Fraction(4), "line 2")


def test_a_bump_with_no_start_is_refused(exact: BounceFilter) -> None:
    with pytest.raises(StreamError, match=r"line 2: a bump with no start before it.* build a filter with --rays"):
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
