"""Tests of interval motions against exact and high-precision arithmetic."""

import math
from fractions import Fraction

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ial.datasets.motion import ErrorBound, Motion, MotionBounds
from ial.datasets.odometry import Odometry
from ial.datasets.odometry_path import OdometryPath
from ial.errors import ConfigError
from ial.pose import Pose

mpmath.mp.dps = 50

metres = st.floats(-50.0, 50.0)
angles = st.floats(-math.pi, math.pi)
poses = st.builds(Pose, metres, metres, angles)
shares = st.tuples(*[st.floats(0.0, 1.0)] * 3)
Exact = tuple[mpmath.mpf, mpmath.mpf, mpmath.mpf]


def _exact(pose: Pose) -> Exact:
    return mpmath.mpf(pose.x), mpmath.mpf(pose.y), mpmath.mpf(pose.theta)


def _times(first: Exact, second: Exact) -> Exact:
    c, s = mpmath.cos(first[2]), mpmath.sin(first[2])
    return first[0] + c * second[0] - s * second[1], first[1] + s * second[0] + c * second[1], first[2] + second[2]


def _step(before: Exact, after: Exact) -> Exact:
    dx, dy = after[0] - before[0], after[1] - before[1]
    c, s = mpmath.cos(before[2]), mpmath.sin(before[2])
    return c * dx + s * dy, -s * dx + c * dy, after[2] - before[2]


def _holds(motion: Motion, exact: Exact) -> bool:
    """Return whether a box holds an exact motion, its angle modulo 2π."""
    if not all(motion.lower[axis] <= exact[axis] <= motion.upper[axis] for axis in range(2)):
        return False
    turns = [exact[2] + 2 * mpmath.pi * k for k in range(-3, 4)]
    return any(motion.lower[2] <= angle <= motion.upper[2] for angle in turns)


def _inside(motion: Motion, share: tuple[float, float, float]) -> Pose:
    values = motion.lower + np.array(share) * (motion.upper - motion.lower)
    return Pose(*np.clip(values, motion.lower, motion.upper).tolist())


@given(poses, poses)
def test_between_encloses_the_exact_difference(previous: Pose, now: Pose) -> None:
    before, after = Odometry.of(previous), Odometry.of(now)
    motion = Motion.between(before, after)
    assert _holds(motion, _step(_exact(before.pose), _exact(after.pose)))
    assert (motion.upper - motion.lower < 1e-12).all()


@pytest.mark.slow
def test_between_encloses_the_exact_motion_of_recorded_quaternions() -> None:
    """Of any length; their headings are 2·atan2(z, w), to the last bit and beyond."""
    random = np.random.default_rng(8)
    for _ in range(2000):
        pair = []
        for _ in range(2):
            x, y = random.uniform(-50.0, 50.0, 2).tolist()
            z, w = (random.normal(size=2) * 10.0 ** random.uniform(-3.0, 3.0)).tolist()
            pair.append((Odometry(x, y, z, w), (mpmath.mpf(x), mpmath.mpf(y), 2 * mpmath.atan2(z, w))))
        (before, exactly_before), (after, exactly_after) = pair
        motion = Motion.between(before, after)
        assert _holds(motion, _step(exactly_before, exactly_after))
        assert (motion.upper - motion.lower < 1e-12).all()


def test_odometry_of_which_nothing_is_known_gives_every_motion() -> None:
    path = OdometryPath.of([(0, Odometry(0.0, 0.0)), (1, Odometry(1.0, 2.0, 0.0, 1.0, math.inf, math.inf)), (2, Odometry(3.0, 0.0))])
    motion = MotionBounds().along(path)
    assert np.isinf(motion.lower[:2]).all()
    assert np.isinf(motion.upper[:2]).all()
    assert motion.upper[2] - motion.lower[2] >= 2.0 * math.pi


@given(poses, poses, shares, shares)
def test_between_encloses_every_pose_within_the_odometry_errors(
    previous: Pose, now: Pose, first: tuple[float, ...], second: tuple[float, ...]
) -> None:
    error_m, error_rad = 0.03, 0.02
    motion = Motion.between(Odometry.of(previous, error_m, error_rad), Odometry.of(now, error_m, error_rad))
    actual = []
    for pose, share in ((Odometry.of(previous).pose, first), (Odometry.of(now).pose, second)):
        dx, dy, turn = (2.0 * part - 1.0 for part in share)
        actual.append(
            (
                mpmath.mpf(pose.x) + dx * mpmath.mpf(error_m),
                mpmath.mpf(pose.y) + dy * mpmath.mpf(error_m),
                pose.theta + turn * mpmath.mpf(error_rad),
            )
        )
    assert _holds(motion, _step(actual[0], actual[1]))


@given(poses, poses, st.floats(0.0, 1.0), st.floats(0.0, 2.0), shares, shares)
def test_compose_encloses_every_pair_of_motions(
    first: Pose, second: Pose, shift: float, twist: float, one: tuple[float, float, float], two: tuple[float, float, float]
) -> None:
    bounds = MotionBounds(ErrorBound(shift), ErrorBound(twist))
    a, b = bounds.enclose(first), bounds.enclose(second)
    assert _holds(a.compose(b), _times(_exact(_inside(a, one)), _exact(_inside(b, two))))


