"""Tests of the one rule by which odometry is looked up."""

import math

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ial.datasets.odometry import Odometry
from ial.datasets.odometry_buffer import OdometryBuffer
from ial.pose import Pose

MS = 10**6
mpmath.mp.dps = 50


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
    odometry = buffer.at(25 * MS)
    assert odometry is not None
    assert (odometry.x, odometry.y) == pytest.approx((1.25, 1.0))
    assert odometry.pose.theta == pytest.approx(3.0 + 0.25 * (2.0 * math.pi - 6.0))
    turn = 2.0 * math.pi - 6.0
    assert odometry.error_m == pytest.approx(0.75 + 0.16 * 1.0 * turn)  # an arc between the two leaves their box
    assert odometry.error_rad == pytest.approx(0.75 * (2.0 * math.pi - 6.0))


@given(st.tuples(*[st.floats(-100.0, 100.0)] * 4), st.integers(1, 99), st.floats(0.0, 1.0), st.floats(0.0, 1.0))
def test_the_error_covers_the_box_of_the_neighbours(corners: tuple[float, ...], share: int, u: float, v: float) -> None:
    ax, ay, bx, by = corners
    odometry = OdometryBuffer([(0, _at(ax, ay)), (100, _at(bx, by))]).at(share)
    assert odometry is not None
    assert abs(ax + u * (bx - ax) - odometry.x) <= odometry.error_m
    assert abs(ay + v * (by - ay) - odometry.y) <= odometry.error_m


def test_errors_of_the_messages_add_up() -> None:
    odometry = OdometryBuffer([(0, Odometry(0.0, 0.0, error_m=0.5, error_rad=0.2)), (100, Odometry(0.0, 0.0))]).at(50)
    assert odometry is not None
    assert (odometry.error_m, odometry.error_rad) == pytest.approx((0.5 + 0.16 * math.sqrt(0.5) * 0.2, 0.2))


def test_there_is_no_odometry_outside_or_in_a_gap() -> None:
    buffer = OdometryBuffer([(0, _at(0.0)), (500 * MS, _at(1.0)), (1001 * MS, _at(2.0))])
    assert buffer.at(-1) is None
    assert buffer.at(250 * MS) is not None
    assert buffer.at(700 * MS) is None
    assert buffer.at(1001 * MS) is not None
    assert buffer.at(1001 * MS + 1) is None
    assert OdometryBuffer([]).at(0) is None


@given(st.floats(0.0, 20.0), st.floats(-3.14, 3.14), st.floats(-3.0, 3.0), st.integers(1, 99), st.floats(0.0, 1.0))
def test_the_error_covers_an_arc_wherever_the_robot_is_on_it(radius: float, turn: float, heading: float, share: int, u: float) -> None:
    def on_the_arc(part: float) -> Pose:
        to = heading + part * turn
        side = math.copysign(radius, turn)
        return Pose(side * (math.sin(to) - math.sin(heading)), side * (math.cos(heading) - math.cos(to)), to)

    odometry = OdometryBuffer([(0, Odometry.of(on_the_arc(0.0))), (100, Odometry.of(on_the_arc(1.0)))]).at(share)
    at = on_the_arc(u)
    assert odometry is not None
    assert max(abs(at.x - odometry.x), abs(at.y - odometry.y)) <= odometry.error_m + 1e-12
    assert abs(math.remainder(at.theta - odometry.pose.theta, 2.0 * math.pi)) <= odometry.error_rad + 1e-12


def test_the_error_of_an_interpolated_heading_is_rounded_outward() -> None:
    random = np.random.default_rng(3)
    for _ in range(200):
        pair = [(100 * each, Odometry(0.0, 0.0, *random.normal(size=2).tolist())) for each in range(2)]
        odometry = OdometryBuffer(pair).at(int(random.integers(1, 100)))
        assert odometry is not None
        middle = 2 * mpmath.atan2(odometry.z, odometry.w)
        for _, end in pair:
            turned = 2 * mpmath.atan2(end.z, end.w) - middle
            turned -= 2 * mpmath.pi * mpmath.nint(turned / (2 * mpmath.pi))
            assert abs(turned) <= odometry.error_rad


def test_messages_between_two_times_come_in_that_order() -> None:
    buffer = OdometryBuffer([(30, _at(3.0)), (10, _at(1.0)), (20, _at(2.0)), (20, _at(2.5)), (40, _at(4.0))])
    assert [odometry.x for _, odometry in buffer.between(10, 40)] == [2.5, 3.0]
    assert [odometry.x for _, odometry in buffer.between(40, 10)] == [3.0, 2.5]
    assert [odometry.x for _, odometry in buffer.between(None, 20)] == [1.0]
    assert len(buffer.between(20, 20)) == len(buffer.between(21, 29)) == 0
    buffer.forget(35)
    assert [odometry.x for _, odometry in buffer.between(None, 99)] == [3.0, 4.0]


def test_what_was_looked_up_before_is_no_message() -> None:
    buffer = OdometryBuffer([(0, _at(0.0)), (100, _at(1.0))])
    buffer.fix(50, _at(0.7))
    buffer.limit(50, 0.1, 0.2)
    assert buffer.at(50) == Odometry.of(Pose(0.7), 0.1, 0.2)
    assert len(buffer.between(0, 100)) == 0
    sweep = buffer.sweep(0, 50)
    assert sweep is not None
    assert [odometry.x for _, odometry in sweep] == [0.0, 0.7]
    assert buffer.sweep(50, 101) is None
    assert buffer.sweep(50, 50) is None


def test_messages_that_were_lost_leave_nothing_known() -> None:
    buffer = OdometryBuffer([(stamp, _at(1.0 * stamp)) for stamp in range(6)])
    buffer.lose(4)
    (first, *rest) = buffer.between(None, 6)
    assert first == (3, Odometry.of(Pose(3.0), math.inf, math.inf))
    assert [stamp for stamp, _ in rest] == [4, 5]


@pytest.mark.parametrize("w", [1e-17, -1e-17, -3e-17, -6.2e-17, 0.0])
def test_half_a_turn_may_go_either_way(w: float) -> None:
    odometry = OdometryBuffer([(0, Odometry(0.0, 0.0)), (100, Odometry(0.0, 0.0, 1.0, w))]).at(50)
    assert odometry is not None
    turn = 2 * mpmath.atan2(1, w) - 2 * mpmath.pi * (w < 0)
    for share in (0.01, 0.5, 0.99):
        off = share * turn - 2 * mpmath.atan2(odometry.z, odometry.w)
        off -= 2 * mpmath.pi * mpmath.nint(off / (2 * mpmath.pi))
        assert abs(off) <= odometry.error_rad
