from fractions import Fraction

import numpy as np
import pytest

from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.rays.piece_map import PieceMap
from ial.bouncing.rays.piece_model import PieceModel
from ial.bouncing.rays.real_robot import RealRobot
from tests.bouncing.judged_runs import WORLDS
from tests.bouncing.rays.test_real_robot import ROOM

NONE, SOME = ExecutionBounds(), ExecutionBounds(Fraction(2), Fraction(1, 50), 1)


@pytest.mark.slow
def test_bumps_localize_a_robot_with_errors() -> None:
    made = PieceMap.of(WORLDS["hall"], Fraction(100), Fraction(1, 4), SOME, Fraction(1, 4), 72)
    model, shares = PieceModel(made), []
    for seed in range(20):
        robot, states, best = RealRobot(WORLDS["hall"], Fraction(100), Fraction(1, 4), bounds=SOME, seed=seed), model.universe(), len(made)
        for _ in range(25):
            states = model.leg(states, len(list(robot.leg())) - 1)
            best = min(best, len(states))
        shares.append(best / len(made))
    assert max(shares) < 0.02


def test_a_robot_that_turns_by_another_angle_is_rejected_in_the_end() -> None:
    made = PieceMap.of(WORLDS["hall"], Fraction(100), Fraction(1, 4), NONE, Fraction(1, 4), 72)
    model, rejected = PieceModel(made), 0
    for seed in range(10):
        robot, states = RealRobot(WORLDS["hall"], Fraction(130), Fraction(1, 4), seed=seed), model.universe()
        for _ in range(20):
            states = model.leg(states, len(list(robot.leg())) - 1)
        rejected += model.empty(states)
    assert rejected > 5


def test_more_steps_than_fit_are_a_rejection() -> None:
    model = PieceModel(PieceMap.of(ROOM, Fraction(90), Fraction(1), NONE, Fraction(1), 36))
    states = model.universe()
    for steps in range(6):
        assert not model.empty(states), f"after {steps} steps: the diagonal is 5 m"
        states = model.step(states, None, 0)
    assert model.empty(states)


def test_a_union_holds_both_and_a_prediction_every_outcome() -> None:
    model = PieceModel(PieceMap.of(ROOM, Fraction(90), Fraction(1), NONE, Fraction(1), 36))
    once = model.leg(model.universe(), 1)
    still, bumped = model.step(once, None, 0), model.step(once, None, 1)
    predicted = model.predict(once, None)
    pairs = {(piece, steps) for each in (still, bumped) for piece, steps in zip(each.pieces, each.steps, strict=True)}
    assert set(zip(predicted.pieces.tolist(), predicted.steps.tolist(), strict=True)) == pairs
    assert len(predicted) == len(pairs)


def test_a_leg_is_the_same_as_its_steps() -> None:
    model = PieceModel(PieceMap.of(WORLDS["L"], Fraction(100), Fraction(1, 4), SOME, Fraction(1, 2), 36))
    stepped = legs = model.universe()
    for count in (7, 0, 5, 12, 3):
        for reading in [0] * count + [1]:
            stepped = model.step(stepped, None, reading)
        legs = model.leg(legs, count)
        assert np.array_equal(stepped.pieces, legs.pieces)
        assert not stepped.steps.any()
