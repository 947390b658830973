import math
from decimal import Decimal
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ial.contractors.intervals.double import above, below, whole

NUMBERS = (
    st.integers() | st.fractions() | st.floats(allow_nan=False) | st.integers(10**300, 10**400) | st.decimals(allow_nan=False)
) | st.integers(-(2**63), 2**63 - 1).map(np.int64)


def exact(number: Any) -> Any:
    return int(number) if isinstance(number, np.integer) else number


@given(NUMBERS)
def test_the_two_doubles_around_a_number(number: Any) -> None:
    low, high = below(number), above(number)
    assert low <= exact(number) <= high
    assert high in (low, math.nextafter(low, math.inf))
    assert (low == high) == (exact(number) in (low, high))


@pytest.mark.parametrize("number", [math.nan, Decimal("nan"), np.float32("nan")])
def test_nan_stays(number: Any) -> None:
    assert math.isnan(below(number))
    assert math.isnan(above(number))


def test_a_long_double_is_enclosed() -> None:
    third = np.longdouble(1) / 3
    assert below(third) <= third <= above(third)


@pytest.mark.parametrize("value", ["1.5", None, 1j, np.array([1.0]), [1.0]])
def test_what_is_no_number_is_refused(value: Any) -> None:
    with pytest.raises(TypeError, match=r"give a real number, or read a text with Interval\.parse"):
        below(value)


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        *((two, 2) for two in (2, 2.0, np.int8(2), Fraction(4, 2), Decimal("2.0"))),
        *((2**60 + 1, 2**60 + 1), (Fraction(2**60 + 1), None), (2.5, None), (Fraction(1, 3), None)),
        *((math.inf, None), (math.nan, None), (Decimal("inf"), None), ("2", None), (None, None)),
    ],
)
def test_whole_numbers(value: Any, expected: int | None) -> None:
    assert whole(value) == expected
