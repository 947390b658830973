import math

import numpy as np
import pytest

from ial.contractors.boxes import Boxes
from ial.contractors.contractor import complement
from ial.contractors.expressions.functions import floor, hypot, maximum, minimum, sin, sqrt
from ial.contractors.expressions.mean_value import MeanValue, mean_value
from ial.contractors.expressions.variables import variables
from ial.contractors.intervals.interval import Interval
from tests.contractors.formulas import SMOOTH, boxes_around, is_known, lost, random_formula, real_value

x, y = variables("x y")


@pytest.mark.slow
def test_no_solution_of_a_random_constraint_is_lost() -> None:
    rng = np.random.default_rng(1)
    checked = narrower = 0
    for _ in range(400):
        formulas = [random_formula(rng, (x, y), int(rng.integers(2, 7)), SMOOTH) for _ in range(int(rng.integers(1, 3)))]
        points = np.where(rng.random((10, 2)) < 0.2, rng.integers(-2, 3, (10, 2)), rng.uniform(-2.0, 2.0, (10, 2)))
        values = [[real_value(formula, point) for formula in formulas] for point in points]
        known = [i for i in range(10) if all(map(is_known, values[i]))]
        if not known:
            continue
        middle = [float(value) for value in values[known[0]]]
        reach = [rng.choice([1e-9, 0.1, 1.0]) for _ in formulas]
        constraint = formulas[0] == Interval(middle[0] - reach[0], middle[0] + reach[0])
        for formula, at, far in zip(formulas[1:], middle[1:], reach[1:], strict=True):
            constraint = constraint & (formula == Interval(at - far, at + far))
        inside = np.array(
            [i in known and all(m - r <= value <= m + r for value, m, r in zip(values[i], middle, reach, strict=True)) for i in range(10)]
        )
        if not inside.any():
            continue
        near = boxes_around(points, rng)
        boxes = Boxes.concatenate([near, Boxes(points - 1e-3 * rng.random((10, 2)), points + 1e-3 * rng.random((10, 2)))])
        both = np.tile(inside, 2)
        plain, better = constraint.contract(boxes), mean_value(constraint).contract(boxes)
        assert not len(lost(better[both], np.tile(points, (2, 1))[both])), constraint
        assert ((plain.lower <= better.lower) & (better.upper <= plain.upper)).all()
        checked += int(both.sum())
        narrower += int(((plain.lower < better.lower) | (better.upper < plain.upper)).any(axis=1).sum())
    assert checked > 500
    assert narrower > 100


def test_it_narrows_small_boxes_more_where_a_variable_repeats() -> None:
    constraint = x**3 - x * y + y**3 == 0.5 + 0.25**3 - 0.25 * 0.5 - 0.5 + 0.125
    better = mean_value(constraint)
    assert isinstance(better, MeanValue)
    box = Boxes.of([(0.25 - 1e-4, 0.25 + 1e-4), (0.5 - 1e-8, 0.5 + 1e-8)])
    plain, narrow = constraint.contract(box).width()[0, 0], better.contract(box).width()[0, 0]
    assert narrow < 0.01 * plain
    assert better.contract(box).contain([0.25, 0.5]).all()
    assert better.contract(Boxes.of([(0.26, 0.2601), (0.5, 0.5001)])).empty.all()


def test_where_every_variable_occurs_once_it_is_the_constraint_itself() -> None:
    constraint = hypot(x - 1, y) == 2
    assert mean_value(constraint) is constraint
    assert isinstance(mean_value((x - y == 0) & (x + y == 2)), MeanValue)
    narrowed = mean_value((x - y == 0) & (x + y == 2)).contract(Boxes.of([(0, 3), (0, 3)]))
    assert narrowed.contain([1.0, 1.0]).all()
    assert narrowed.width().max() < 3.0


@pytest.mark.parametrize(
    ("constraint", "solution"),
    [
        (abs(x) + x * y == 0, (0.0, 1.0)),
        (abs(x) - x == 0, (0.5, 0.0)),
        (minimum(x, y) + x == 0, (0.0, 0.5)),
        (maximum(x, y) - x * y == 0, (1.0, 1.0)),
        (sqrt(x) - x == 0, (0.0, 0.0)),
        (sqrt(x) - x == 0, (1.0, 0.0)),
        (hypot(x, y) - x - y == 0, (0.0, 0.0)),
        (1 / x - x == 0, (1.0, 0.0)),
        (sqrt(x * x) - abs(x) + y == 0, (0.0, 0.0)),
    ],
)
@pytest.mark.parametrize("reach", [0.0, 1e-6, 0.5, 3.0, math.inf])
def test_kinks_partial_functions_and_unbounded_boxes(constraint: object, solution: tuple[float, float], reach: float) -> None:
    better = mean_value(constraint)  # type: ignore[arg-type]
    for left, right in ((1.0, 1.0), (0.0, 1.0), (1.0, 0.0)):
        ends = [(at - reach * left if left else at, at + reach * right if right else at) for at in solution]
        assert better.contract(Boxes.of(ends)).contain(solution).all()


def test_complement_and_errors() -> None:
    constraint = x * x - sin(x) == 0
    box = Boxes.of([(0, 1), (0, 1)])
    assert complement(mean_value(constraint)).contract(box).upper.tolist() == [[1.0, 1.0]]
    assert mean_value(constraint).contract(Boxes.of([(math.inf, -math.inf)] * 2)).empty.all()
    assert len(mean_value(constraint).contract(Boxes.none(2))) == 0
    with pytest.raises(TypeError, match="differ from row to row"):
        mean_value(x * x - x == np.array([1.0, 2.0]))
    with pytest.raises(TypeError, match="holds an operation without a derivative"):
        mean_value(x * floor(x) == 1)
    with pytest.raises(ValueError, match="the boxes have 1 dimensions"):
        mean_value(constraint).contract(Boxes.of([(0, 1)]))
