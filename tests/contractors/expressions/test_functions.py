import math
from collections.abc import Callable
from typing import Any

import mpmath as mp
import numpy as np
import pytest

from ial.contractors.boxes import Boxes
from ial.contractors.expressions import functions
from ial.contractors.expressions.function import Function
from ial.contractors.expressions.functions import OPERATIONS
from ial.contractors.expressions.operation import Operation
from ial.contractors.expressions.tape import Tape
from ial.contractors.expressions.variables import variables
from ial.contractors.intervals.interval import Interval
from tests.cases import cases
from tests.contractors.formulas import EXPONENTS, REAL, SMOOTH, lost, operands_of
from tests.contractors.oracles import Pairs, intervals
from tests.contractors.solutions import around, points

COUNT = cases(800, 40)
PARTIAL = [name for name, operation in OPERATIONS.items() if operation.defined]
# Where a function is defined on all of an interval if it is at both ends.
CONVEX = ("sqrt", "log", "log2", "log10", "acosh", "atanh", "asin", "acos")
STEPS = ("sign", "floor", "ceil", "trunc", "round_ties_to_even", "round_ties_to_away")


def real(name: str, *operands: float) -> Any:
    return REAL[name](*(mp.mpf(float(operand)) for operand in operands))


def test_every_operation_is_a_function_of_its_name() -> None:
    assert set(OPERATIONS) == set(REAL)
    for name, operation in OPERATIONS.items():
        assert getattr(functions, name) is operation
        assert operation.__doc__
        assert operation.__doc__.startswith("Return ")


def applied(operation: Operation, exponent: int, same: bool = False) -> tuple[Any, int]:
    """Return an operation as an expression of its own variables, or of one for all operands, and the number of these."""
    count = 1 if same or operation.name in EXPONENTS else operation.arity
    declared = list(variables("p[3]")) if not same else [variables("x")] * 3
    return operation(*operands_of(operation, declared, exponent)), count


@pytest.mark.parametrize("name", OPERATIONS)
def test_going_backward_loses_no_point(name: str) -> None:
    operation = OPERATIONS[name]
    for same in (False, True):
        for exponent in (-3, 2) if name in EXPONENTS else (1,):
            expression, count = applied(operation, exponent, same)
            chosen = np.stack([points(COUNT, 7 + 10 * k, 4.0) for k in range(count)], axis=1)
            chosen = np.pad(chosen, ((0, 0), (0, expression.space.dimension - count)))
            tape = Tape(expression.space.dimension, [expression])
            value = tape.evaluate(Boxes(chosen, chosen))
            kept = np.flatnonzero(value[0][:, 0] <= value[1][:, 0])
            # At the edge of its domain an operation may have a value in the enclosure only.
            if operation.defined:
                kept = np.array(
                    [i for i in kept if real(name, *operands_of(operation, [chosen[i, k % count] for k in range(3)], exponent)) is not None]
                )
            chosen = chosen[kept]
            target = np.stack(around(value[0][kept, 0], value[1][kept, 0], 5))[:, :, None]
            sides = [around(chosen[:, axis], chosen[:, axis], 20 + axis) for axis in range(chosen.shape[1])]
            boxes = Boxes(*(np.stack([side[end] for side in sides], axis=1) for end in range(2)))
            narrowed = tape.narrow(boxes, target)
            assert not len(lost(narrowed, chosen))
            assert ((boxes.lower <= narrowed.lower) & (narrowed.upper <= boxes.upper)).all()
            changed = ((boxes.lower < narrowed.lower) | (narrowed.upper < boxes.upper)).mean()
            assert changed > 0.01 or (same and name in ("sub", "div"))  # x − x and x / x say nothing of x
            assert len(chosen) > COUNT // 8


