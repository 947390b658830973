"""`Interval`: one closed interval of real numbers with Python's operators."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import ClassVar, Protocol, Union

from ial.contractors.intervals import arithmetic, powers, sets
from ial.contractors.intervals.double import Number, above, below, is_number, whole
from ial.contractors.intervals.literal import bounds_of_literal
from ial.contractors.rounding import check_rounding

Operand = Union["Interval", Number]


class Forward(Protocol):
    """What an interval needs of an operation."""

    @property
    def forward(self) -> Callable[..., tuple[float, float]]:
        """The function from bounds of the operands to bounds of the result."""
        ...


@dataclass(frozen=True, init=False, repr=False)
class Interval:
    """A closed interval of real numbers, possibly unbounded or empty (IEEE 1788-2015, clause 7.2).

    Every operation rounds outward and raises `RoundingModeError` where the processor does not round to nearest. ``+ - * /``, ``** n``,
    ``abs``, ``&`` (intersection) and ``|`` (hull) give the smallest interval of doubles around the exact set, or for n beyond ±2 nearly so.
    Functions such as `sqrt` and `sin` are those of `ial.contractors`. A number given to the constructor or to an operation stands for
    itself: an integer or a fraction that is not a double becomes the interval between the two doubles around it.

    ``==`` tells whether two intervals are the same set, and ``in`` whether a number or a whole interval lies in one. ``<`` and its like are
    not defined, since intervals can be ordered in several ways: see `less` and `precedes`.

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
    TypeError
        If a bound is not a real number.
    """

    lower: float
    upper: float

    operand_rank: ClassVar[int] = 0

    def __init__(self, lower: Number, upper: Number | None = None) -> None:
        low, high = below(lower), above(lower if upper is None else upper)
        if math.isnan(low) or math.isnan(high):
            raise ValueError(f"an interval has the bounds {low} and {high}; a bound cannot be NaN")
        if low > high:
            raise ValueError(f"an interval has the bounds {low} > {high}; give the lower one first, or use Interval.empty()")
        if low == math.inf or high == -math.inf:
            raise ValueError(f"an interval has the bounds {low} and {high}, and no real number lies between them; use Interval.empty()")
        self._set(low, high)

    def _set(self, lower: float, upper: float) -> None:
        object.__setattr__(self, "lower", lower + 0.0)  # -0.0 and 0.0 are the same bound; it is written 0.0
        object.__setattr__(self, "upper", upper + 0.0)

    @classmethod
    def of_bounds(cls, lower: float, upper: float) -> "Interval":
        """Return the interval with exactly these doubles as bounds, unchecked; (inf, -inf) is the empty one."""
        interval = object.__new__(cls)
        interval._set(float(lower), float(upper))
        return interval

    @classmethod
    def empty(cls) -> "Interval":
        """Return the empty interval, whose bounds are (inf, -inf)."""
        return cls.of_bounds(math.inf, -math.inf)

    @classmethod
    def entire(cls) -> "Interval":
        """Return the real line."""
        return cls.of_bounds(-math.inf, math.inf)

    @classmethod
    def parse(cls, text: str) -> "Interval":
        """Return the smallest interval around what a text denotes, such as ``[1.0, 2.0]``, ``[1/3]``, ``[empty]``, ``[,]`` or ``3.56?1``.

        See `ial.contractors.intervals.literal.bounds_of_literal` for the forms and for what is raised (IEEE 1788-2015, textToInterval,
        12.11). What `hex` writes is read back exactly; the decimals that `str` writes are taken at their word, and an interval around them
        is given.
        """
        return cls.of_bounds(*bounds_of_literal(text))

    @staticmethod
    def operate(operation: Forward, operands: Sequence[Operand]) -> "Interval":
        """Return the result of an operation on intervals and numbers."""
        return _apply(operation.forward, *operands)

    # What it is.

    @property
    def is_empty(self) -> bool:
        """Whether no number lies in the interval."""
        return self.lower > self.upper

    @property
    def is_entire(self) -> bool:
        """Whether it is the real line."""
        return bool(sets.is_entire(self.lower, self.upper))

    @property
    def is_point(self) -> bool:
        """Whether it is a single number."""
        return self.lower == self.upper

    @property
    def is_bounded(self) -> bool:
        """Whether it has two finite bounds; the empty interval has none."""
        return bool(sets.is_common(self.lower, self.upper))

    @property
    def width(self) -> float:
        """The width, rounded up; NaN if empty (IEEE 1788-2015, 10.5.9)."""
        return _number(sets.width, self)

    @property
    def midpoint(self) -> float:
        """The double nearest to the middle, always inside; NaN if empty, 0 for the real line (IEEE 1788-2015, 10.5.9)."""
        return _number(sets.midpoint, self)

    @property
    def radius(self) -> float:
        """The smallest double r for which `midpoint` ± r encloses the interval; NaN if empty (IEEE 1788-2015, 10.5.9)."""
        return _number(sets.radius, self)

    @property
    def magnitude(self) -> float:
        """The largest absolute value; NaN if empty (IEEE 1788-2015, 10.5.9)."""
        return _number(sets.magnitude, self)

    @property
    def mignitude(self) -> float:
        """The smallest absolute value; NaN if empty (IEEE 1788-2015, 10.5.9)."""
        return _number(sets.mignitude, self)

    # How it lies beside another one (IEEE 1788-2015, 9.5, 10.5.10, 10.6.4).

    def __contains__(self, other: Operand) -> bool:
        """Return whether a number, or every number of an interval, lies in this one."""
        if isinstance(other, Interval):
            return other.subset(self)
        return bool(self.lower <= below(other) and above(other) <= self.upper and abs(other) != math.inf)

    def subset(self, other: Operand) -> bool:
        """Return whether every number of this interval lies in the other one."""
        return _ask(sets.subset, self, other)

    def interior(self, other: Operand) -> bool:
        """Return whether every number of this interval lies in the interior of the other one."""
        return _ask(sets.interior, self, other)

    def disjoint(self, other: Operand) -> bool:
        """Return whether the two have no number in common."""
        return _ask(sets.disjoint, self, other)

    def less(self, other: Operand) -> bool:
        """Return whether both bounds are at most those of the other one."""
        return _ask(sets.less, self, other)

    def strict_less(self, other: Operand) -> bool:
        """Return whether both bounds are less than those of the other one; two that are the same infinity pass."""
        return _ask(sets.strict_less, self, other)

    def precedes(self, other: Operand) -> bool:
        """Return whether no number of this interval is above one of the other."""
        return _ask(sets.precedes, self, other)

    def strict_precedes(self, other: Operand) -> bool:
        """Return whether every number of this interval is below every one of the other."""
        return _ask(sets.strict_precedes, self, other)

    def overlap(self, other: Operand) -> str:
        """Return the state of the two: "before", "meets", "containedBy" or another of the sixteen names of IEEE 1788-2015, 10.6.4."""
        b = _interval(other)
        return sets.OVERLAPS[sets.overlap(self.lower, self.upper, b.lower, b.upper)]

    # Arithmetic. What is not known here, such as an expression or boxes, may know what to do with an interval.

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

    def __pow__(self, exponent: Operand) -> "Interval":
        """Return the powers. A whole number n multiplies: any base. Other exponents, and intervals, need a base >= 0 (table 9.1, pow)."""
        n = whole(exponent)
        if n is None:
            return _apply(arithmetic.sqrt, self) if is_number(exponent) and exponent == 0.5 else _binary(powers.pow, self, exponent)
        if abs(n) >= 2**63:
            raise ValueError(f"the exponent is {exponent}; a whole exponent must lie between -2**63 and 2**63")
        check_rounding()
        power = arithmetic.sqr(self.lower, self.upper) if n == 2 else powers.pown(self.lower, self.upper, n)
        return Interval.of_bounds(*power)

    def __rpow__(self, base: Operand) -> "Interval":
        return _binary(powers.pow, base, self)

    def __neg__(self) -> "Interval":
        return _apply(arithmetic.neg, self)

    def __pos__(self) -> "Interval":
        return self

    def __abs__(self) -> "Interval":
        return _apply(arithmetic.absolute, self)

    def __and__(self, other: Operand) -> "Interval":
        return _binary(sets.intersect, self, other)

    def __or__(self, other: Operand) -> "Interval":
        return _binary(sets.hull, self, other)

    __rand__, __ror__ = __and__, __or__

    def cancel_minus(self, other: Operand) -> "Interval":
        """Return the smallest z with other + z enclosing this interval: it undoes an addition (IEEE 1788-2015, 9.2, 10.5.6).

        The real line where there is none, because one of the two is unbounded or the other one is wider.
        """
        return _apply(arithmetic.cancel_minus, self, other)

    def cancel_plus(self, other: Operand) -> "Interval":
        """Return `cancel_minus` of −other (IEEE 1788-2015, 9.2, 10.5.6)."""
        return _apply(arithmetic.cancel_plus, self, other)

    # How it is written.

    def __repr__(self) -> str:
        return "Interval.empty()" if self.is_empty else f"Interval({self.lower}, {self.upper})"

    def __str__(self) -> str:
        return "[empty]" if self.is_empty else f"[{self.lower}, {self.upper}]"

    def hex(self) -> str:
        """Return a text that `parse` reads back exactly (IEEE 1788-2015, intervalToExact, 13.4)."""
        return "[empty]" if self.is_empty else f"[{self.lower.hex()}, {self.upper.hex()}]"


def _interval(operand: Operand) -> Interval:
    return operand if isinstance(operand, Interval) else Interval(operand)


def _apply(kernel: Callable[..., tuple[float, float]], *operands: Operand) -> Interval:
    check_rounding()
    sides = [side for operand in map(_interval, operands) for side in (operand.lower, operand.upper)]
    return Interval.of_bounds(*kernel(*sides))


def _binary(kernel: Callable[..., tuple[float, float]], a: Operand, b: Operand) -> Interval:
    if not all(isinstance(operand, Interval) or is_number(operand) for operand in (a, b)):
        return NotImplemented  # type: ignore[no-any-return]
    return _apply(kernel, a, b)


def _ask(kernel: Callable[..., bool], a: Interval, other: Operand) -> bool:
    b = _interval(other)
    return bool(kernel(a.lower, a.upper, b.lower, b.upper))


def _number(kernel: Callable[..., float], a: Interval) -> float:
    check_rounding()
    return float(kernel(a.lower, a.upper))
