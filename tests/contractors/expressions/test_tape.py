import math
from typing import Any

import numpy as np
import pytest

from ial.contractors.boxes import Boxes
from ial.contractors.expressions import functions
from ial.contractors.expressions.expression import Expression
from ial.contractors.expressions.operation import LANES
from ial.contractors.expressions.tape import Tape, ordered
from ial.contractors.expressions.variables import variables
from ial.contractors.intervals.interval import Interval
from ial.contractors.threads import set_threads
from tests.contractors.formulas import assert_same, boxes_around, interval_value, is_known, lost, random_formula, real_value


@pytest.fixture(params=[1, 2])
def threads(request: pytest.FixtureRequest) -> Any:
    set_threads(request.param)
    yield request.param
    set_threads(None)


def instructions(*outputs: Any) -> int:
    return len(Tape(3, outputs).program)


def test_a_tape_gives_what_intervals_give_one_by_one() -> None:
    rng = np.random.default_rng(1)
    p = variables("p[3]")
    empty = 0
    for _ in range(150):
        formulas = [random_formula(rng, p, int(rng.integers(1, 15))) for _ in range(2)]
        boxes = boxes_around(rng.uniform(-3.0, 3.0, (6, 3)), rng)
        sides = [[Interval(*side) for side in zip(*box, strict=True)] for box in zip(boxes.lower, boxes.upper, strict=True)]
        expected = [[interval_value(formula, box) for formula in formulas] for box in sides]
        values = Tape(3, formulas).evaluate(boxes)
        assert_same(values, ([[one.lower for one in row] for row in expected], [[one.upper for one in row] for row in expected]))
        empty += int((values[0] > values[1]).sum())
    assert 50 < empty < 1500


@pytest.mark.slow
@pytest.mark.parametrize("rounds", [1, 3])
def test_no_point_with_its_value_in_the_target_is_lost(rounds: int) -> None:
    rng = np.random.default_rng(2 + rounds)
    p = variables("p[3]")
    checked = narrowed = 0
    for _ in range(1000):
        formulas = [random_formula(rng, p, int(rng.integers(1, 8))) for _ in range(int(rng.integers(1, 3)))]
        tape = Tape(3, formulas)
        points = np.where(rng.random((8, 3)) < 0.2, rng.integers(-2, 3, (8, 3)), rng.uniform(-3.0, 3.0, (8, 3)))
        low, high = tape.evaluate(Boxes(points, points))
        kept = np.flatnonzero((low <= high).all(axis=1))
        kept = np.array([i for i in kept if all(is_known(real_value(formula, points[i])) for formula in formulas)], dtype=np.int64)
        if not len(kept):
            continue
        chosen = points[kept]
        # The value with each interval at its lower end; any number of the enclosure might do without one.
        values = np.array([[float(real_value(formula, point)) for formula in formulas] for point in chosen])
        widths = rng.choice([0.0, 0.1, 2.0, math.inf], values.shape)
        margin = 1e-15 * abs(values) + 1e-300
        targets = np.stack([values - margin - widths * rng.random(values.shape), values + margin + widths])
        boxes = boxes_around(chosen, rng)
        after = tape.narrow(boxes, targets, rounds=rounds)
        assert not len(lost(after, chosen)), formulas
        assert ((boxes.lower <= after.lower) & (after.upper <= boxes.upper)).all()
        checked += len(chosen)
        narrowed += int(((boxes.lower < after.lower) | (after.upper < boxes.upper)).sum())
    assert checked > 2000
    assert narrowed > 500


def test_more_rounds_narrow_more() -> None:
    x, y = variables("x y")
    tape = Tape(2, [x - y, x - 0.5 * y])
    boxes = Boxes.of([(-4, 4), (-4, 4)])
    target = np.zeros((2, 1, 2))
    widths = [tape.narrow(boxes, target, rounds=rounds).width().max() for rounds in (1, 2, 60)]
    assert widths[0] > widths[1] > widths[2]
    assert widths[2] < 1e-12
    assert tape.narrow(boxes, target, rounds=60).contain([0.0, 0.0]).all()


def test_rows_do_not_depend_on_each_other_or_on_threads(threads: int) -> None:
    rng = np.random.default_rng(4)
    p = variables("p[3]")
    formula = functions.hypot(p[0] - 1.0, p[1] * p[2]) + functions.sin(p[0]) * rng.uniform(0.0, 1.0, 7)
    tape = Tape(3, [formula])
    count = 7 * 6 * LANES
    boxes = boxes_around(rng.uniform(-3.0, 3.0, (count, 3)), rng)
    targets = np.sort(rng.uniform(0.0, 3.0, (2, count, 1)), axis=0)
    all_values, all_rows = tape.evaluate(boxes), tape.narrow(boxes, targets, rounds=2)
    for start, stop in ((0, 7), (7 * LANES, 7 * LANES + 7), (count - 14, count)):
        assert_same(tape.evaluate(boxes[start:stop]), (all_values[0][start:stop], all_values[1][start:stop]))
        some = tape.narrow(boxes[start:stop], targets[:, start:stop], rounds=2)
        assert_same((some.lower, some.upper), (all_rows.lower[start:stop], all_rows.upper[start:stop]))
    set_threads(1)
    alone = tape.narrow(boxes, targets, rounds=2)
    assert_same((alone.lower, alone.upper), (all_rows.lower, all_rows.upper))


