import math
from decimal import Decimal
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ial.contractors import Interval
from tests.contractors import itf1788

FINITE = st.floats(allow_nan=False, allow_infinity=False)
INTERVALS = st.tuples(FINITE, FINITE).map(lambda pair: Interval(min(pair), max(pair)))


def test_operators_give_tight_intervals() -> None:
    a, b = Interval(1, 2), Interval(-1, 4)
    assert a + b == Interval(0, 6)
    assert a - b == Interval(-3, 3)
    assert a * b == Interval(-2, 8)
    assert b / a == Interval(-1, 4)
    assert b**2 == Interval(0, 16)
    assert abs(b) == Interval(0, 4)
    assert -a == Interval(-2, -1)
    assert +a == a
    assert a & b == a
    assert a | Interval(3) == Interval(1, 3)
    assert Interval(4, 9).sqrt() == Interval(2, 3)
    assert a.minimum(b) == Interval(-1, 2)
    assert a.maximum(b) == Interval(1, 4)
    assert Interval(3).hypot(4) == Interval(5)
    assert Interval(0).atan2(1) == Interval(0)
    assert Interval(0).sin() == Interval(0)
    assert Interval(0, 4).cos() == Interval(-1, 1)


def test_numbers_stand_on_either_side() -> None:
    a = Interval(1, 2)
    assert 1 + a == a + 1 == Interval(2, 3)
    assert 5 - a == Interval(3, 4)
    assert 2 * a == a * 2 == Interval(2, 4)
    assert 2 / a == Interval(1, 2)
    assert a / 2 == Interval(0.5, 1)
    assert np.float64(1.0) + a == Interval(2, 3)


@given(INTERVALS, INTERVALS, st.floats(0, 1), st.floats(0, 1))
def test_results_contain_the_exact_results_of_members(a: Interval, b: Interval, s: float, t: float) -> None:
    x = Fraction(a.lower) + Fraction(s) * (Fraction(a.upper) - Fraction(a.lower))
    y = Fraction(b.lower) + Fraction(t) * (Fraction(b.upper) - Fraction(b.lower))
    assert x in a
    assert x + y in a + b
    assert x - y in a - b
    assert x * y in a * b
    assert x * x in a**2
    assert abs(x) in abs(a)
    assert min(x, y) in a.minimum(b)
    assert max(x, y) in a.maximum(b)
    assert x in a | b
    assert y == 0 or x / y in a / b


@given(st.integers() | st.fractions() | st.integers(10**300, 10**400) | st.decimals(allow_nan=False, allow_infinity=False))
def test_a_number_that_is_no_double_is_enclosed(number: int | Fraction | Decimal) -> None:
    a = Interval(number)
    assert a.lower <= number <= a.upper
    assert a.upper <= math.nextafter(a.lower, math.inf)


@pytest.mark.parametrize(
    "bounds", [(math.nan,), (math.nan, 1.0), (0.0, math.nan), (2.0, 1.0), (math.inf,), (-math.inf,), (math.inf, -math.inf)]
)
def test_bounds_that_make_no_interval_are_refused(bounds: tuple[float, ...]) -> None:
    with pytest.raises(ValueError, match="an interval has the bounds"):
        Interval(*bounds)


def test_the_empty_interval() -> None:
    empty = Interval.empty()
    assert empty.is_empty
    assert empty == Interval(1) & Interval(2)
    assert (empty + 1).is_empty
    assert (Interval(1) / 0).is_empty
    assert Interval(-2, -1).sqrt().is_empty
    assert 0.0 not in empty
    assert empty in Interval(1, 2)
    assert empty | 3 == Interval(3)
    assert repr(empty) == "[empty]"
    assert math.isnan(empty.width)
    assert math.isnan(empty.midpoint)


def test_membership() -> None:
    assert 1.5 in Interval(1, 2)
    assert 2.5 not in Interval(1, 2)
    assert math.nan not in Interval.entire()
    assert math.inf not in Interval.entire()
    assert Interval(1, 2) in Interval(0, 2)
    assert Interval(0, 2) not in Interval(1, 2)
    assert Fraction(1, 10) not in Interval(0.1)
    assert Fraction(1, 10) in Interval(Fraction(1, 10))


def test_an_interval_is_a_value() -> None:
    a = Interval(0.0, 1.0)
    assert a == Interval(-0.0, 1.0)
    assert hash(a) == hash(Interval(-0.0, 1.0))
    assert a != Interval(0.0, 2.0)
    assert repr(Interval(1, 2)) == "[1.0, 2.0]"
    with pytest.raises(AttributeError):
        a.lower = 3.0  # type: ignore[misc]


def test_only_the_square_is_offered() -> None:
    with pytest.raises(ValueError, match=r"only the square"):
        Interval(1, 2) ** 3


@pytest.mark.parametrize(("operation", "attribute"), [("wid", "width"), ("mid", "midpoint"), ("inf", "lower"), ("sup", "upper")])
def test_itf1788_numeric_functions(operation: str, attribute: str, itf1788_folder: Path) -> None:
    cases = list(itf1788.cases(itf1788_folder, operation))
    assert len(cases) >= 5
    for case in cases:
        (bounds,) = case.inputs
        interval = Interval.empty() if bounds == itf1788.EMPTY else Interval(*bounds)
        value = getattr(interval, attribute)
        assert value == case.result or (math.isnan(value) and math.isnan(case.result)), case.source
