"""The doubles on both sides of a number of any kind."""

import math
import numbers
from decimal import Decimal
from fractions import Fraction
from typing import Any

import numpy as np

from ial.contractors.rounding import check_rounding, down, up

Number = float | Fraction | Decimal | np.floating[Any] | np.integer[Any]


def is_number(value: object) -> bool:
    """Return whether a value is one real number: of Python, of NumPy, a fraction or a decimal."""
    return isinstance(value, numbers.Real | Decimal)


def below(number: Number) -> float:
    """Return the largest double that is not above a number; NaN for NaN.

    Raises
    ------
    TypeError
        If it is not a real number.
    """
    nearest, exact = _nearest(number)
    return down(nearest) if nearest > exact else nearest


def above(number: Number) -> float:
    """Return the smallest double that is not below a number; NaN for NaN. Raises the same as `below`."""
    nearest, exact = _nearest(number)
    return up(nearest) if nearest < exact else nearest


def whole(value: Any) -> int | None:
    """Return a whole number of any type as an integer, None for every other value."""
    if not is_number(value):
        return None
    if isinstance(value, numbers.Integral):
        return int(value)
    low = below(value)
    return int(low) if low == above(value) and low.is_integer() else None


def _nearest(number: Any) -> tuple[float, Any]:
    """Return the nearest double, and the number as something that Python compares with it without rounding."""
    if isinstance(number, float):
        return float(number), float(number)
    if not is_number(number):
        raise TypeError(f"{number!r} stands for a bound; give a real number, or read a text with Interval.parse")
    check_rounding()
    exact = int(number) if isinstance(number, numbers.Integral) else number  # NumPy would round its own integers in a comparison
    try:
        nearest = float(exact)
    except OverflowError:
        nearest = math.inf if exact > 0 else -math.inf
    return nearest, nearest if math.isnan(nearest) else exact
