import math
from collections.abc import Callable
from decimal import Decimal
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from ial.contractors.boxes import Boxes
from ial.contractors.expressions.constraint import Constraint, ConstraintFamily
from ial.contractors.expressions.expression import Expression
from ial.contractors.expressions.function import Function
from ial.contractors.expressions.functions import absolute, cos, hypot, log, minimum, multiply_add, neg, pow, sin, sqrt
from ial.contractors.expressions.variables import variables
from ial.contractors.intervals.interval import Interval

x, y = variables("x y")
BOX = Boxes.of([(2, 3), (-1, 4)])


def value(expression: Expression, box: Boxes = BOX) -> tuple[float, float]:
    """Return the range on a box; rows of constants are taken at the first row."""
    lower, upper = Function(expression).tape.evaluate(box) if expression.count == 1 else _rows(expression, box)
    return float(lower[0, 0]), float(upper[0, 0])


def _rows(expression: Expression, box: Boxes) -> Any:
    return (expression == 0.0).tape.evaluate(box, expression.count)


NUMBERS = [3, 3.0, np.float64(3), np.float32(3), np.int64(3), np.uint8(3), Fraction(3), Decimal(3), Interval(3), Boxes.of([(3, 3)])]


@pytest.mark.parametrize("three", NUMBERS, ids=lambda one: type(one).__name__)
def test_operators_with_numbers_on_both_sides(three: Any) -> None:
    for formula, expected in (
        (x + three, (5, 6)),
        (three + x, (5, 6)),
        (x - three, (-1, 0)),
        (three - x, (0, 1)),
        (x * three, (6, 9)),
        (three * x, (6, 9)),
        (x / three, (2 / 3, 1)),
        (three / x, (1, 1.5)),
    ):
        assert isinstance(formula, Expression)
        assert value(formula) == pytest.approx(expected, abs=1e-15)
    assert value(Expression.__rpow__(x, 3)) == pytest.approx((9, 27))
    for relation, text in (
        (x == three, "=="),
        (x <= three, "<="),
        (x >= three, ">="),
        (three == x, "=="),
        (three >= x, "<="),
        (three <= x, ">="),
    ):
        assert repr(relation) == f"x {text} [3.0, 3.0]"


@pytest.mark.parametrize(
    "rows", [np.array([1.0, 2.0, 4.0]), np.array([1, 2, 4]), np.array([1, 2, 4], dtype=np.float32), Boxes.of([(1, 1)], [(2, 2)], [(4, 4)])]
)
def test_operators_with_rows_on_both_sides(rows: Any) -> None:
    for expression, text in (
        (x + rows, "(x + <3 constants>)"),
        (rows - x, "(<3 constants> - x)"),
        (rows * x, "(<3 constants> * x)"),
        (rows / x, "(<3 constants> / x)"),
    ):
        assert repr(expression) == text
        assert expression.count == 3
    lower, upper = (rows * x == 0).tape.evaluate(BOX, 3)
    assert lower[:, 0].tolist() == [2, 4, 8]
    assert upper[:, 0].tolist() == [3, 6, 12]
    for relation in (x == rows, rows == x, x <= rows, rows >= x):
        assert type(relation) is ConstraintFamily
        assert relation.count == 3


def test_numbers_that_are_no_doubles_are_enclosed() -> None:
    third = (x * Fraction(1, 3)).operands[1].value
    assert third.lower < third.upper
    assert Fraction(third.lower) < Fraction(1, 3) < Fraction(third.upper)
    large = Expression.of(np.array([2**53 + 1, 5]))
    assert large.bounds is not None
    assert large.bounds[0].tolist() == [2.0**53, 5.0]
    assert large.bounds[1].tolist() == [2.0**53 + 2, 5.0]


def test_how_expressions_are_written() -> None:
    for expression, text in (
        ((x + 1) * (y - 0.25), "((x + 1) * (y - 0.25))"),
        (-x / y, "(-x / y)"),
        (x**2 + y**3, "(x**2 + y**3)"),
        ((-x) ** 2, "(-x)**2"),
        ((x**2) ** 3, "(x**2)**3"),
        (x**-1, "x**-1"),
        (x**0.5, "sqrt(x)"),
        (abs(x), "absolute(x)"),
        (x + Interval(1, 2), "(x + [1.0, 2.0])"),
        (x + 1234567.125, "(x + 1234567.125)"),
        (hypot(x, 3) == 4, "hypot(x, 3) == [4.0, 4.0]"),
        (x <= y, "x <= y"),
    ):
        assert repr(expression) == text


def test_long_formulas_are_written_in_part() -> None:
    total: Any = sum((float(i) + 0.5) * x for i in range(3000))
    shared = x
    for _ in range(200):
        shared = shared * 0.5 + shared
    for expression in (total, shared):
        assert "…" in repr(expression == 1)
        assert len(repr(expression)) < 1000


def test_simplifications() -> None:
    assert x + 0 is x
    assert 0 + x is x
    assert x - 0 is x
    assert x * 1 is x
    assert 1 * x is x
    assert x / 1 is x
    assert x**1 is x
    assert +x is x
    assert repr(x * x) == repr(x**2) == "x**2"
    assert repr(1 / x) == "recip(x)"
    assert repr(0 - x) == "(0 - x)"
    assert repr(x * 0) == "(x * 0)"
    assert (x + np.zeros(4)).count == (x * np.ones(4)).count == 4
    assert x + Interval(0, 1) is not x


