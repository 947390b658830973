import copy
import math
import operator as op
import pickle
from collections.abc import Callable
from decimal import Decimal
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ial.contractors import Boxes, Interval
from ial.contractors.expressions.variables import variables
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


def test_numbers_stand_on_either_side() -> None:
    a = Interval(1, 2)
    assert 1 + a == a + 1 == Interval(2, 3)
    assert 5 - a == Interval(3, 4)
    assert 2 * a == a * 2 == Interval(2, 4)
    assert 2 / a == Interval(1, 2)
    assert a / 2 == Interval(0.5, 1)
    assert np.float64(1.0) + a == Interval(2, 3)
    assert Decimal("0.5") * a == Interval(0.5, 1)
    assert 2 & a == Interval(2)
    assert 3 | a == Interval(1, 3)
    assert list(np.array([1, 2]) * a) == [Interval(1, 2), Interval(2, 4)]


def test_powers() -> None:
    a = Interval(-2, 3)
    assert a**2 == a**2.0 == a ** Fraction(4, 2) == a ** np.int64(2) == Interval(0, 9)
    assert a**3 == Interval(-8, 27)
    assert a**0 == Interval(1)
    assert Interval(2, 4) ** -1 == Interval(0.25, 0.5)
    assert Interval(4, 9) ** 0.5 == Interval(2, 3)
    assert Interval(-4, 9) ** Interval(2) == Interval(0, 81)  # pow: its base is not negative
    assert 2 ** Interval(1, 3) == Interval(2, 8)
    assert Fraction(7, 3) in (Interval(Fraction(343, 27)) ** Fraction(1, 3))
    with pytest.raises(ValueError, match=r"must lie between -2\*\*63 and 2\*\*63"):
        a**1e300
    with pytest.raises(ValueError, match="cannot be NaN"):
        a**math.nan


class Unknown:
    def __radd__(self, other: object) -> str:
        return "reflected"

    __rsub__ = __rmul__ = __rtruediv__ = __rpow__ = __rand__ = __ror__ = __eq__ = __radd__  # type: ignore[assignment]


@pytest.mark.parametrize("apply", [op.add, op.sub, op.mul, op.truediv, op.pow, op.and_, op.or_, op.eq])
def test_an_unknown_operand_decides_itself(apply: Callable[[object, object], object]) -> None:
    assert apply(Interval(1), Unknown()) == "reflected"
    if apply is not op.eq:
        with pytest.raises(TypeError):
            apply(Interval(1), "text")


def test_expressions_and_boxes_decide_what_an_operation_gives() -> None:
    x = variables("x")
    assert isinstance(Interval(1, 2) * x, type(x))
    assert isinstance(Interval(1, 2) == x, type(x == 1))
    assert isinstance(Interval(1, 2) - Boxes.of([(0, 1)]), Boxes)
    assert isinstance(Interval(1, 2) & Boxes.of([(0, 1)]), Boxes)


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
    assert x**3 in a**3
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
    assert empty.cancel_minus(1).is_empty
    assert 0.0 not in empty
    assert empty in Interval(1, 2)
    assert empty | 3 == Interval(3)
    assert str(empty) == empty.hex() == "[empty]"
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
    assert str(Interval(1, 2)) == "[1.0, 2.0]"
    assert str(Interval(-0.0)) == str(-Interval(0)) == "[0.0, 0.0]"
    assert str(Interval.entire()) == "[-inf, inf]"
    with pytest.raises(AttributeError):
        a.lower = 3.0  # type: ignore[misc]


@pytest.mark.parametrize("interval", [Interval(0.1, 0.2), Interval(1, math.inf), Interval.empty(), Interval.entire()])
def test_an_interval_is_pickled_copied_and_printed_for_python(interval: Interval) -> None:
    assert pickle.loads(pickle.dumps(interval)) == interval
    assert copy.deepcopy(interval) == copy.copy(interval) == interval
    assert eval(repr(interval), {"Interval": Interval, "inf": math.inf}) == interval
    assert Interval.parse(interval.hex()) == interval


def test_how_two_intervals_lie() -> None:
    a, b, empty = Interval(1, 2), Interval(1, 3), Interval.empty()
    assert a.subset(b)
    assert not b.subset(a)
    assert Interval(1.5).interior(a)
    assert not a.interior(b)
    assert a.disjoint(Interval(3, 4))
    assert not a.disjoint(2)
    assert a.less(b)
    assert not a.strict_less(b)
    assert a.precedes(2)
    assert not a.strict_precedes(2)
    assert a.strict_precedes(3)
    assert empty.subset(a)
    assert empty.interior(empty)
    assert (a.overlap(b), b.overlap(a), a.overlap(7), empty.overlap(a)) == ("starts", "startedBy", "before", "firstEmpty")
    with pytest.raises(TypeError):
        a < b  # type: ignore[operator] # noqa: B015


def test_what_an_interval_is() -> None:
    assert Interval(2).is_point
    assert not Interval.empty().is_point
    assert Interval(1, 2).is_bounded
    assert not Interval.empty().is_bounded
    assert not Interval(0, math.inf).is_bounded
    assert Interval.entire().is_entire
    assert not Interval(0, math.inf).is_entire


@given(INTERVALS)
def test_numbers_that_describe_an_interval(a: Interval) -> None:
    assert a.midpoint in a
    assert a in Interval(a.midpoint) + Interval(-1, 1) * a.radius
    assert Fraction(a.upper) - Fraction(a.lower) <= a.width
    assert a.magnitude in abs(a)
    assert a.mignitude in abs(a)
    assert abs(a) == Interval(a.mignitude, a.magnitude)


@given(INTERVALS, INTERVALS)
def test_a_cancelled_addition(a: Interval, b: Interval) -> None:
    assert a in (a + b).cancel_minus(b)
    assert a in (a - b).cancel_plus(b)


NUMERIC = [
    *(("wid", "width"), ("mid", "midpoint"), ("rad", "radius"), ("mag", "magnitude"), ("mig", "mignitude")),
    *(("inf", "lower"), ("sup", "upper")),
]


@pytest.mark.parametrize(("operation", "attribute"), NUMERIC)
def test_itf1788_numeric_functions(operation: str, attribute: str, itf1788_folder: Path) -> None:
    cases = list(itf1788.cases(itf1788_folder, operation))
    assert len(cases) >= 5
    for case in cases:
        (bounds,) = case.inputs
        interval = Interval.empty() if bounds == itf1788.EMPTY else Interval(*bounds)
        value = getattr(interval, attribute)
        assert value == case.result or (math.isnan(value) and math.isnan(case.result)), case.source
