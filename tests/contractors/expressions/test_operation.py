import math
from typing import Any

import numpy as np
import pytest

from ial.contractors.boxes import Boxes
from ial.contractors.expressions.function import Function
from ial.contractors.expressions.functions import OPERATIONS, add, atan2, exp, hypot, sin, sqrt
from ial.contractors.expressions.operation import LANES, Operation
from ial.contractors.expressions.variables import variables
from ial.contractors.intervals.interval import Interval
from ial.contractors.intervals.sets import intersect
from ial.contractors.kernels import kernel
from ial.contractors.rounding import down, up
from tests.contractors.formulas import EXPONENTS, assert_same, lost
from tests.contractors.oracles import Pairs, intervals, rows

COUNT = 2 * LANES + 45


def operands(operation: Operation, seed: int) -> list[Pairs]:
    chosen = [intervals(COUNT, seed + 10 * k) for k in range(operation.arity)]
    if operation.name in EXPONENTS:
        exponent = np.random.default_rng(seed).integers(1, 6, COUNT) * np.random.default_rng(seed + 1).choice([-1.0, 1.0], COUNT)
        chosen[1] = exponent, exponent
    return chosen


@pytest.mark.parametrize("operation", OPERATIONS.values(), ids=OPERATIONS)
def test_arrays_boxes_and_intervals_give_what_the_kernel_gives(operation: Operation) -> None:
    given = operands(operation, 1)
    expected = rows(operation.forward, *given)
    ours = operation.bounds(*given)
    assert_same(ours, expected)
    for i in range(0, COUNT, 17):
        one = operation(*(Interval.of_bounds(lower[i], upper[i]) for lower, upper in given))
        assert (one.lower, one.upper) == (expected[0][i], expected[1][i])
    if operation.name not in EXPONENTS:
        boxes = operation(*(Boxes(lower[:, None], upper[:, None]) for lower, upper in given))
        assert_same((boxes.lower[:, 0], boxes.upper[:, 0]), expected)


@pytest.mark.parametrize("count", [0, 1, LANES - 1, LANES, LANES + 1, 5000])
def test_results_do_not_depend_on_how_many_rows_there_are(count: int) -> None:
    given = [intervals(5000, 5), intervals(5000, 6)]
    lower, upper = hypot.bounds(*given)
    assert_same(hypot.bounds(*((low[:count], high[:count]) for low, high in given)), (lower[:count], upper[:count]))


def test_arrays_of_intervals_are_broadcast() -> None:
    column, row = np.arange(3.0)[:, None], np.arange(4.0)
    lower, upper = add.bounds((column, column + 1.0), (row, row))
    assert np.array_equal(lower, column + row)
    assert np.array_equal(upper, column + row + 1.0)


def test_an_operation_is_applied_to_every_member_of_a_vector() -> None:
    p, x = variables("p[3] x")
    assert str(sin(p)) == "[sin(p[0]) sin(p[1]) sin(p[2])]"
    assert str(atan2(x, p)) == "[atan2(x, p[0]) atan2(x, p[1]) atan2(x, p[2])]"
    assert str(hypot(p, np.array([1.0, 2.0, 3.0]))) == "[hypot(p[0], 1) hypot(p[1], 2) hypot(p[2], 3)]"
    column = Boxes.of([(1, 2)], [(3, 4)])
    assert [one.count for one in hypot(p, column)] == [2, 2, 2]


@pytest.mark.parametrize(
    ("call", "error", "message"),
    [
        (lambda: sqrt(), TypeError, "sqrt takes 1 operand; 0 were given"),
        (lambda: atan2(1.0), TypeError, "atan2 takes 2 operands; 1 were given"),
        (lambda: sin(np.zeros(3)), TypeError, "sin is applied to an array of numbers"),
    ],
)
def test_wrong_operands(call: Any, error: type[Exception], message: str) -> None:
    with pytest.raises(error, match=message):
        call()


def cube(al: float, au: float) -> tuple[float, float]:
    """Return a³."""
    if al > au:
        return math.inf, -math.inf
    return (down(down(al * al * al)), up(up(au * au * au))) if max(abs(al), abs(au)) > 1e-100 else (-1e-300, 1e-300)


def cube_backward(rl: float, ru: float, al: float, au: float) -> tuple[float, float]:
    if rl > ru:
        return math.inf, -math.inf
    low, high = np.sign(rl) * abs(rl) ** (1.0 / 3.0), np.sign(ru) * abs(ru) ** (1.0 / 3.0)
    return low - 1e-12 * abs(low) - 1e-90, high + 1e-12 * abs(high) + 1e-90  # not met with a


@pytest.fixture(scope="module")
def user_cube() -> Operation:
    return Operation("cube", cube, cube_backward, derivative=lambda a, r: (3.0 * a * a,))


