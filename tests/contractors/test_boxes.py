import operator as op
from collections.abc import Callable
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ial.contractors import Boxes, Interval
from ial.contractors.expressions.variables import variables

TWO = Boxes.of([(0, 1), (2, 4)], [(5, 7), (0, 1)])
EMPTY = (np.inf, -np.inf)


def test_rows_are_given_as_pairs_of_bounds() -> None:
    assert TWO.lower.tolist() == [[0, 2], [5, 0]]
    assert TWO.upper.tolist() == [[1, 4], [7, 1]]
    assert len(TWO) == TWO.dimension == 2


def test_shapes_that_do_not_fit_are_refused() -> None:
    with pytest.raises(ValueError, match=r"both must be \(n, d\)"):
        Boxes(np.zeros((2, 2)), np.zeros((2, 3)))
    with pytest.raises(ValueError, match=r"both must be \(n, d\)"):
        Boxes(np.zeros(2), np.zeros(2))


def test_bounds_become_contiguous_doubles() -> None:
    boxes = Boxes(np.zeros((3, 4), dtype=np.float32).T, np.ones((3, 4), dtype=np.int64).T)
    assert boxes.lower.dtype == boxes.upper.dtype == np.float64
    assert boxes.lower.flags.c_contiguous


def test_rows_are_selected() -> None:
    assert TWO[1:].lower.tolist() == [[5, 0]]
    assert TWO[np.array([True, False])].upper.tolist() == [[1, 4]]
    assert TWO[np.array([1, 0, 1])].lower.tolist() == [[5, 0], [0, 2], [5, 0]]


def test_width_and_volume() -> None:
    assert TWO.width().tolist() == [[1, 2], [2, 1]]
    assert TWO.volume() == 4.0
    assert Boxes.of([EMPTY, EMPTY], [(0, 2), (0, 3)]).volume() == 6.0
    assert Boxes.none(3).volume() == 0.0


def test_hull() -> None:
    hull = Boxes.concatenate([TWO, Boxes.of([EMPTY, EMPTY])]).hull()
    assert (hull.lower.tolist(), hull.upper.tolist()) == ([[0, 0]], [[7, 4]])
    assert Boxes.none(2).hull().empty.tolist() == [True]
    assert Boxes.of([EMPTY]).hull().empty.tolist() == [True]


def test_points_on_the_boundary_are_contained() -> None:
    assert TWO.contain([1.0, 4.0]).tolist() == [True, False]
    assert TWO.contain([5.0, 0.0]).tolist() == [False, True]
    assert TWO.contain([np.nan, 0.0]).tolist() == [False, False]


def test_halves_stay_side_by_side() -> None:
    halves = TWO.bisect(np.array([0, 1]))
    assert halves.lower.tolist() == [[0, 2], [0.5, 2], [5, 0], [5, 0.5]]
    assert halves.upper.tolist() == [[0.5, 4], [1, 4], [7, 0.5], [7, 1]]


def test_bounds_that_are_no_doubles_are_rounded_outward() -> None:
    boxes = Boxes.of([(Fraction(1, 3), Fraction(1, 3)), Interval(1, 2)])
    assert boxes.interval(0, 0) == Interval(Fraction(1, 3))
    assert boxes.interval(0, 1) == Interval(1, 2)


def test_rows_that_make_no_boxes_are_refused() -> None:
    with pytest.raises(ValueError, match=r"Boxes\.none"):
        Boxes.of()
    with pytest.raises(ValueError, match="same number of sides"):
        Boxes.of([(0, 1)], [(0, 1), (2, 3)])
    with pytest.raises(ValueError, match="an interval has the bounds"):
        Boxes.of([(2, 1)])


def test_boxes_are_iterated_and_printed() -> None:
    assert list(TWO) == [(Interval(0, 1), Interval(2, 4)), (Interval(5, 7), Interval(0, 1))]
    assert TWO[1].lower.tolist() == TWO[-1].lower.tolist() == [[5, 0]]
    with pytest.raises(IndexError):
        TWO[2]
    assert repr(TWO[0]) == "<1 box of dimension 2: [0.0, 1.0] × [2.0, 4.0]>"
    assert repr(Boxes.none(3)) == "<0 boxes of dimension 3>"
    assert repr(Boxes.of(*[[(0, 1)] * 5] * 9)).endswith("× [0.0, 1.0] × …; …>")
    assert len(repr(Boxes.of(*[[(0, 1)] * 50] * 90))) < 250


