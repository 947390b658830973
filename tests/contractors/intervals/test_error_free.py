import math
from fractions import Fraction

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ial.contractors.intervals import error_free
from ial.contractors.kernels import kernel
from tests.contractors.oracles import LARGEST, TINY

MODERATE = st.floats(2.0**-200, 2.0**200) | st.floats(-(2.0**200), -(2.0**-200))
POSITIVE = st.floats(0.0, exclude_min=True, allow_infinity=False)
RATIOS = st.floats(-(2.0**-53), 2.0**-53)


@given(MODERATE, MODERATE)
def test_sums_and_products_of_two_parts_are_exact(a: float, b: float) -> None:
    for function, exact in ((error_free.two_sum, Fraction(a) + Fraction(b)), (error_free.two_product, Fraction(a) * Fraction(b))):
        assert sum(map(Fraction, function(a, b))) == exact
    large, small = (a, b) if abs(a) >= abs(b) else (b, a)
    assert sum(map(Fraction, error_free.fast_two_sum(large, small))) == Fraction(a) + Fraction(b)


@given(MODERATE, RATIOS, MODERATE, RATIOS)
def test_quotients_have_the_error_they_state(a: float, p: float, b: float, q: float) -> None:
    high, low = error_free.quotient(a, a * p, b, b * q)
    exact = (Fraction(a) + Fraction(a * p)) / (Fraction(b) + Fraction(b * q))
    assert abs(Fraction(high) + Fraction(low) - exact) <= abs(exact) * Fraction(1, 2**102)


@given(st.floats(2.0**-200, 2.0**200), RATIOS)
def test_roots_have_the_error_they_state(a: float, p: float) -> None:
    with mpmath.workdps(60):
        exact = mpmath.sqrt(mpmath.mpf(a) + a * p)
        high, low = error_free.root(a, a * p)
        assert abs(mpmath.mpf(high) + low - exact) <= exact * mpmath.mpf(2) ** -100
    assert error_free.root(0.0, 0.0) == (0.0, 0.0)


@given(MODERATE, RATIOS, st.floats(0.0, 1.0))
def test_enclosing_is_tight_and_exact_where_nothing_is_left(high: float, ratio: float, part: float) -> None:
    low = high * ratio
    error = abs(low) * part
    lower, upper = error_free.enclose(high, low, error)
    margin = Fraction(math.ulp(low)) if low else Fraction(0)
    assert Fraction(lower) <= Fraction(high) + Fraction(low) - Fraction(error) + margin
    assert Fraction(high) + Fraction(low) + Fraction(error) - margin <= Fraction(upper)
    assert upper <= math.nextafter(math.nextafter(lower, math.inf), math.inf)
    assert error_free.enclose(high, 0.0, 0.0) == (high, high)


@pytest.mark.parametrize("x", [0.0, TINY, 1e-300, 1e-100, 0.25, -TINY, -1e-300, -1e-100, -0.25])
@pytest.mark.parametrize("away", [1.0, -1.0])
def test_an_odd_function_near_zero_leaves_its_argument_on_the_right_side(x: float, away: float) -> None:
    lower, upper = error_free.enclose_odd(x, away * x * 2.0**-60, 2.0**-50, away)
    beside = math.nextafter(x, math.copysign(math.inf, x * away))
    assert (lower, upper) == ((x, x) if x == 0.0 else (min(x, beside), max(x, beside)))


@given(POSITIVE)
def test_splitting_is_exact(x: float) -> None:
    mantissa, exponent = error_free.split(x)
    assert 0.7071067811865475 <= mantissa <= 1.4142135623730951
    assert Fraction(mantissa) * Fraction(2) ** int(exponent) == Fraction(x)


@given(st.floats(0.5, 2.0), st.integers(-1500, 1500))
def test_scaling_rounds_outward(x: float, exponent: int) -> None:
    exact = Fraction(x) * Fraction(2) ** exponent
    lower, upper = error_free.scale_outward(x, x, float(exponent))
    assert Fraction(lower) <= exact
    assert upper == math.inf or exact <= Fraction(upper)
    assert upper <= math.nextafter(lower, math.inf)
    assert error_free.scale_outward(-x, -x, float(exponent)) == (-upper, -lower)


def test_powers_of_two() -> None:
    assert [error_free.power_of_two(float(k)) for k in range(-1022, 1024)] == [2.0**k for k in range(-1022, 1024)]
    assert error_free.scale_outward(1.0, 1.0, 1024.0) == (LARGEST, math.inf)
    assert error_free.scale_outward(1.0, 1.0, -1075.0) == (0.0, TINY)


def test_fused_multiply_add_rounds_once() -> None:
    @kernel
    def fused(a, b, c):  # type: ignore[no-untyped-def]
        return error_free.fma(a, b, c)

    x = 1.0 + 2.0**-30
    assert fused(x, x, -(x * x)) == 2.0**-60


def test_what_a_sum_lost_is_not_known_of_infinities() -> None:
    assert math.isnan(error_free.sum_residual(np.inf, 1.0, np.inf))
