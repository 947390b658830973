import random
from fractions import Fraction

import numpy as np
import pytest

from ial.bouncing.bump_timing import BumpTiming
from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.filters.bump_tracker import BumpTracker
from ial.bouncing.filters.goal import Goal
from ial.bouncing.filters.piece_filter import PieceFilter
from ial.bouncing.filters.piece_legs import PieceLegs
from ial.bouncing.rays.piece_map import PieceMap
from ial.bouncing.rays.piece_model import PieceModel
from ial.bouncing.rays.real_robot import RealRobot
from ial.bouncing.simulated_log import simulated_log
from ial.errors import ConfigError
from ial.maps.polygons.environment import Environment
from tests.bouncing.piece_truth import left_from
from tests.bouncing.rays.test_real_robot import ROOM
from tests.bouncing.truth import random_environment

ANGLE, STEP = Fraction(100), Fraction(1, 4)


def built(environment: Environment, bounds: ExecutionBounds) -> PieceFilter:
    return PieceFilter(
        PieceMap.of(environment, ANGLE, STEP, bounds, Fraction(1, 2), 36), "world", ANGLE, STEP, bounds, Goal(width=Fraction(1))
    )


def lost(seed: int, timing: BumpTiming, bounds: ExecutionBounds, started: bool) -> tuple[int, float]:
    """At how many of 12 bumps a robot with a clock and errors is not in its set, and which part of the pieces is left in the end."""
    environment = random_environment(seed)
    made = built(environment, bounds)
    robot = RealRobot(environment, ANGLE, STEP, bounds=ExecutionBounds(turn_deg=bounds.turn_deg), seed=seed)
    x, y, _ = robot.pose
    poses, after = [], []
    for _ in range(12):
        poses += robot.leg()
        after.append(robot.pose)
    tracker, losses = BumpTracker(PieceLegs(made, timing)), 0
    events = simulated_log((x, y), poses, timing, seed)
    for event in events if started else events[1:]:
        tracker.take(event)
        if event.kind == "bump":
            losses += not left_from(made.map, environment, *after[tracker.bumps - 1]) & set(tracker.states.pieces.tolist())
    return losses, len(tracker.states) / len(made.map)


@pytest.mark.slow
def test_a_robot_with_a_clock_is_in_every_set() -> None:
    left = []
    for seed in range(60):
        chooser = random.Random(seed)
        clock = Fraction(chooser.choice([1, 500, 1000, 2000]), 1000)
        timing = BumpTiming(Fraction(chooser.choice([1, 2, 3]), 4), Fraction(chooser.choice([0, 2])), clock, Fraction(1, 50))
        bounds = ExecutionBounds(Fraction(2), Fraction(1, 50), timing.count_error(STEP))
        losses, part = lost(seed, timing, bounds, seed % 4 > 0)
        assert losses == 0
        left.append(part)
    assert np.median(left) < 0.2


@pytest.mark.slow
def test_a_clock_that_errs_more_than_it_is_said_to_loses_robots() -> None:
    """So that the test above can fail."""
    bounds = ExecutionBounds(Fraction(2), Fraction(1, 50), 1)

    class Trusting(BumpTiming):
        def check(self, step_m: Fraction, bounds: ExecutionBounds) -> None:
            pass

    timing = Trusting(Fraction(1), Fraction(2), Fraction(3), Fraction(1, 50))
    assert sum(lost(seed, timing, bounds, True)[0] > 0 for seed in range(10)) > 5


def test_a_bump_with_no_start_leaves_all_pieces_and_a_leg_that_is_too_long_none() -> None:
    made = built(ROOM, ExecutionBounds(count=1))
    legs = PieceLegs(made, BumpTiming(Fraction(1)))
    assert len(legs.untimed("line 2")) == len(legs.anew()) == len(made.map)
    assert not legs.empty(legs.leg(legs.universe(), Fraction(3), "line 2"))
    for start in (legs.universe(), legs.anew()):
        assert legs.empty(legs.leg(start, Fraction(10**30), "line 2"))
        assert not legs.is_localized(start)


def test_a_leg_is_what_the_model_makes_of_the_count() -> None:
    made = built(ROOM, ExecutionBounds(Fraction(1), Fraction(1, 50), 1))
    legs, model = PieceLegs(made, BumpTiming(Fraction(1, 2), clock_s=Fraction(1, 2))), PieceModel(made.map)
    for time in (Fraction(-1, 4), Fraction(0), Fraction(49, 10), Fraction(5)):
        expected = model.leg(legs.anew(), max(int(time * 2), 0))
        assert legs.leg(legs.anew(), time, "line 2").pieces.tolist() == expected.pieces.tolist()


def test_a_filter_whose_bounds_are_too_small_is_refused() -> None:
    with pytest.raises(ConfigError, match="build one with --count-error 1"):
        PieceLegs(built(ROOM, ExecutionBounds()), BumpTiming(Fraction(1), clock_s=Fraction(1, 100)))