@pytest.mark.parametrize(
    ("exponent", "expected"),
    [
        (0, (1, 1)),
        (2, (4, 9)),
        (2.0, (4, 9)),
        (3, (8, 27)),
        (-2, (1 / 9, 1 / 4)),
        (0.5, (math.sqrt(2), math.sqrt(3))),
        (Fraction(1, 2), (math.sqrt(2), math.sqrt(3))),
        (Fraction(3, 1), (8, 27)),
        (np.int64(3), (8, 27)),
        (1.5, (2**1.5, 3**1.5)),
        (Interval(1, 2), (2, 9)),
    ],
)
def test_powers(exponent: Any, expected: tuple[float, float]) -> None:
    assert value(x**exponent) == pytest.approx(expected)


def test_powers_of_expressions() -> None:
    assert repr(x**y) == "pow(x, y)" == repr(pow(x, y))
    assert repr(2**x) == "pow(2, x)"
    assert value(y**3) == (-1, 64)
    assert value(y**2) == (0, 16)
    assert repr(x ** Fraction(2**60 + 1, 2)).startswith("pow(")


def test_vectors_and_matrices() -> None:
    p, s = variables("p[3] s")
    assert p.shape == (3,)
    assert repr(p[2]) == "p[2]"
    assert repr(s) == "s"
    matrix = np.array([[1.0, 2.0, 0.0], [0.0, -1.0, 3.0]])
    box = Boxes.of([(1, 2), (0, 1), (-1, 0), (5, 6)])
    image = Function(*(matrix @ p), p @ p, *(s * p), *(p - s), *(p / 2), *neg(p)).image(box)
    assert image.lower[0].tolist() == [1, -4, 1, 5, 0, -6, -5, -6, -7, 0.5, 0, -0.5, -2, -1, 0]
    assert image.upper[0].tolist() == [4, 0, 6, 12, 6, 0, -3, -4, -5, 1, 0.5, 0, -1, 0, 1]
    assert repr(sin(p)[1]) == "sin(p[1])"
    assert repr(sum(p)) == "((p[0] + p[1]) + p[2])"


def test_functions_of_expressions_numbers_and_rows() -> None:
    assert repr(minimum(x, 3)) == "minimum(x, 3)"
    assert repr(multiply_add(2, x, np.array([1.0, 2.0]))) == "multiply_add(2, x, <2 constants>)"
    assert value(absolute(y)) == (0, 4)
    assert value(cos(x * 0)) == pytest.approx((1, 1))


@pytest.mark.parametrize("names", ["", "  ", "x x", "p[2] p", "1x", "x,y", "x-y", "p[0]", "p[00]", "p[-1]", "p[a]", ["x"], None])
def test_names_that_declare_nothing(names: Any) -> None:
    with pytest.raises(ValueError, match="declares"):
        variables(names)


def test_names() -> None:
    assert repr(variables("θ x_1")) == "(θ, x_1)"
    assert variables("p[1]").shape == (1,)
    assert variables("x p[2]")[0].space.names == ("x", "p[0]", "p[1]")


@pytest.mark.parametrize(
    ("call", "error", "message"),
    [
        (lambda: x + variables("z"), ValueError, "the variables x y and z were declared apart"),
        (lambda: bool(x), TypeError, "an expression has no truth value"),
        (lambda: 0 <= x <= 1, TypeError, "has no truth value; write a & b"),
        (lambda: (x <= 1) and (y <= 1), TypeError, "has no truth value"),
        (lambda: x + "1", TypeError, "unsupported operand"),
        (lambda: x + True, TypeError, "unsupported operand"),
        (lambda: [1] * x, TypeError, "unsupported operand|can't multiply"),
        (lambda: x + None, TypeError, "unsupported operand"),
        (lambda: x == "1", TypeError, "compares an expression with str"),
        (lambda: x == [1, 2], TypeError, "compares an expression with list"),
        (lambda: x <= np.array([y, y]), TypeError, "compares an expression with ndarray"),
        (lambda: x + np.zeros((2, 2)), ValueError, r"an array of shape \(2, 2\)"),
        (lambda: x + np.zeros(0), ValueError, r"an array of shape \(0,\)"),
        (lambda: x + np.array([1.0, math.nan]), ValueError, "give finite numbers"),
        (lambda: x + np.array([1j]), ValueError, "type complex128"),
        (lambda: x + math.nan, ValueError, "cannot be NaN"),
        (lambda: x + BOX, ValueError, "1 boxes of 2 dimensions"),
        (lambda: x + np.zeros(2) + np.ones(3), ValueError, "combines constants of 2 and 3 rows"),
        (lambda: x + np.ones(2) == np.ones(3), ValueError, "stands for 2 formulas and is compared with 3 intervals"),
        (lambda: Expression.of(1.0) == 2, ValueError, "holds no variable"),
        (lambda: x**1e300, ValueError, "whole number of at most"),
        (lambda: log(x).value, TypeError, r"log\(x\) is not a constant"),
    ],
)
def test_errors(call: Callable[[], Any], error: type[Exception], message: str) -> None:
    with pytest.raises(error, match=message):
        call()


def test_comparisons_make_constraints() -> None:
    box = Boxes.of([(0, 10), (0, 10)])
    for relation, lower, upper in (
        (x == Interval(2, 3), 2, 3),
        (Interval(2, 3) == x, 2, 3),
        (x <= 3, 0, 3),
        (x < 3, 0, 3),
        (x >= 3, 3, 10),
        (x > 3, 3, 10),
        (x >= Interval(2, 3), 2, 10),
        (sqrt(x) == 3, 9, 9),
        ((x == y + 12 - 4) & (y <= 1), 8, 10),
    ):
        assert isinstance(relation, Constraint)
        narrowed = relation.contract(box)
        assert (narrowed.lower[0, 0], narrowed.upper[0, 0]) == (lower, upper)
    assert (x == None) is False  # noqa: E711
