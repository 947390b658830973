"""Rotations against 50 digits."""

import math

import mpmath
import numpy as np
from hypothesis import example, given
from hypothesis import strategies as st

from ial.contractors.intervals.rotation import rotate, turn_point
from ial.contractors.intervals.trigonometric import cos, sin, sincos
from tests.cases import cases

lengths = st.floats(1e-140, 1e6) | st.floats(-1e6, -1e-140) | st.sampled_from([0.0, 1.0, -1.0, 1e-9])
angles = st.floats(-7.0, 7.0) | st.sampled_from([0.25 * math.pi * k for k in range(-8, 9)])
widths = st.floats(0.0, 3.0) | st.sampled_from([0.0, 1e-15, 1e-9, 0.5 * math.pi])


def turned(x: float, y: float, theta: mpmath.mpf) -> tuple[mpmath.mpf, mpmath.mpf]:
    c, s = mpmath.cos(theta), mpmath.sin(theta)
    return c * x - s * y, s * x + c * y


@given(lengths, lengths, angles, widths)
@example(1.0, 0.3, 0.5, 0.0)
@example(-3.0, 1e-9, 3.0, 1.0)
def test_a_turned_point_stays_in_its_box(x: float, y: float, lower: float, width: float) -> None:
    upper = lower + width
    s0, c0 = sincos(lower)
    s1, c1 = sincos(upper)
    ul, uu, vl, vu = turn_point(x, y, s0, c0, s1, c1)
    with mpmath.workdps(50):
        first, last, quarter = mpmath.mpf(lower), mpmath.mpf(upper), mpmath.pi / 2
        at = mpmath.atan2(y, x)
        peaks = [k * quarter - at for k in range(-12, 13)]  # where a coordinate is largest or smallest
        for theta in (first, last, (first + last) / 2, *(peak for peak in peaks if first <= peak <= last)):
            u, v = turned(x, y, theta)
            assert ul <= u <= uu
            assert vl <= v <= vu


def test_points_at_random_are_turned_without_loss_and_boxes_are_tight() -> None:
    random = np.random.default_rng(0)
    with mpmath.workdps(50):
        for _ in range(cases(3000, 100)):
            x, y = (random.uniform(-1.0, 1.0, 2) * 10.0 ** random.integers(-3, 6)).tolist()
            theta = float(random.uniform(-7.0, 7.0))
            s, c = sincos(theta)
            u, v = turned(x, y, mpmath.mpf(theta))
            rough, tight = turn_point(x, y, s, c, s, c), rotate(*cos(theta, theta), *sin(theta, theta), x, x, y, y)
            for ul, uu, vl, vu in (rough, tight):
                assert ul <= u <= uu
                assert vl <= v <= vu
                assert max(uu - ul, vu - vl) <= 2.0**-46 * (abs(x) + abs(y))
