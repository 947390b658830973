"""Tests of odometry as a quaternion."""

import math

from hypothesis import given
from hypothesis import strategies as st

from ial.datasets.odometry import Odometry, quaternion_heading
from ial.pose import Pose


@given(st.floats(-math.pi, math.pi))
def test_a_heading_survives_being_a_quaternion(theta: float) -> None:
    heading = quaternion_heading(theta)
    written = Pose(0.0, 0.0, heading).quaternion()
    assert quaternion_heading(Pose.from_quaternion(0.0, 0.0, *written).theta) == heading
    assert abs(heading - theta) < 1e-14


def test_what_is_no_pose_is_invalid() -> None:
    assert Odometry(1.0, 2.0).valid
    assert not Odometry(1.0, 2.0, 0.0, 0.0).valid
    assert not Odometry(math.nan, 2.0).valid
    assert not Odometry(1.0, 2.0, math.inf, 0.0).valid