@pytest.mark.parametrize("name", SMOOTH)
@pytest.mark.parametrize("same", [False, True])
def test_derivatives_enclose_those_of_numbers(name: str, same: bool) -> None:
    operation = OPERATIONS[name]
    rng = np.random.default_rng(11)
    for exponent in (-3, -2, 1, 2, 5) if name in EXPONENTS else (1,):
        expression, count = applied(operation, exponent, same)
        function = Function(expression)
        chosen = rng.uniform(-2.0, 2.0, (40, expression.space.dimension))
        chosen[::3] = abs(chosen[::3]) + (1.0 if name == "acosh" else 0.0)
        if name in ("atanh", "asin", "acos"):
            chosen /= 2.0
        boxes = Boxes(chosen, chosen)
        lower, upper = function.jacobian(boxes)
        wide = function.jacobian(Boxes(chosen - rng.uniform(0, 1, chosen.shape), chosen + rng.uniform(0, 1, chosen.shape)))
        known = np.flatnonzero(function.holds("defined", boxes))
        assert len(known) >= 10
        for i in known[:12]:
            x = [mp.mpf(float(chosen[i, 0 if same else k % chosen.shape[1]])) for k in range(3)]
            for axis in range(count):

                def along(t: Any, axis: int = axis, x: list[Any] = x, exponent: int = exponent) -> Any:
                    moved = [t if same or k == axis else x[k] for k in range(3)]
                    return REAL[name](*operands_of(operation, moved, exponent))

                slope = (along(x[axis] + mp.mpf(10) ** -20) - along(x[axis] - mp.mpf(10) ** -20)) / (2 * mp.mpf(10) ** -20)
                slack = mp.mpf(10) ** -25 * (1 + abs(slope))
                assert lower[i, 0, axis] - slack <= slope <= upper[i, 0, axis] + slack
                assert upper[i, 0, axis] - lower[i, 0, axis] <= 1e-12 * (1 + abs(slope))
                assert wide[0][i, 0, axis] - slack <= slope <= wide[1][i, 0, axis] + slack


def test_slopes_at_kinks() -> None:
    x, y = variables("x y")
    around_zero = Boxes.of([(-1, 1), (-1, 1)], [(0, 1), (-1, 0)])
    for expression, expected in (
        (abs(x), [[-1, 1], [0, 1]]),
        (functions.minimum(x, y), [[0, 1], [0, 0.5]]),
        (functions.maximum(x, y), [[0, 1], [0.5, 1]]),
        (functions.hypot(x, y), [[-math.inf, math.inf], [0, math.inf]]),
    ):
        lower, upper = Function(expression).jacobian(around_zero)
        assert np.stack([lower[:, 0, 0], upper[:, 0, 0]], axis=1).tolist() == expected


def hard_boxes(dimension: int) -> Boxes:
    """Return boxes of every kind, and ordinary ones, many of which begin or end at a small whole number."""
    rng = np.random.default_rng(13)
    sides: list[Pairs] = []
    for axis in range(dimension):
        low = rng.choice([-2.0, -1.0, 0.0, 1.0, 2.0], COUNT) + rng.choice([0.0, 5e-324, 1e-17, 0.3], COUNT) * rng.choice([-1.0, 1.0], COUNT)
        high = low + rng.choice([0.0, 1e-17, 0.2, 1.0, math.inf], COUNT)
        some = rng.random(COUNT) < 0.5
        hard = intervals(COUNT, 30 + axis)
        sides.append((np.where(some, low, hard[0]), np.where(some, high, hard[1])))
    return Boxes(*(np.stack([side[end] for side in sides], axis=1) for end in range(2)))


def samples(boxes: Boxes, seed: int) -> np.ndarray[Any, np.dtype[np.float64]]:
    """Return points of boxes, shape (6, n, d): the ends, the number nearest to 0, and others."""
    rng = np.random.default_rng(seed)
    low, high = np.clip(boxes.lower, -1e300, 1e300), np.clip(boxes.upper, -1e300, 1e300)
    inner = [low + (high - low) * rng.random(low.shape) for _ in range(2)]
    return np.clip([low, high, np.zeros_like(low), np.where(rng.random(low.shape) < 0.5, low, high), *inner], low, high)


