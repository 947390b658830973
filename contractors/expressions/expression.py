"""`Expression`: what a user writes with variables, numbers and intervals; comparing it makes a `Constraint`."""

import math
import numbers
from collections.abc import Sequence
from decimal import Decimal
from typing import Any

import numpy as np

from ial.contractors.boxes import Boxes
from ial.contractors.expressions import functions
from ial.contractors.expressions.constraint import Constraint, ConstraintFamily
from ial.contractors.expressions.operation import IntervalArrays, Operation
from ial.contractors.expressions.tape import ordered
from ial.contractors.intervals.interval import Interval
from ial.contractors.space import Space, common_space

_LONGEST = 400  # a longer part of a formula is not written out
_SIGNS = {"add": "+", "sub": "-", "mul": "*", "div": "/"}


class Expression:
    """A formula over the variables of one space.

    Arithmetic with numbers, `Interval`, other expressions, and the functions of `ial.contractors` give expressions. A NumPy array of m
    numbers, or `Boxes` of one dimension for m intervals, is a constant that differs from row to row: what it becomes part of stands for m
    formulas at once.

    ``==``, ``<=`` and ``>=`` give a `Constraint`. Since sets are closed, ``<`` means ``<=``. An interval stands for any one number of it:
    ``x * Interval(1, 2) == 4`` holds where *some* factor in [1, 2] satisfies the equation. Where an interval is written a second time, it
    may stand for another number; in an expression that is used twice it stands for the same.
    """

    operand_rank = 2  # of a number, intervals, boxes and expressions, the expression decides what an operation gives
    __array_ufunc__ = None  # an array on the left leaves the operation to the expression on the right

    def __init__(
        self,
        space: Space | None,
        *,
        axis: int | None = None,
        bounds: IntervalArrays | None = None,
        operation: Operation | None = None,
        operands: tuple["Expression", ...] = (),
    ) -> None:
        self.space = space
        self.axis = axis
        self.bounds = bounds
        self.operation = operation
        self.operands = operands
        self.count: int = len(bounds[0]) if bounds is not None else max((operand.count for operand in operands), default=1)

    @property
    def value(self) -> Interval:
        """The value of a constant.

        Raises
        ------
        TypeError
            If the expression is not one constant.
        """
        if self.bounds is None or self.count != 1:
            raise TypeError(f"{self} is not a constant; an exponent n of pown and rootn must be one")
        return Interval.of_bounds(self.bounds[0][0], self.bounds[1][0])

    @staticmethod
    def of(operand: Any) -> "Expression":
        """Return an expression as it is; a number, an interval, m numbers or m intervals as a constant.

        Raises
        ------
        ValueError
            If an array does not hold finite numbers, one for each row, or boxes are not of one dimension.
        """
        if isinstance(operand, Expression):
            return operand
        if isinstance(operand, np.ndarray):
            if operand.dtype.kind not in "iuf" or operand.ndim != 1 or not len(operand) or not np.isfinite(operand).all():
                raise ValueError(
                    f"an array of shape {operand.shape} and type {operand.dtype} stands in an expression; "
                    "give finite numbers, one for each row, shape (m,)"
                )
            if operand.dtype.itemsize < 8 or operand.dtype == np.float64:
                values = operand.astype(np.float64)
                return Expression(None, bounds=(values, values))
            intervals = [Interval(value) for value in operand.tolist()]  # of numbers that need not be doubles
            return Expression(None, bounds=(np.array([each.lower for each in intervals]), np.array([each.upper for each in intervals])))
        if isinstance(operand, Boxes):
            if operand.dimension != 1 or not len(operand):
                raise ValueError(
                    f"{len(operand)} boxes of {operand.dimension} dimensions stand in an expression; give intervals, one for each row: "
                    "boxes of one dimension"
                )
            return Expression(None, bounds=(operand.lower[:, 0], operand.upper[:, 0]))
        interval = operand if isinstance(operand, Interval) else Interval(operand)
        return Expression(None, bounds=(np.array([interval.lower]), np.array([interval.upper])))

    @staticmethod
    def operate(operation: Operation, operands: Sequence[Any]) -> "Expression":
        """Return an operation applied to operands of which at least one is an expression."""
        nodes = tuple(Expression.of(operand) for operand in operands)
        if all(node.bounds is not None for node in nodes):
            folded = operation.bounds(*(node.bounds for node in nodes))  # type: ignore[arg-type]
            return Expression(None, bounds=(np.atleast_1d(folded[0]), np.atleast_1d(folded[1])))
        simpler = _simplified(operation, nodes)
        if simpler is not None:
            return simpler
        counts = {node.count for node in nodes if node.count > 1}
        if len(counts) > 1:
            raise ValueError(
                f"{operation.name} combines constants of {' and '.join(map(str, sorted(counts)))} rows; they must have as many"
            )
        return Expression(common_space(nodes), operation=operation, operands=nodes)

    def __add__(self, other: Any) -> Any:
        return _binary(functions.add, self, other)

    def __radd__(self, other: Any) -> Any:
        return _binary(functions.add, other, self)

    def __sub__(self, other: Any) -> Any:
        return _binary(functions.sub, self, other)

    def __rsub__(self, other: Any) -> Any:
        return _binary(functions.sub, other, self)

    def __mul__(self, other: Any) -> Any:
        return functions.sqr(self) if other is self else _binary(functions.mul, self, other)

    def __rmul__(self, other: Any) -> Any:
        return _binary(functions.mul, other, self)

    def __truediv__(self, other: Any) -> Any:
        return _binary(functions.div, self, other)

    def __rtruediv__(self, other: Any) -> Any:
        return functions.recip(self) if _is_number(other) and other == 1 else _binary(functions.div, other, self)

    def __pow__(self, exponent: Any) -> Any:
        if _is_number(exponent):
            if exponent == 1:
                return self
            if exponent == 2:
                return functions.sqr(self)
            if exponent == 0.5:
                return functions.sqrt(self)
            if exponent.denominator == 1 if isinstance(exponent, numbers.Rational) else float(exponent).is_integer():
                return functions.pown(self, int(exponent))
        return _binary(functions.pow, self, exponent)

    def __rpow__(self, base: Any) -> Any:
        return _binary(functions.pow, base, self)

    def __neg__(self) -> "Expression":
        return functions.neg(self)  # type: ignore[no-any-return]

    def __pos__(self) -> "Expression":
        return self

    def __abs__(self) -> "Expression":
        return functions.absolute(self)  # type: ignore[no-any-return]

    def __eq__(self, other: object) -> Any:
        return _relation(self, other, "==")

    def __le__(self, other: Any) -> Any:
        return _relation(self, other, "<=")

    def __ge__(self, other: Any) -> Any:
        return _relation(self, other, ">=")

    __lt__, __gt__ = __le__, __ge__
    __hash__ = object.__hash__

    def __bool__(self) -> bool:
        raise TypeError("an expression has no truth value")

    def __repr__(self) -> str:
        # From the operands up, each once: a formula may be deeper than Python's stack, and endless if what is shared were written out.
        texts: dict[int, str] = {}
        for node in ordered([self]):
            text = node._written([texts[id(operand)] for operand in node.operands])  # type: ignore[attr-defined]
            texts[id(node)] = text if len(text) <= _LONGEST else "…"
        return texts[id(self)]

    def _written(self, texts: list[str]) -> str:
        """Return how it is written, given the same of its operands."""
        if self.axis is not None and self.space is not None:
            return self.space.names[self.axis]
        if self.bounds is not None:
            if self.count > 1:
                return f"<{self.count} constants>"
            value = self.value
            return repr(value.lower).removesuffix(".0") if value.lower == value.upper else str(value)
        assert self.operation is not None
        name = self.operation.name
        if name in _SIGNS:
            return f"({texts[0]} {_SIGNS[name]} {texts[1]})"
        if name in ("sqr", "pown"):
            base = self.operands[0].operation
            text = f"({texts[0]})" if base is not None and base.name in ("neg", "sqr", "pown") else texts[0]
            return f"{text}**{texts[1] if name == 'pown' else 2}"
        return f"-{texts[0]}" if name == "neg" else f"{name}({', '.join(texts)})"


