"""Random formulas over all operations, and two slow answers to compare with: one of intervals, one of numbers of many digits."""

import math
from collections.abc import Callable, Sequence
from typing import Any

import mpmath as mp
import numpy as np

from ial.contractors.boxes import Boxes
from ial.contractors.expressions.expression import Expression
from ial.contractors.expressions.functions import OPERATIONS
from ial.contractors.expressions.operation import Operation
from ial.contractors.expressions.tape import ordered
from ial.contractors.intervals.interval import Interval
from tests.contractors.oracles import FloatArray, Pairs

mp.mp.dps = 60
_LARGEST = mp.mpf(10) ** 18  # numbers beyond are given up: sixty digits would not do for their sine


def _where(defined: Callable[..., bool], function: Callable[..., Any]) -> Callable[..., Any]:
    return lambda *operands: function(*operands) if defined(*operands) else None


def _root(a: Any, n: Any) -> Any:
    if (n < 0 and a == 0) or (n % 2 == 0 and a < 0):
        return None
    return mp.sign(a) * mp.root(abs(a), abs(int(n))) ** int(mp.sign(n)) if a else a


def _away(a: Any) -> Any:
    return mp.sign(a) * mp.floor(abs(a) + mp.mpf(1) / 2)


def _even(a: Any) -> Any:
    below = mp.floor(a)
    rest = a - below
    return below + (rest > 0.5 or (rest == 0.5 and below % 2 == 1))


REAL: dict[str, Callable[..., Any]] = {
    "add": lambda a, b: a + b,
    "sub": lambda a, b: a - b,
    "mul": lambda a, b: a * b,
    "div": _where(lambda a, b: b != 0, lambda a, b: a / b),
    "neg": lambda a: -a,
    "recip": _where(lambda a: a != 0, lambda a: 1 / a),
    "sqr": lambda a: a * a,
    "sqrt": _where(lambda a: a >= 0, mp.sqrt),
    "absolute": abs,
    "minimum": min,
    "maximum": max,
    "multiply_add": lambda a, b, c: a * b + c,
    "sign": mp.sign,
    "floor": mp.floor,
    "ceil": mp.ceil,
    "trunc": lambda a: mp.sign(a) * mp.floor(abs(a)),
    "round_ties_to_even": _even,
    "round_ties_to_away": _away,
    "pown": _where(lambda a, n: a != 0 or n >= 0, lambda a, n: a ** int(n)),
    "rootn": _root,
    "pow": _where(lambda a, b: a > 0 or (a == 0 and b > 0), lambda a, b: a**b if a else a),
    "exp": mp.exp,
    "exp2": lambda a: mp.mpf(2) ** a,
    "exp10": lambda a: mp.mpf(10) ** a,
    "log": _where(lambda a: a > 0, mp.log),
    "log2": _where(lambda a: a > 0, lambda a: mp.log(a, 2)),
    "log10": _where(lambda a: a > 0, mp.log10),
    "sinh": mp.sinh,
    "cosh": mp.cosh,
    "tanh": mp.tanh,
    "asinh": mp.asinh,
    "acosh": _where(lambda a: a >= 1, mp.acosh),
    "atanh": _where(lambda a: abs(a) < 1, mp.atanh),
    "sin": mp.sin,
    "cos": mp.cos,
    "tan": mp.tan,
    "asin": _where(lambda a: abs(a) <= 1, mp.asin),
    "acos": _where(lambda a: abs(a) <= 1, mp.acos),
    "atan": mp.atan,
    "atan2": _where(lambda y, x: y != 0 or x != 0, mp.atan2),
    "hypot": mp.hypot,
}
"""The operations on numbers; None where one is not defined."""

SMOOTH = [name for name, operation in OPERATIONS.items() if operation.derivative is not None]
"""The names of the operations that have a derivative."""

EXPONENTS = ("pown", "rootn")
"""Those whose second operand is a constant whole number."""


def operands_of(operation: Operation, operands: Sequence[Any], exponent: int) -> list[Any]:
    """Return as many operands as an operation takes, with the exponent as the second one where it needs a number."""
    return [operands[0], exponent] if operation.name in EXPONENTS else list(operands[: operation.arity])


def random_formula(
    rng: np.random.Generator, variables: Sequence[Expression], steps: int, names: Sequence[str] = tuple(OPERATIONS)
) -> Expression:
    """Return a formula that holds a variable, in which what was computed before is often used again, and some constants are intervals."""
    pool: list[Any] = list(variables)
    for _ in range(steps):
        operation = OPERATIONS[str(rng.choice(names))]
        recent = pool[-3:] + list(variables)
        operands = [recent[rng.integers(len(recent))] for _ in range(3)]
        for at in range(1, 3):
            if rng.random() < 0.3:
                number = round(float(rng.uniform(-3.0, 3.0)), 1)
                operands[at] = Interval(number, number + 0.5) if rng.random() < 0.3 else number
        pool.append(operation(*operands_of(operation, operands, int(rng.choice([-3, -2, -1, 1, 2, 3, 4])))))
    return next(node for node in reversed(pool) if node.bounds is None)


def interval_value(expression: Expression, box: Sequence[Interval], row: int = 0) -> Interval:
    """Return the natural extension on one box, one operation after the other."""
    values: dict[int, Interval] = {}
    for node in ordered([expression]):
        if node.axis is not None:
            value = box[node.axis]
        elif node.bounds is not None:
            value = Interval.of_bounds(*(side[row % len(side)] for side in node.bounds))
        else:
            assert node.operation is not None
            value = Interval.operate(node.operation, [values[id(operand)] for operand in node.operands])
        values[id(node)] = value
    return values[id(expression)]


def real_value(expression: Expression, point: Sequence[Any]) -> Any:
    """Return the value at a point as a number of many digits, with each constant interval at its lower end.

    None where there is none, and NaN where numbers become so large that it is given up.
    """
    values: dict[int, Any] = {}
    for node in ordered([expression]):
        if node.axis is not None:
            value = mp.mpf(point[node.axis])
        elif node.bounds is not None:
            value = mp.mpf(float(node.bounds[0][0]))
        else:
            assert node.operation is not None
            operands = [values[id(operand)] for operand in node.operands]
            value = REAL[node.operation.name](*operands)
        if value is None or abs(value) > _LARGEST:
            return value if value is None else mp.nan
        values[id(node)] = value
    return values[id(expression)]


def is_known(value: Any) -> bool:
    """Return whether `real_value` found a number."""
    return value is not None and not mp.isnan(value)


def boxes_around(points: FloatArray, rng: np.random.Generator) -> Boxes:
    """Return boxes that hold points, shape (n, d): sides from 0 to 2, with the point often at an end, and some without an end."""
    sides = []
    for sign in (-1.0, 1.0):
        reach = rng.choice([0.0, 1e-9, 0.1, 1.0, math.inf], points.shape, p=[0.3, 0.1, 0.3, 0.25, 0.05]) * rng.uniform(
            0.1, 1.0, points.shape
        )
        sides.append(points + sign * reach)
    return Boxes(*sides)


def lost(boxes: Boxes, points: FloatArray) -> FloatArray:
    """Return the points of which each is not in the box of its row."""
    return points[~((boxes.lower <= points) & (points <= boxes.upper)).all(axis=1)]


def assert_same(result: Pairs, expected: Pairs) -> None:
    """Fail if any bound differs by a bit; -0.0 and 0.0 are the same bound."""
    for ours, theirs in zip(result, expected, strict=True):
        np.testing.assert_array_equal(ours, theirs)