@pytest.mark.parametrize("name", PARTIAL)
def test_where_a_function_is_said_to_be_defined_it_is(name: str) -> None:
    operation = OPERATIONS[name]
    for exponent in (-3, -2, 2, 3) if name in EXPONENTS else (1,):
        expression, count = applied(operation, exponent)
        boxes = hard_boxes(3)
        defined = Function(expression).holds("defined", boxes)
        for point in np.swapaxes(samples(boxes, 17), 0, 1)[defined].reshape(-1, 3)[:: 5 if name != "pow" else 50]:
            if name == "tan" and abs(point[0]) > 1e15:
                continue
            operands = operands_of(operation, [point[k % count] for k in range(3)], exponent)
            if name == "pow":
                assert operands[0] > 0.0
            else:
                assert real(name, *operands) is not None, operands
        assert defined.mean() > 0.05
        assert (~defined[~boxes.empty]).mean() > 0.05 or (name in EXPONENTS and exponent > 0)
        assert not defined[boxes.empty].any()
        if name in CONVEX:
            bounded = np.isfinite(boxes.lower[:, 0]) & np.isfinite(boxes.upper[:, 0]) & ~boxes.empty
            ends = zip(boxes.lower[bounded, 0], boxes.upper[bounded, 0], strict=True)
            assert defined[bounded].tolist() == [real(name, a) is not None and real(name, b) is not None for a, b in ends]


@pytest.mark.parametrize("name", STEPS)
def test_where_a_step_is_said_to_be_continuous_it_has_one_value(name: str) -> None:
    function = Function(OPERATIONS[name](variables("x")))
    boxes = hard_boxes(1)
    continuous = function.holds("continuous", boxes)
    assert 0.05 < continuous.mean() < 0.9
    assert function.holds("defined", boxes)[~boxes.empty].all()
    for some in np.swapaxes(samples(boxes, 19), 0, 1)[continuous][::5]:
        assert len({real(name, x) for x in some[:, 0]}) == 1


def test_where_an_angle_is_said_to_be_continuous_no_box_meets_the_cut() -> None:
    y, x = variables("y x")
    boxes = hard_boxes(2)
    continuous = Function(functions.atan2(y, x)).holds("continuous", boxes)
    meets = (boxes.lower[:, 0] <= 0.0) & (boxes.upper[:, 0] >= 0.0) & (boxes.lower[:, 1] <= 0.0) & ~boxes.empty
    assert (continuous == ~meets & ~boxes.empty).all()
    assert 0.2 < continuous.mean() < 0.9


@pytest.mark.parametrize(
    ("call", "error", "message"),
    [
        (lambda x: functions.pown(x, 0.5), ValueError, "the exponent is 0.5; pown and rootn need a whole number"),
        (lambda x: functions.pown(Interval(2, 3), 0.5), ValueError, "the exponent is 0.5"),
        (lambda x: functions.pown(x, 2**53 + 1), ValueError, "of at most 2\\^53"),
        (lambda x: functions.pown(x, math.inf), ValueError, "the exponent is inf"),
        (lambda x: functions.pown(x, math.nan), ValueError, "the exponent is nan"),
        (lambda x: functions.pown(x, Interval(1, 2)), TypeError, "need one whole number, pow takes others"),
        (lambda x: functions.pown(x, x), TypeError, "x is not a constant"),
        (lambda x: functions.rootn(x, 0), ValueError, "the exponent is 0; rootn needs a whole number other than 0"),
        (lambda x: functions.rootn(x, "3"), TypeError, "the exponent is 3; pown and rootn need one whole number"),
    ],
)
def test_exponents_that_are_not_whole_numbers(call: Callable[..., Any], error: type[Exception], message: str) -> None:
    with pytest.raises(error, match=message):
        call(variables("x"))


def test_exponents_of_every_type() -> None:
    x = variables("x")
    for exponent in (3, 3.0, np.int64(3), np.float32(3), Interval(3)):
        assert repr(functions.pown(x, exponent)) == "x**3"
    assert functions.rootn(27, 3) == Interval(3)
    assert functions.pown(Boxes.of([(2, 3)]), -1).upper.tolist() == [[0.5]]
