from typing import Any

import mpmath as mp
import numpy as np
import pytest

from ial.contractors.boxes import Boxes
from ial.contractors.expressions.derivative import conditions, gradient, met
from ial.contractors.expressions.functions import OPERATIONS, atan2, exp, floor, log, sin, sqrt
from ial.contractors.expressions.tape import Tape
from ial.contractors.expressions.variables import variables
from ial.contractors.intervals.interval import Interval
from tests.contractors.formulas import SMOOTH, is_known, random_formula, real_value

STEP = mp.mpf(10) ** -20


def difference(formula: Any, point: Any, axis: int) -> Any:
    """Return the slope at a point, from values of many digits on both sides; None where there is no slope."""
    at = [[mp.mpf(float(one)) + (side * STEP if k == axis else 0) for k, one in enumerate(point)] for side in (-1, 0, 1)]
    values = [real_value(formula, one) for one in at]
    if not all(map(is_known, values)):
        return None
    left, right = (values[1] - values[0]) / STEP, (values[2] - values[1]) / STEP
    return (left + right) / 2 if abs(left - right) <= mp.mpf(10) ** -12 * (1 + abs(left)) else None


@pytest.mark.slow
def test_gradients_of_random_formulas_enclose_slopes() -> None:
    rng = np.random.default_rng(1)
    p = variables("p[2]")
    checked = narrow = 0
    for _ in range(250):
        formula = random_formula(rng, p, int(rng.integers(1, 7)), SMOOTH)
        parts = gradient(formula, 2)
        assert parts is not None
        points = rng.uniform(-2.0, 2.0, (4, 2))
        low, high = Tape(2, parts).evaluate(Boxes(points, points))
        wide = Tape(2, parts).evaluate(Boxes(points - rng.random((4, 2)), points + rng.random((4, 2))))
        for i, point in enumerate(points):
            for axis in range(2):
                slope = difference(formula, point, axis)
                if slope is None:
                    continue
                slack = mp.mpf(10) ** -12 * (1 + abs(slope))
                assert low[i, axis] - slack <= slope <= high[i, axis] + slack, (formula, point)
                assert wide[0][i, axis] - slack <= slope <= wide[1][i, axis] + slack, (formula, point)
                checked += 1
                narrow += high[i, axis] - low[i, axis] < 1e-9 * (1 + abs(slope))
    assert checked > 800
    assert narrow > 400


def test_gradients_are_written_with_the_formula() -> None:
    x, y, _z = variables("x y z")
    shared = sin(x)
    parts = gradient(shared * y + shared * 2.0, 3)
    assert parts is not None
    assert repr(parts[0]) == "((2 + y) * cos(x))" or len(Tape(3, parts).program) <= 4
    assert repr(parts[1]) == "sin(x)"
    assert parts[2] == Interval(0.0)
    assert gradient(x, 3) == [Interval(1.0), Interval(0.0), Interval(0.0)]
    assert gradient(x + floor(y), 3) is None


def test_conditions_of_a_formula_and_all_its_parts() -> None:
    x, y = variables("x y")
    formula = sqrt(log(x)) + 1 / (y - 1) + atan2(y, x - 3)
    boxes = Boxes.of(
        [(1, 2), (2, 3)],  # all is well, behind the cut as well
        [(0.5, 2), (2, 3)],  # log(x) < 0
        [(1, 2), (0.5, 3)],  # y = 1
        [(0, 2), (2, 3)],  # log(0)
        [(1, 2), (-1, 0.5)],  # y = 0 at x − 3 < 0: a jump, but a value
        [(2, 3), (-1, 0.5)],  # the angle of (0, 0)
    )
    for kind, expected in (("defined", [1, 0, 0, 0, 1, 0]), ("continuous", [1, 0, 0, 0, 0, 0])):
        guards, bounds = conditions([formula], kind)  # type: ignore[arg-type]
        assert met(Tape(2, guards).evaluate(boxes), bounds).tolist() == expected
    guards, bounds = conditions([exp(x) + y], "defined")
    assert guards == []
    assert met(Tape(2, guards).evaluate(boxes), bounds).all()


def test_where_a_random_formula_is_said_to_be_defined_it_is() -> None:
    rng = np.random.default_rng(3)
    p = variables("p[2]")
    names = [name for name, operation in OPERATIONS.items() if operation.defined] * 2 + ["add", "mul", "sin", "sqr", "absolute"]
    counts = np.zeros(2, dtype=int)
    for _ in range(150):
        formula = random_formula(rng, p, int(rng.integers(1, 4)), names)
        low = rng.uniform(-2.0, 2.0, (10, 2))
        boxes = Boxes(low, low + rng.choice([0.1, 1.0], (10, 2)))
        guards, bounds = conditions([formula], "defined")
        defined = met(Tape(2, guards).evaluate(boxes), bounds)
        counts += [defined.sum(), (~defined).sum()]
        for i in np.flatnonzero(defined)[:4]:
            for point in rng.uniform(boxes.lower[i], boxes.upper[i], (3, 2)):
                assert real_value(formula, point) is not None, formula
    assert counts.min() > 100
