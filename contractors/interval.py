"""`Interval`: one closed interval of real numbers with Python's operators."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Union

import numpy as np

from ial.contractors import arithmetic, elementary
from ial.contractors.rounding import check_rounding

Operand = Union["Interval", float, Fraction, np.floating[Any], np.integer[Any]]


@dataclass(frozen=True, init=False, repr=False)
class Interval:
    """A closed interval of real numbers, possibly unbounded or empty (IEEE 1788-2015, clause 7.2).

    Every operation rounds outward and raises `RoundingModeError` where the processor does not round to nearest. ``+ - * /``, ``** 2``,
    ``abs``, `sqrt`, `minimum`, `maximum`, ``&`` (intersection) and ``|`` (hull) give the smallest interval of doubles around the exact set.
    A number given to the constructor or to an operation stands for itself: an integer or a fraction that is not a double becomes the
    interval between the two doubles around it.

    Parameters
    ----------
    lower
        The lower bound, or the one point of the interval if `upper` is not given.
    upper
        The upper bound.

    Raises
    ------
    ValueError
        If a bound is NaN, if lower > upper, or if both bounds are the same infinity. The empty interval is `Interval.empty()`.
    """

    lower: float
    upper: float

    def __init__(self, lower: Any, upper: Any = None) -> None:
        low, high = _below(lower), _above(lower if upper is None else upper)
        if math.isnan(low) or math.isnan(high):
            raise ValueError(f"an interval has the bounds {low} and {high}; a bound cannot be NaN")
        if low > high:
            raise ValueError(f"an interval has the bounds {low} > {high}; give the lower one first, or use Interval.empty()")
        if low == math.inf or high == -math.inf:
            raise ValueError(f"an interval has the bounds {low} and {high}, and no real number lies between them; use Interval.empty()")
        object.__setattr__(self, "lower", low)
        object.__setattr__(self, "upper", high)

    @classmethod
    def _of(cls, bounds: tuple[float, float]) -> "Interval":
        interval = object.__new__(cls)
        object.__setattr__(interval, "lower", bounds[0])
        object.__setattr__(interval, "upper", bounds[1])
        return interval

    @classmethod
    def empty(cls) -> "Interval":
        """Return the empty interval, whose bounds are (inf, -inf)."""
        return cls._of((math.inf, -math.inf))

    @classmethod
    def entire(cls) -> "Interval":
        """Return the real line."""
        return cls._of((-math.inf, math.inf))

    @property
    def is_empty(self) -> bool:
        """Whether no number lies in the interval."""
        return self.lower > self.upper

    @property
    def width(self) -> float:
        """The width, rounded up; NaN if empty (IEEE 1788-2015, 10.5.9)."""
        if self.is_empty:
            return math.nan
        return (Interval._of((self.upper, self.upper)) - Interval._of((self.lower, self.lower))).upper

    @property
    def midpoint(self) -> float:
        """A double near the middle, always inside; NaN if empty, 0 for the real line (IEEE 1788-2015, 10.5.9)."""
        if self.is_empty:
            return math.nan
        if self.lower == -math.inf or self.upper == math.inf:
            largest = math.nextafter(math.inf, 0.0)
            return 0.0 if self.lower == -self.upper else largest if self.upper == math.inf else -largest
        total = self.lower + self.upper
        return 0.5 * total if math.isfinite(total) else 0.5 * self.lower + 0.5 * self.upper

    def __contains__(self, other: Operand) -> bool:
        """Return whether a number, or every number of an interval, lies in this one."""
        if isinstance(other, Interval):
            return other.is_empty or (self.lower <= other.lower and other.upper <= self.upper)
        return bool(self.lower <= other <= self.upper and abs(other) != math.inf)

    def __add__(self, other: Operand) -> "Interval":
        return _binary(arithmetic.add, self, other)

    def __radd__(self, other: Operand) -> "Interval":
        return _binary(arithmetic.add, other, self)

    def __sub__(self, other: Operand) -> "Interval":
        return _binary(arithmetic.sub, self, other)

    def __rsub__(self, other: Operand) -> "Interval":
        return _binary(arithmetic.sub, other, self)

    def __mul__(self, other: Operand) -> "Interval":
        return _binary(arithmetic.mul, self, other)

    def __rmul__(self, other: Operand) -> "Interval":
        return _binary(arithmetic.mul, other, self)

    def __truediv__(self, other: Operand) -> "Interval":
        return _binary(arithmetic.div, self, other)

    def __rtruediv__(self, other: Operand) -> "Interval":
        return _binary(arithmetic.div, other, self)

    def __and__(self, other: Operand) -> "Interval":
        return _binary(arithmetic.intersect, self, other)

    def __or__(self, other: Operand) -> "Interval":
        return _binary(arithmetic.hull, self, other)

    def __neg__(self) -> "Interval":
        return _unary(arithmetic.neg, self)

    def __pos__(self) -> "Interval":
        return self

    def __abs__(self) -> "Interval":
        return _unary(arithmetic.absolute, self)

    def __pow__(self, exponent: int) -> "Interval":
        if exponent != 2:
            raise ValueError(f"the exponent is {exponent!r}; only the square, ** 2, is offered")
        return _unary(arithmetic.sqr, self)

    def sqrt(self) -> "Interval":
        """Return the square roots of the numbers that are not negative."""
        return _unary(arithmetic.sqrt, self)

    def sin(self) -> "Interval":
        """Return the sines; the argument is in radians."""
        return _unary(elementary.sin, self)

    def cos(self) -> "Interval":
        """Return the cosines; the argument is in radians."""
        return _unary(elementary.cos, self)

    def minimum(self, other: Operand) -> "Interval":
        """Return the smaller of two numbers, for all pairs."""
        return _binary(arithmetic.minimum, self, other)

    def maximum(self, other: Operand) -> "Interval":
        """Return the larger of two numbers, for all pairs."""
        return _binary(arithmetic.maximum, self, other)

    def atan2(self, x: Operand) -> "Interval":
        """Return the angles, in [-π, π], of the points (x, y) with y in this interval."""
        return _binary(elementary.atan2, self, x)

    def hypot(self, other: Operand) -> "Interval":
        """Return √(x² + y²)."""
        return _binary(elementary.hypot, self, other)

    def __repr__(self) -> str:
        return "[empty]" if self.is_empty else f"[{self.lower}, {self.upper}]"


def _nearest(number: Any) -> float:
    try:
        return float(number)
    except OverflowError:
        return math.inf if number > 0 else -math.inf


def _below(number: Any) -> float:
    """Return the largest double that is not above a number."""
    nearest = _nearest(number)
    return math.nextafter(nearest, -math.inf) if nearest > number else nearest


def _above(number: Any) -> float:
    """Return the smallest double that is not below a number."""
    nearest = _nearest(number)
    return math.nextafter(nearest, math.inf) if nearest < number else nearest


def _interval(operand: Operand) -> Interval:
    return operand if isinstance(operand, Interval) else Interval(operand)


def _unary(operation: Callable[..., tuple[float, float]], a: Interval) -> Interval:
    check_rounding()
    return Interval._of(operation(a.lower, a.upper))


def _binary(operation: Callable[..., tuple[float, float]], a: Operand, b: Operand) -> Interval:
    check_rounding()
    a, b = _interval(a), _interval(b)
    return Interval._of(operation(a.lower, a.upper, b.lower, b.upper))
