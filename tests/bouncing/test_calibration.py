from fractions import Fraction
from itertools import islice

import pytest

from ial.bouncing.bump_timing import BumpTiming
from ial.bouncing.calibration import STEP_PART, TURN_DEG, Calibration, LeastBound, _least
from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.known_run import KnownRun, known_runs
from ial.bouncing.rays.real_robot import RealRobot
from ial.bouncing.simulated_log import simulated_log
from ial.errors import ConfigError, StreamError
from tests.bouncing.judged_runs import WORLDS
from tests.bouncing.truth import random_environment

ANGLE, STEP = Fraction(100), Fraction(1, 4)
TIMING = BumpTiming(Fraction(3, 10), Fraction(3, 2), Fraction(1, 100), Fraction(1, 50))
TURN = Fraction(1)
HALL = WORLDS["hall"]


def run_of(environment: object, seed: int, steps: int = 120, off: Fraction = Fraction(0), turned: Fraction = Fraction(0)) -> KnownRun:
    """Let a robot with the errors above run from a start that it reports, wrong in x and in its heading by so much."""
    robot = RealRobot(environment, ANGLE, STEP, bounds=ExecutionBounds(turn_deg=TURN), seed=seed)  # type: ignore[arg-type]
    x, y, turn = robot.pose
    place = (x + off, y, 360 * turn + turned)
    (run,) = known_runs(simulated_log((x, y), islice(robot.run(), steps), TIMING, seed, place), TIMING)
    return run


@pytest.mark.slow
def test_the_bounds_that_a_robot_keeps_are_never_refuted() -> None:
    for seed in range(40):
        environment = random_environment(seed)
        off, turned = Fraction(seed % 3 - 1, 20), Fraction(seed // 3 % 3 - 1)
        found = Calibration(environment, ANGLE, STEP, TIMING, abs(off), abs(turned))
        assert found.explains(run_of(environment, seed, 60, off, turned), TIMING.speed_part, TURN)


@pytest.mark.slow
def test_bounds_are_found_from_several_runs() -> None:
    found, runs = Calibration(HALL, ANGLE, STEP, TIMING), [run_of(HALL, seed) for seed in range(6)]
    steps = found.step_bound(runs)
    assert steps.refuted is not None
    assert Fraction(1, 100) < steps.refuted < TIMING.speed_part
    assert steps.explained == steps.refuted + STEP_PART
    turns = found.turn_bound(runs, TIMING.speed_part)
    assert turns.refuted is not None
    assert Fraction(1, 2) < turns.refuted < TURN
    assert turns.explained == turns.refuted + TURN_DEG


def test_errors_of_the_start_explain_what_would_be_errors_of_the_speed() -> None:
    run = run_of(HALL, 3, 40)
    first = KnownRun(run.place, run.drives_s[:1])
    exact, loose = Calibration(HALL, ANGLE, STEP, TIMING), Calibration(HALL, ANGLE, STEP, TIMING, Fraction(1, 2), Fraction(1))
    assert not exact.explains(first, Fraction(0), Fraction(0))
    assert loose.explains(first, Fraction(0), Fraction(0))


def test_a_run_that_no_bound_explains_is_refused() -> None:
    found = Calibration(HALL, ANGLE, STEP, TIMING)
    with pytest.raises(StreamError, match=r"line 2: no error of the speed up to 50% explains its first leg; check the place"):
        found.step_bound([KnownRun((Fraction(1), Fraction(1), Fraction(0)), (Fraction(60),), "line 2")])
    with pytest.raises(
        StreamError, match=r"line 2: no error of turns up to 90° explains it with a speed error of 0\.02; give a larger one"
    ):
        found.turn_bound([KnownRun((Fraction(1), Fraction(1), Fraction(0)), (Fraction(80, 3), Fraction(60)), "line 2")], Fraction(1, 50))
    with pytest.raises(StreamError, match="far too long"):
        found.step_bound([KnownRun((Fraction(1), Fraction(1), Fraction(0)), (Fraction(10**9),), "line 2")])


@pytest.mark.parametrize("least", [0, 1, 2, 3, 5, 8, 11, 99, 100])
def test_the_least_multiple_is_found(least: int) -> None:
    unit = Fraction(1, 3)
    refuted = None if least == 0 else (least - 1) * unit
    assert _least(lambda each: each >= least * unit, unit, 100 * unit) == LeastBound(refuted, least * unit)


@pytest.mark.parametrize(
    ("step", "off", "message"), [(Fraction(0), Fraction(0), "the step is 0 m"), (STEP, Fraction(-1), "an error of a start is negative")]
)
def test_what_cannot_be_meant_is_refused(step: Fraction, off: Fraction, message: str) -> None:
    with pytest.raises(ConfigError, match=message):
        Calibration(HALL, ANGLE, step, TIMING, off)
