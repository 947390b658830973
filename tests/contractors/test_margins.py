"""The margins of the toolkit: what they cover, by exact arithmetic, up to the angles and coordinates that are supported."""

import math
from fractions import Fraction

import mpmath
import numpy as np
import pytest

from ial.contractors.intervals.reverse_periodic import cos_reverse, sin_reverse
from ial.contractors.intervals.rotation import turn_point
from ial.contractors.intervals.trigonometric import LARGEST_ANGLE, cos, sin, sincos
from ial.contractors.kernels import kernel
from ial.contractors.margins import ABOVE, BELOW, ROUNDINGS, UNIT

FAR = 1e6  # metres


def test_a_factor_covers_thirty_roundings_and_its_own() -> None:
    least, most = (1 - Fraction(UNIT)) ** 31, (1 + Fraction(UNIT)) ** 31
    assert Fraction(ABOVE) * least > 1 > Fraction(BELOW) * most
    assert Fraction(ABOVE) == 1 + Fraction(ROUNDINGS)
    assert most - 1 < Fraction(ROUNDINGS)


def test_a_sum_of_thirty_numbers_is_below_its_factor_and_above_the_other() -> None:
    random = np.random.default_rng(0)
    for _ in range(2000):
        terms = random.uniform(0.0, 1.0, 30) * 10.0 ** random.integers(-20, 20)
        exact, total = sum(map(Fraction, terms.tolist())), 0.0
        for term in terms.tolist():
            total += term
        assert Fraction(total * BELOW) <= exact <= Fraction(total * ABOVE)


@pytest.mark.parametrize("middle", [0.0, 10.0, 1e4, 9.9e4])
def test_a_point_far_away_that_turns_stays_in_its_box(middle: float) -> None:
    random = np.random.default_rng(1)
    with mpmath.workdps(50):
        for _ in range(400):
            x, y = (FAR * random.uniform(-1.0, 1.0, 2) * 10.0 ** random.integers(-9, 1, 2)).tolist()
            low = middle + float(random.uniform(-4.0, 4.0))
            low = float(mpmath.pi / 2 * int(low * 2.0 / np.pi)) if random.integers(2) else low  # a bound that is an extremum, or nearly
            high = low + float(random.choice([0.0, 1e-12, 0.01, 2.9]) * random.random())
            (s0, c0), (s1, c1) = sincos(low), sincos(high)
            ul, uu, vl, vu = turn_point(x, y, s0, c0, s1, c1)
            for share in (0.0, 0.3, 1.0):
                theta = mpmath.mpf(low) + (mpmath.mpf(high) - mpmath.mpf(low)) * share
                u, v = x * mpmath.cos(theta) - y * mpmath.sin(theta), x * mpmath.sin(theta) + y * mpmath.cos(theta)
                assert ul <= u <= uu
                assert vl <= v <= vu


@pytest.mark.parametrize("size", [1.0, 1e4, LARGEST_ANGLE])
def test_no_extremum_is_missed_and_no_branch_far_from_0(size: float) -> None:
    """Intervals begin or end at the doubles next to an extremum, where the number of the branch is rounded."""
    random = np.random.default_rng(2)
    with mpmath.workdps(50):
        for _ in range(1000):
            halves = int(random.integers(-int(size / np.pi), int(size / np.pi) + 1))
            for wave, backward, at in ((cos, cos_reverse, mpmath.pi * halves), (sin, sin_reverse, mpmath.pi * (halves + 0.5))):
                peak = 1.0 if halves % 2 == 0 else -1.0
                below = float(at) if float(at) <= at else float(np.nextafter(float(at), -np.inf))
                above = float(np.nextafter(below, np.inf))
                if max(abs(below), abs(above)) > LARGEST_ANGLE:
                    continue
                lower, upper = wave(below, above)
                assert (upper if peak > 0.0 else lower) == peak
                # Going back from the peak leaves the doubles around it, whichever side of it the interval comes from.
                for start, stop in ((below - 1.0, above), (below, above + 1.0)):
                    left, right = backward(peak, peak, start, stop)
                    assert left <= at <= right


@kernel
def _of_the_platform(x, y, values):  # type: ignore[no-untyped-def]
    """Fill in what the platform's library makes of a number from 0 to 1 and another one."""
    values[0], values[1], values[2], values[3], values[4] = math.asin(x), math.acos(x), math.atan(y), math.atan2(x, y), abs(y) ** x


@pytest.mark.slow
def test_the_platform_is_trusted_with_no_more_than_it_keeps() -> None:
    """`trigonometric` and `powers` take these to be right within one unit in the last place: here by what kernels call."""
    random, values = np.random.default_rng(3), np.empty(5)
    with mpmath.workdps(60):
        for _ in range(3000):
            x = float(random.choice([random.random(), 1.0 - 10.0 ** random.uniform(-16.0, 0.0), 10.0 ** random.uniform(-300.0, 0.0)]))
            y = float(random.choice([-1.0, 1.0]) * 10.0 ** random.choice([random.uniform(-2.0, 2.0), random.uniform(-300.0, 300.0)]))
            _of_the_platform(x, y, values)
            exact = (mpmath.asin(x), mpmath.acos(x), mpmath.atan(y), mpmath.atan2(x, y), mpmath.power(abs(mpmath.mpf(y)), mpmath.mpf(x)))
            for value, right in zip(values.tolist(), exact, strict=True):
                assert abs(right - value) < math.ulp(value)
