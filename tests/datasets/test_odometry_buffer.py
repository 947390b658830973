"""Tests of the one rule by which odometry is looked up."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ial.datasets.odometry import Odometry
from ial.datasets.odometry_buffer import OdometryBuffer
from ial.pose import Pose

MS = 10**6


def _at(x: float, y: float = 0.0, theta: float = 0.0) -> Odometry:
    return Odometry.of(Pose(x, y, theta))


def test_an_exact_stamp_gives_the_very_message() -> None:
    first, second = _at(1.0, 2.0, 0.3), _at(2.0)
    buffer = OdometryBuffer([(100, second), (50, first)])
    assert buffer.at(50) == first
    assert buffer.at(100) == second


def test_of_two_messages_with_one_stamp_the_later_counts_and_more_may_come() -> None:
    buffer = OdometryBuffer([(50, _at(1.0)), (50, _at(2.0))])
    assert buffer.at(50) == _at(2.0)
    buffer.add(40, _at(3.0))
    buffer.add(50, _at(4.0))
    assert buffer.at(50) == _at(4.0)
    assert len(buffer) == 2


def test_an_error_may_come_before_or_after_its_message() -> None:
    buffer = OdometryBuffer()
    buffer.limit(50, 0.1, 0.2)
    buffer.limit(70, 0.5, 0.5)  # of no message
    buffer.add(50, _at(1.0))
    buffer.add(60, _at(1.0))
    assert (buffer.at(50), buffer.at(60)) == (Odometry.of(Pose(1.0), 0.1, 0.2), _at(1.0))


def test_nothing_is_known_of_no_message() -> None:
    assert OdometryBuffer().at(5) is None


def test_between_messages_the_pose_is_linear_and_its_error_known() -> None:
    buffer = OdometryBuffer([(0, _at(1.0, 1.0, 3.0)), (100 * MS, _at(2.0, 1.0, -3.0))])
    found = buffer.at(25 * MS)
    assert found is not None
    assert (found.x, found.y) == pytest.approx((1.25, 1.0))
    assert found.pose.theta == pytest.approx(3.0 + 0.25 * (2.0 * math.pi - 6.0))
    turn = 2.0 * math.pi - 6.0
    assert found.error_m == pytest.approx(0.75 + 0.16 * 1.0 * turn)  # an arc between the two leaves their box
    assert found.error_rad == pytest.approx(0.75 * (2.0 * math.pi - 6.0))


@given(st.tuples(*[st.floats(-100.0, 100.0)] * 4), st.integers(1, 99), st.floats(0.0, 1.0), st.floats(0.0, 1.0))
def test_the_error_covers_the_box_of_the_neighbours(corners: tuple[float, ...], share: int, u: float, v: float) -> None:
    ax, ay, bx, by = corners
    found = OdometryBuffer([(0, _at(ax, ay)), (100, _at(bx, by))]).at(share)
    assert found is not None
    assert abs(ax + u * (bx - ax) - found.x) <= found.error_m
    assert abs(ay + v * (by - ay) - found.y) <= found.error_m


def test_errors_of_the_messages_add_up() -> None:
    found = OdometryBuffer([(0, Odometry(0.0, 0.0, error_m=0.5, error_rad=0.2)), (100, Odometry(0.0, 0.0))]).at(50)
    assert found is not None
    assert (found.error_m, found.error_rad) == pytest.approx((0.5 + 0.16 * math.sqrt(0.5) * 0.2, 0.2))


def test_there_is_no_odometry_outside_or_in_a_gap() -> None:
    buffer = OdometryBuffer([(0, _at(0.0)), (500 * MS, _at(1.0)), (1001 * MS, _at(2.0))])
    assert buffer.at(-1) is None
    assert buffer.at(250 * MS) is not None
    assert buffer.at(700 * MS) is None
    assert buffer.at(1001 * MS) is not None
    assert buffer.at(1001 * MS + 1) is None
    assert OdometryBuffer([]).at(0) is None