def test_members_take_each_box_with_each_row_of_the_constants() -> None:
    x, y = variables("x y")
    tape = Tape(2, [x + y * np.array([1.0, 2.0, 3.0])])
    boxes = Boxes.of([(0, 1), (0, 1)], [(5, 6), (1, 2)])
    _lower, upper = tape.evaluate(boxes, members=3)
    assert upper[:, 0].tolist() == [2.0, 3.0, 4.0, 8.0, 10.0, 12.0]
    targets = np.array([[[4.0]], [[4.0]]])
    narrowed = tape.narrow(boxes, targets, members=3)
    assert narrowed.empty.tolist() == [True, True, False, True, True, True]
    assert narrowed.lower[2].tolist() == narrowed.upper[2].tolist() == [1.0, 1.0]


def test_equal_subexpressions_are_computed_once() -> None:
    x, y, _z = variables("x y z")
    assert instructions(x + y, x + y) == 1
    assert instructions((x + y) * (x + y), functions.sin(x + y)) == 3
    assert instructions((x + 1.5) * (y + 1.5), functions.exp(x + 1.5)) == 4
    assert instructions((x + np.array([1.0, 2.0])) * (x + np.array([1.0, 2.0]))) == 2
    assert instructions(x + y, y + x) == 2
    assert len(Tape(3, [x + 1.5, y + 1.5]).constants[0, 0]) == 1


def test_what_holds_no_variable_is_computed_beforehand() -> None:
    x, _y, _z = variables("x y z")
    one = Expression.of(1.0)
    assert instructions(x + functions.exp(functions.sin(one) + one)) == 1
    tape = Tape(3, [Expression.of(2.0), Interval(3, 4), x])
    assert_same(tape.evaluate(Boxes.of([(0, 1)] * 3)), ([[2.0, 3.0, 0.0]], [[2.0, 4.0, 1.0]]))


def test_two_intervals_with_the_same_bounds_stand_for_two_numbers() -> None:
    x, y, _z = variables("x y z")
    error = Interval(-1, 1)
    # x + 1 = 1 and y − 1 = −1: each error is another number.
    tape = Tape(3, [x + error, y + error])
    narrowed = tape.narrow(Boxes.of([(0, 0)] * 3), np.array([[[1.0, -1.0]]] * 2))
    assert narrowed.contain([0.0, 0.0, 0.0]).all()
    tape = Tape(3, [x * error - x * error])  # 1·1 − 1·(−1) = 2
    assert tape.narrow(Boxes.of([(1, 1)] * 3), np.array([[[2.0]]] * 2)).contain([1.0, 1.0, 1.0]).all()
    column = Boxes.of([(-1, 1)], [(-1, 1)])
    tape = Tape(3, [x + column, y + column])
    assert not tape.narrow(Boxes.of([(0, 0)] * 3, [(0, 0)] * 3), np.array([[[1.0, -1.0]]] * 2)).empty.any()
    # What is written once is one number, even if it is used twice.
    once = x + error
    assert Tape(3, [once, once]).narrow(Boxes.of([(0, 0)] * 3), np.array([[[1.0, -1.0]]] * 2)).empty.all()


def test_empty_and_unbounded_boxes() -> None:
    x, y, _z = variables("x y z")
    tape = Tape(3, [x + y])
    boxes = Boxes(
        np.array([[math.inf] * 3, [-math.inf] * 3, [0.0, -math.inf, 5.0]]),
        np.array([[-math.inf] * 3, [math.inf] * 3, [1.0, math.inf, 6.0]]),
    )
    low, high = tape.evaluate(boxes)
    assert_same((low, high), ([[math.inf], [-math.inf], [-math.inf]], [[-math.inf], [math.inf], [math.inf]]))
    narrowed = tape.narrow(boxes, np.array([[[2.0]], [[3.0]]]))
    assert narrowed.empty.tolist() == [True, False, False]
    assert narrowed.lower[0].tolist() == [math.inf] * 3
    assert narrowed.upper[0].tolist() == [-math.inf] * 3
    assert_same((narrowed.lower[2], narrowed.upper[2]), ([0.0, 1.0, 5.0], [1.0, 3.0, 6.0]))
    nothing = tape.narrow(boxes, np.array([[[math.inf]], [[-math.inf]]]))
    assert nothing.empty.all()
    assert (nothing.lower == math.inf).all()
    assert len(tape.narrow(Boxes.none(3), np.array([[[2.0]], [[3.0]]]))) == 0


def test_input_is_not_modified() -> None:
    x, _y, _z = variables("x y z")
    boxes = Boxes.of([(0, 9)] * 3)
    tape = Tape(3, [x * 2.0 + Interval(1, 2)])
    for _ in range(2):  # the constants are narrowed on the way back, for this run only
        assert tape.narrow(boxes, np.array([[[3.0]], [[3.5]]]), rounds=2).upper.tolist() == [[1.25, 9.0, 9.0]]
    assert boxes.upper.tolist() == [[9.0] * 3]
    assert tape.constants.max() == 2.0


def test_long_and_deep_formulas() -> None:
    p = variables("p[400]")
    total = sum(x * float(i) for i, x in enumerate(p))
    deep = p[0]
    for _ in range(40):
        deep = deep * 0.5 + deep
    assert len(ordered([deep])) == 121
    low, high = Tape(400, [total, deep]).evaluate(Boxes(np.ones((1, 400)), np.ones((1, 400))))
    assert low[0, 0] == high[0, 0] == 400 * 399 / 2
    assert low[0, 1] <= 1.5**40 <= high[0, 1]
