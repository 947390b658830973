import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ial.pose import Pose, wrap

angles = st.floats(-math.pi, math.pi)
metres = st.floats(-1e4, 1e4)
poses = st.builds(Pose, metres, metres, angles)


def matrix(pose: Pose) -> np.ndarray:
    c, s = math.cos(pose.theta), math.sin(pose.theta)
    return np.array([[c, -s, pose.x], [s, c, pose.y], [0.0, 0.0, 1.0]])


@given(poses, poses)
def test_composition_is_the_product_of_matrices(a: Pose, b: Pose) -> None:
    assert matrix(a @ b) == pytest.approx(matrix(a) @ matrix(b), abs=1e-9)
    assert -math.pi <= (a @ b).theta <= math.pi


@given(poses)
def test_a_pose_and_its_inverse_cancel(pose: Pose) -> None:
    for nothing in (pose @ pose.inverse(), pose.inverse() @ pose):
        assert matrix(nothing) == pytest.approx(np.eye(3), abs=1e-9)


@given(poses)
def test_the_quaternion_says_the_same_heading(pose: Pose) -> None:
    z, w = pose.quaternion()
    assert math.hypot(z, w) == pytest.approx(1.0, abs=1e-15)
    back = Pose.from_quaternion(pose.x, pose.y, z, w)
    assert matrix(back) == pytest.approx(matrix(pose), abs=1e-9)
    assert abs(wrap(Pose.from_quaternion(0.0, 0.0, -z, -w).theta - pose.theta)) < 1e-14  # both quaternions are one rotation


def test_a_quarter_turn_is_counter_clockwise() -> None:
    at = Pose(1.0, 2.0, 0.5 * math.pi) @ Pose(3.0, 0.0, 0.25 * math.pi)
    assert (at.x, at.y, at.theta) == pytest.approx((1.0, 5.0, 0.75 * math.pi))
    assert Pose(0.0, 0.0, 0.5 * math.pi).quaternion() == pytest.approx((math.sqrt(0.5), math.sqrt(0.5)))


@given(angles)
def test_an_angle_in_the_range_keeps_its_bits(angle: float) -> None:
    assert wrap(angle) == angle
    assert math.copysign(1.0, wrap(angle)) == math.copysign(1.0, angle)


@given(st.floats(-1e6, 1e6))
def test_wrapping_adds_whole_turns(angle: float) -> None:
    assert -math.pi <= wrap(angle) <= math.pi
    turns = (angle - wrap(angle)) / (2.0 * math.pi)
    assert turns == pytest.approx(round(turns), abs=1e-9)


def test_headings_across_the_cut_are_wrapped() -> None:
    assert (Pose(theta=3.0) @ Pose(theta=3.0)).theta == pytest.approx(6.0 - 2.0 * math.pi)
    assert Pose(theta=math.pi).inverse().theta == -math.pi
    assert Pose() == Pose(0.0, 0.0, 0.0)