def test_midpoints_and_subsets() -> None:
    boxes = Boxes.of([(0, 1), (2, np.inf)], [EMPTY, EMPTY])
    middles = boxes.midpoint()
    assert middles[0].tolist() == [0.5, np.finfo(float).max]
    assert np.isnan(middles[1]).all()
    assert boxes.subset(Boxes.of([(0, 2), (0, np.inf)])).tolist() == [True, True]
    assert boxes.subset(Interval(0, 5)).tolist() == [False, True]


def test_columns() -> None:
    column = Boxes.column([0.0, np.inf], [1.0, -np.inf])
    assert (column.lower.tolist(), column.upper.tolist()) == ([[0], [np.inf]], [[1], [-np.inf]])
    assert Boxes.column([], []).dimension == 1
    for lower, upper in ([1.0], [0.0]), ([np.nan], [0.0]), ([np.inf], [np.inf]):
        with pytest.raises(ValueError, match="make no interval"):
            Boxes.column(lower, upper)
    with pytest.raises(ValueError, match=r"both must be \(m,\)"):
        Boxes.column([1.0], [2.0, 3.0])


@given(st.lists(st.floats(-1e300, 1e300), max_size=5), st.floats(0, 1e300))
def test_boxes_around_points_are_tight(points: list[float], radius: float) -> None:
    boxes = Boxes.around(points, radius)
    assert boxes.dimension == 1
    for i, point in enumerate(points):
        assert boxes.interval(i, 0) == Interval(Fraction(point) - Fraction(radius), Fraction(point) + Fraction(radius))


def test_boxes_around_points_of_several_dimensions() -> None:
    boxes = Boxes.around(np.array([[1, 2], [3, 4]]), [1, Fraction(1, 3)])
    assert boxes.interval(1, 0) == Interval(2, 4)
    assert Fraction(11, 3) in boxes.interval(1, 1)
    assert Boxes.around(np.zeros((0, 3)), 1).dimension == 3
    assert Boxes.around([1.0], np.inf).interval(0, 0) == Interval.entire()
    for points, radius in ([np.nan], 1), ([np.inf], 1), ([1.0], -1), ([1.0], np.nan), ([1.0], [1, 2]), (3.0, 1), ([1.0], [[1.0]]):
        with pytest.raises(ValueError, match=r"radi|points"):
            Boxes.around(points, radius)


def test_large_integers_are_enclosed() -> None:
    boxes = Boxes.around(np.array([2**53 + 1]), 0)
    assert boxes.interval(0, 0) == Interval(2**53 + 1)
    assert (TWO + np.int64(2**53 + 1)).interval(0, 0) == Interval(0, 1) + (2**53 + 1)


BOUND = st.floats(-1e300, 1e300)
SIDE = st.tuples(BOUND, BOUND).map(sorted).map(tuple)
ROWS = st.lists(st.tuples(SIDE, SIDE), min_size=2, max_size=2)
OPERATORS = [op.add, op.sub, op.mul, op.truediv, op.and_, op.or_]


def expected(rows: list[list[Interval]]) -> list[tuple[Interval, ...]]:
    """Return the rows, of which those with an empty side are empty."""
    return [tuple(Interval.empty() if any(side.is_empty for side in row) else each for each in row) for row in rows]