def _is_number(other: Any) -> bool:
    return isinstance(other, numbers.Real | Decimal) and not isinstance(other, bool)


def _is_operand(other: Any) -> bool:
    return _is_number(other) or isinstance(other, Expression | Interval | Boxes | np.ndarray)


def _binary(operation: Operation, a: Any, b: Any) -> Any:
    if not (_is_operand(a) and _is_operand(b)):
        return NotImplemented
    return operation(a, b)


def _simplified(operation: Operation, nodes: tuple[Expression, ...]) -> Expression | None:
    """Return an operand that equals the result wherever it is defined, if there is one: x + 0, 1·x, x − 0, x / 1."""
    left, right = nodes[0], nodes[-1]
    if operation in (functions.add, functions.sub) and _is(right, 0.0):
        return left
    if operation is functions.add and _is(left, 0.0):
        return right
    if operation in (functions.mul, functions.div) and _is(right, 1.0):
        return left
    if operation is functions.mul and _is(left, 1.0):
        return right
    return None


def _is(node: Expression, value: float) -> bool:
    return node.bounds is not None and node.count == 1 and bool(node.bounds[0][0] == value == node.bounds[1][0])


def _relation(left: Expression, other: Any, sign: str) -> Any:
    if isinstance(other, str | list | tuple) or (isinstance(other, np.ndarray) and other.dtype == object):
        raise TypeError(
            f"{left!r} {sign} {other!r} compares an expression with {type(other).__name__}; "
            "compare with numbers, an Interval, an array of numbers or an expression, and vectors member by member"
        )
    if not _is_operand(other):
        return NotImplemented
    right = Expression.of(other)
    expression, (lower, upper) = left, right.bounds if right.bounds is not None else (np.zeros(1), np.zeros(1))
    if right.bounds is None:
        expression = functions.sub(left, right)
    if expression.space is None:
        raise ValueError(f"{left!r} {sign} {right!r} holds no variable, so it constrains nothing")
    lower = np.full_like(lower, -math.inf) if sign == "<=" else lower
    upper = np.full_like(upper, math.inf) if sign == ">=" else upper
    if len(lower) > 1 and expression.count not in (1, len(lower)):
        raise ValueError(
            f"{left!r} stands for {expression.count} formulas and is compared with {len(lower)} intervals; there must be as many"
        )
    text = f"{left!r} {sign} {right.value if right.count == 1 and right.bounds is not None else repr(right)}"
    kind = Constraint if expression.count == len(lower) == 1 else ConstraintFamily
    return kind(expression.space, [(expression, (lower, upper))], text)