def test_an_operation_of_plain_functions(user_cube: Operation) -> None:
    x, y = variables("x y")
    assert user_cube.__doc__ == "Return a³."
    assert repr(user_cube) == "<operation cube>"
    assert 8.0 in user_cube(2)
    assert user_cube(2).width < 1e-14
    assert repr(user_cube(x) + y) == "(cube(x) + y)"
    assert not user_cube.bounds(*[(np.empty(0), np.empty(0))])[0].size
    constraint = user_cube(x) + y == 10
    narrowed = constraint.contract(Boxes.of([(0, 5), (1, 2)]))
    assert np.allclose(narrowed.lower, [[2.0, 1.0]])
    assert np.allclose(narrowed.upper, [[9.0 ** (1 / 3), 2.0]])
    narrow = Boxes.of([(2.01, 2.02), (1, 2)])  # what it returns may be wider than its operands
    assert_same((constraint.contract(narrow).lower[:, 0], constraint.contract(narrow).upper[:, 0]), ([2.01], [2.02]))
    assert constraint.contract(Boxes.of([(3, 5), (1, 2)])).empty.all()
    lower, upper = Function(user_cube(x) * y).jacobian(Boxes.of([(2, 2), (1, 1)]))
    assert np.allclose([lower, upper], [12.0, 8.0])
    rng = np.random.default_rng(3)
    points = rng.uniform(-3.0, 3.0, (2000, 2))
    points[:, 1] = 5.0 - points[:, 0] ** 3
    boxes = Boxes(points - rng.random((2000, 2)), points + rng.random((2000, 2)))
    assert not len(lost((user_cube(x) + y == Interval(5 - 1e-9, 5 + 1e-9)).contract(boxes), points))


def test_an_operation_of_kernels_of_the_user_without_a_derivative() -> None:
    @kernel
    def forward(al, au, bl, bu):  # type: ignore[no-untyped-def]
        return max(al, bl), max(au, bu)

    @kernel
    def back(rl, ru, al, au, bl, bu):  # type: ignore[no-untyped-def]
        al, au = intersect(al, au, -np.inf, ru)
        bl, bu = intersect(bl, bu, -np.inf, ru)
        return al, au, bl, bu

    larger = Operation("larger", forward, back, doc="Return the larger.")
    x, y = variables("x y")
    assert larger.__doc__ == "Return the larger."
    assert (larger(x, y) <= 1).contract(Boxes.of([(0, 3), (-1, 5)])).upper.tolist() == [[1.0, 1.0]]
    with pytest.raises(TypeError, match=r"larger\(x, y\) holds an operation without a derivative"):
        Function(larger(x, y)).jacobian(Boxes.of([(0, 3), (-1, 5)]))


def test_two_operations_of_one_name_are_two() -> None:
    x = variables("x")
    pair = [Operation("same", one, lambda rl, ru, al, au: (al, au)) for one in (lambda al, au: (al, au), lambda al, au: (-au, -al))]
    image = Function(pair[0](x), pair[1](x)).image(Boxes.of([(1, 2)]))
    assert_same((image.lower, image.upper), ([[1.0, -2.0]], [[2.0, -1.0]]))


missing = object()


def one(al: float, au: float) -> tuple[float, float]:
    return al, au


@pytest.mark.parametrize(
    ("forward", "backward", "error", "message"),
    [
        (lambda a: a, lambda r, s, a: a, ValueError, "'bad' must have one to three operands"),
        (one, one, ValueError, "'bad' must have one to three operands"),
        (lambda al, au, bl: (al, au), lambda rl, ru, al, au: (al, au), ValueError, "'bad' must have one to three operands"),
        (
            lambda a, b, c, d, e, f, g, h: (a, b),
            lambda a, b, c, d, e, f, g, h, i, j: (a, b),
            ValueError,
            "'bad' must have one to three operands",
        ),
    ],
)
def test_functions_that_are_no_operation(forward: Any, backward: Any, error: type[Exception], message: str) -> None:
    with pytest.raises(error, match=message):
        Operation("bad", forward, backward)


@pytest.mark.compiled
@pytest.mark.parametrize(
    ("forward", "backward", "direction"),
    [(lambda al, au: al, lambda rl, ru, al, au: (al, au), "forward"), (one, lambda rl, ru, al, au: str(rl)[missing], "backward")],
)
def test_functions_that_numba_cannot_compile(forward: Any, backward: Any, direction: str) -> None:
    with pytest.raises(TypeError, match=f"the function {direction} of the operation 'bad' cannot be compiled"):
        Operation("bad", forward, backward)


def test_a_derivative_with_a_slope_missing() -> None:
    x = variables("x")
    bad = Operation("bad", one, lambda rl, ru, al, au: (al, au), derivative=lambda a, r: ())
    with pytest.raises(ValueError, match="the derivative of bad has 0 parts for 1 operands"):
        Function(bad(x))


def test_numbers_stand_for_themselves() -> None:
    assert exp(0) == Interval(1.0)
    assert sqrt(Interval(4, 9)) == Interval(2, 3)
    assert sqrt(Boxes.of([(4, 9), (-4, 1)], [(-2, -1), (0, 1)])).upper.tolist() == [[3.0, 1.0], [-math.inf, -math.inf]]
    boxes = hypot(Boxes.of([(3, 3), (6, 6)]), np.array([4.0, 8.0]))
    assert boxes.lower.tolist() == boxes.upper.tolist() == [[5.0, 10.0]]