@pytest.mark.slow
@pytest.mark.parametrize("apply", OPERATORS)
@given(rows=ROWS, others=ROWS, number=BOUND)
def test_operators_work_on_every_side(apply: Callable[[Any, Any], Any], rows: Any, others: Any, number: float) -> None:
    a, b = Boxes.of(*rows), Boxes.of(*others)
    points = b.lower
    sides = [[(x, y) for x, y in zip(*pair, strict=True)] for pair in zip(a, b, strict=True)]
    assert list(apply(a, b)) == expected([[apply(x, y) for x, y in row] for row in sides])
    assert list(apply(a, number)) == expected([[apply(x, number) for x, _ in row] for row in sides])
    assert list(apply(number, a)) == expected([[apply(number, x) for x, _ in row] for row in sides])
    assert list(apply(Interval(0, 1), a)) == expected([[apply(Interval(0, 1), x) for x, _ in row] for row in sides])
    assert list(apply(points, a)) == expected([[apply(Interval(y.lower), x) for x, y in row] for row in sides])
    assert list(apply(a, points[0])) == expected(
        [[apply(x, p) for (x, _), p in zip(row, points[0].tolist(), strict=True)] for row in sides]
    )


@pytest.mark.parametrize("exponent", [2, 3, -1, 0, 0.5, 2.0, Fraction(1, 3), Interval(1, 2)])
def test_powers_are_those_of_intervals(exponent: Any) -> None:
    boxes = Boxes.of([(0, 1), (2, 3)], [(-2, 3), (4, 5)])
    assert list(boxes**exponent) == expected([[side**exponent for side in row] for row in boxes])
    with pytest.raises(ValueError, match="a whole exponent of boxes"):
        boxes**1e20


def test_signs_and_reflected_powers() -> None:
    assert list(-TWO) == [(Interval(-1, 0), Interval(-4, -2)), (Interval(-7, -5), Interval(-1, 0))]
    assert list(abs(-TWO)) == list(+TWO) == list(TWO)
    assert list(2 ** TWO[0]) == [(Interval(1, 2), Interval(4, 16))]


def test_empty_rows() -> None:
    boxes = Boxes.of([EMPTY, EMPTY], [(1, 2), (3, 4)])
    assert (boxes + 1).empty.tolist() == [True, False]
    assert (boxes & Boxes.of([(0, 1), (5, 6)])).empty.tolist() == [True, True]
    assert (boxes & Boxes.of([(0, 1), (5, 6)])).lower.tolist() == [[np.inf] * 2] * 2
    assert next(iter(boxes | 0)) == (Interval(0), Interval(0))
    assert (boxes / np.array([0.0, 1.0])).empty.all()


def test_operands_that_do_not_fit_are_refused() -> None:
    with pytest.raises(ValueError, match="which do not fit together"):
        TWO + Boxes.of([(0, 1)] * 3)
    with pytest.raises(ValueError, match="infinity or NaN"):
        TWO + np.array([np.nan, 1.0])
    with pytest.raises(ValueError, match="infinity or NaN"):
        TWO * np.inf
    with pytest.raises(ValueError, match=r"both must be \(n, d\)"):
        TWO + np.zeros((3, 2, 2))
    with pytest.raises(TypeError):
        TWO + "text"  # type: ignore[operator]
    with pytest.raises(TypeError):
        TWO & "text"  # type: ignore[operator]


def test_an_expression_takes_boxes_as_its_rows() -> None:
    x = variables("x")
    assert isinstance(Boxes.column([0.0, 1.0], [1.0, 2.0]) + x, type(x))


@pytest.mark.slow
@given(st.lists(st.tuples(BOUND, BOUND, BOUND, BOUND), min_size=1, max_size=5), st.floats(0, 1), st.floats(0, 1))
def test_the_halves_of_a_bisection_cover_the_box(rows: list[tuple[float, float, float, float]], s: float, t: float) -> None:
    bounds = np.sort(np.array(rows).reshape(-1, 2, 2), axis=2)
    boxes = Boxes(bounds[:, :, 0], bounds[:, :, 1])
    halves = boxes.bisect(np.arange(len(boxes)) % 2)
    lower, upper = np.repeat(boxes.lower, 2, axis=0), np.repeat(boxes.upper, 2, axis=0)
    inside = np.clip(lower + np.array([s, t]) * (upper - lower), lower, upper)
    held = ((halves.lower <= inside) & (inside <= halves.upper)).all(axis=1)
    assert held.reshape(-1, 2).any(axis=1).all()
    assert (halves.lower >= lower).all()
    assert (halves.upper <= upper).all()