@given(poses, shares)
def test_identity_is_neutral_up_to_rounding(delta: Pose, share: tuple[float, float, float]) -> None:
    motion = MotionBounds().enclose(delta)
    for composed in (motion.compose(Motion.identity()), Motion.identity().compose(motion)):
        assert composed.contains(_inside(motion, share))
        assert composed.upper[:2] - composed.lower[:2] == pytest.approx(motion.upper[:2] - motion.lower[:2], abs=1e-9)


def test_unknown_absorbs_everything_and_is_the_full_circle() -> None:
    unknown = Motion.unknown()
    assert unknown.lower[2] < -math.pi
    assert unknown.upper[2] > math.pi
    for motion in (
        unknown.compose(Motion.identity()),
        Motion.identity().compose(unknown),
        unknown.compose(unknown),
        MotionBounds().enclose(unknown),
    ):
        assert np.array_equal(motion.lower, unknown.lower)
        assert np.array_equal(motion.upper, unknown.upper)


@pytest.mark.slow
@given(poses, st.floats(0.0, 0.3), st.floats(0.0, 0.3), st.floats(0.0, 0.3), shares)
def test_enclose_holds_what_the_formula_allows(
    delta: Pose, per_message: float, per_metre: float, per_radian: float, share: tuple[float, ...]
) -> None:
    bounds = MotionBounds(ErrorBound(per_message, per_metre, per_radian), ErrorBound(per_message / 2, per_metre / 2, per_radian / 2))
    half = per_message + mpmath.mpf(per_metre) * mpmath.hypot(delta.x, delta.y) + mpmath.mpf(per_radian) * abs(mpmath.mpf(delta.theta))
    dx, dy, turn = (2.0 * part - 1.0 for part in share)
    motion = bounds.enclose(delta)
    assert _holds(motion, (delta.x + dx * half, delta.y + dy * half, delta.theta + turn * half / 2))
    assert motion.upper[0] - motion.lower[0] <= 2.0 * float(half) + 1e-9


def test_turns_take_the_shorter_way() -> None:
    motion = Motion.between(Odometry.of(Pose(0.0, 0.0, 3.1)), Odometry.of(Pose(0.0, 0.0, -3.1)))
    assert motion.lower[2] == pytest.approx(2.0 * math.pi - 6.2)


def test_membership_is_modulo_two_pi() -> None:
    motion = MotionBounds(ErrorBound(0.1), ErrorBound(0.2)).enclose(Pose(0.0, 0.0, 3.1))
    assert motion.contains(Pose(0.05, -0.05, -3.1))
    assert not motion.contains(Pose(0.05, -0.05, -2.8))
    assert not motion.contains(Pose(0.15, 0.0, 3.1))


@pytest.mark.parametrize("numbers", [(-0.1, 0.0, 0.0), (0.1, -1.0, 0.0), (0.1, 0.0, math.nan), (math.inf, 0.0, 0.0)])
def test_bounds_must_be_finite_and_not_negative(numbers: tuple[float, float, float]) -> None:
    with pytest.raises(ConfigError, match=r"ErrorBound\.per_\w+ is .*: give a finite number"):
        ErrorBound(*numbers)


def test_bounds_of_a_motion_must_be_ordered() -> None:
    with pytest.raises(ValueError, match="ordered"):
        Motion(np.array([0.0, 0.0, 1.0]), np.array([0.0, 0.0, 0.5]))


def test_a_robot_that_cannot_drive_sideways_has_a_bound_of_its_own_for_that() -> None:
    bounds = MotionBounds(ErrorBound(0.2, 0.1), ErrorBound(0.1), sideways=ErrorBound(0.03, 0.02, 0.5))
    motion = bounds.enclose(Pose(1.0, 0.0, 0.1))
    half = 0.5 * (motion.upper - motion.lower)
    assert half == pytest.approx([0.3, 0.1, 0.1])
    plain = MotionBounds(bounds.translation, bounds.rotation).enclose(Pose(1.0, 0.0, 0.1))
    assert 0.5 * (plain.upper - plain.lower) == pytest.approx([0.3, 0.3, 0.1])


def test_a_motion_is_widened_outward_by_the_part_of_a_scan() -> None:
    random = np.random.default_rng(2)
    for _ in range(200):
        delta, halves = random.uniform(-3.0, 3.0, 3).tolist(), random.uniform(0.0, 1.0, 2).tolist()
        bounds = MotionBounds(ErrorBound(per_scan=halves[0]), ErrorBound(per_scan=halves[1] / 10.0))
        motion = bounds.enclose(Pose(*delta))
        turned = Pose(*delta).theta
        for axis, (value, half) in enumerate(((delta[0], halves[0]), (delta[1], halves[0]), (turned, halves[1] / 10.0))):
            shift = round(float(motion.lower[axis] - value + half) / (2.0 * math.pi)) if axis == 2 else 0
            if not shift:
                assert Fraction(float(motion.lower[axis])) <= Fraction(value) - Fraction(half)
                assert Fraction(value) + Fraction(half) <= Fraction(float(motion.upper[axis]))


@pytest.mark.parametrize("messages", [0, 1])
def test_a_path_of_less_than_two_messages_has_no_motion(messages: int) -> None:
    path = OdometryPath.of((stamp, Odometry.of(Pose(1.0, 2.0, 3.0))) for stamp in range(messages))
    with pytest.raises(ValueError, match=f"a path of {messages} odometry messages has no motion"):
        MotionBounds().along(path)
