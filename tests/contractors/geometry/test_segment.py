"""Segments and point clouds against twins that look at every one of them with exact fractions."""

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ial.contractors import Boxes, Segment, Segments

INF = math.inf
Point = tuple[float, ...]
Exact = list[tuple[Fraction, Fraction]]


def exact_part(start: Point, end: Point, box: list[tuple[float, float]]) -> Exact | None:
    """Return the exact hull of the part of a segment in a box, or None."""
    low, high = Fraction(0), Fraction(1)
    for p, q, (lower, upper) in zip(start, end, box, strict=True):
        step = Fraction(q) - Fraction(p)
        if step == 0:
            if not lower <= p <= upper:
                return None
            continue
        bounds = [None if math.isinf(each) else (Fraction(each) - Fraction(p)) / step for each in (lower, upper)]
        first, last = bounds if step > 0 else reversed(bounds)
        low = low if first is None else max(low, first)
        high = high if last is None else min(high, last)
    if low > high:
        return None
    ends = [[Fraction(p) + t * (Fraction(q) - Fraction(p)) for t in (low, high)] for p, q in zip(start, end, strict=True)]
    return [(min(each), max(each)) for each in ends]


def exact_hull(segments: list[tuple[Point, Point]], box: list[tuple[float, float]]) -> Exact | None:
    parts = [part for start, end in segments if (part := exact_part(start, end, box)) is not None]
    return [(min(low for low, _ in axis), max(high for _, high in axis)) for axis in zip(*parts, strict=True)] if parts else None


def check(narrowed: Boxes, exact: Exact | None, box: list[tuple[float, float]], slack: float) -> None:
    """Assert that a row encloses the exact hull, and is no wider than a slack beyond it; where that is empty, at most a crumb is left."""
    if exact is None:
        assert narrowed.empty[0] or (narrowed.width() <= slack).all()
        return
    for lower, upper, (low, high), (first, last) in zip(narrowed.lower[0].tolist(), narrowed.upper[0].tolist(), exact, box, strict=True):
        assert first <= lower <= low
        assert high <= upper <= last
        assert low - lower <= slack
        assert upper - high <= slack


numbers = st.one_of(st.integers(-4, 4).map(float), st.floats(-4, 4, allow_subnormal=False), st.sampled_from([0.1, 0.3, 1e-9]))
points = st.tuples(numbers, numbers)
sides = st.one_of(
    st.tuples(numbers, st.one_of(st.floats(0, 3), st.sampled_from([0.0, INF]))).map(lambda side: (side[0], side[0] + side[1])),
    st.tuples(st.just(-INF), st.one_of(numbers, st.just(INF))),
)
boxes = st.tuples(sides, sides).map(list)


@pytest.mark.slow
@settings(max_examples=300)
@given(st.lists(st.tuples(points, points), min_size=1, max_size=5), boxes)
def test_contraction_is_the_exact_hull_but_for_rounding(segments: list[tuple[Point, Point]], box: list[tuple[float, float]]) -> None:
    contractor = Segments(*zip(*segments, strict=True))
    check(contractor.contract(Boxes.of(box)), exact_hull(segments, box), box, slack=1e-14)


@given(points, points, st.fractions(0, 1), st.lists(st.floats(0, 1), min_size=4, max_size=4))
def test_the_doubles_around_a_point_of_a_segment_are_kept(start: Point, end: Point, t: Fraction, moves: list[float]) -> None:
    exact = [Fraction(p) + t * (Fraction(q) - Fraction(p)) for p, q in zip(start, end, strict=True)]
    low = [float(each) if Fraction(float(each)) <= each else math.nextafter(float(each), -INF) for each in exact]
    high = [float(each) if Fraction(float(each)) >= each else math.nextafter(float(each), INF) for each in exact]
    box = [(low[i] - moves[2 * i], high[i] + moves[2 * i + 1]) for i in range(2)]
    narrowed = Segment(start, end).contract(Boxes.of(box))
    assert (narrowed.lower[0] <= low).all()
    assert (narrowed.upper[0] >= high).all()


def test_level_upright_and_slanting_segments() -> None:
    box = Boxes.of([(0.5, 1.5), (-1, 1)])
    for start, end, lower, upper in [
        ((0, 0), (2, 0), [0.5, 0], [1.5, 0]),
        ((1, -5), (1, 0.5), [1, -1], [1, 0.5]),
        ((0, 0), (2, 1), [0.5, 0.25], [1.5, 0.75]),
        ((2, 1), (0, 0), [0.5, 0.25], [1.5, 0.75]),
        ((0, 1), (2, -1), [0.5, -0.5], [1.5, 0.5]),
        ((1, 0.5), (1, 0.5), [1, 0.5], [1, 0.5]),
    ]:
        narrowed = Segment(start, end).contract(box)
        assert (narrowed.lower[0].tolist(), narrowed.upper[0].tolist()) == (lower, upper)
    assert Segment((0, 3), (0, 4)).contract(box).empty[0]
    assert Segment((0, 0.9), (0.6, 2)).contract(box).empty[0]


def test_unbounded_empty_and_point_boxes() -> None:
    segment = Segment((1, 2), (3, 4))
    narrowed = segment.contract(
        Boxes.of([(-INF, INF)] * 2, [(INF, -INF)] * 2, [(2, 2), (3, 3)], [(2, 2), (3.001, 3.001)], [(-INF, 2), (-INF, INF)])
    )
    assert narrowed.empty.tolist() == [False, True, False, True, False]
    assert narrowed[[0, 2, 4]].lower.tolist() == [[1, 2], [2, 3], [1, 2]]
    assert narrowed[[0, 2, 4]].upper.tolist() == [[3, 4], [2, 3], [2, 3]]
    assert (narrowed.lower[[1, 3]] == INF).all()
    assert (narrowed.upper[[1, 3]] == -INF).all()


def test_many_segments_are_the_union_of_each() -> None:
    rng = np.random.default_rng(3)
    starts = rng.uniform(0, 10, (300, 3))
    ends = starts + rng.normal(size=(300, 3)) * rng.choice([0.0, 0.1, 2.0], (300, 1))
    lower = rng.uniform(-1, 10, (700, 3))
    batch = Boxes(lower, lower + rng.uniform(0, 4, (700, 3)))
    before = batch.lower.copy()
    narrowed = Segments(starts, ends).contract(batch)
    each = [Segment(start, end).contract(batch) for start, end in zip(starts, ends, strict=True)]
    assert (narrowed.lower == np.min([part.lower for part in each], axis=0)).all()
    assert (narrowed.upper == np.max([part.upper for part in each], axis=0)).all()
    assert 0 < narrowed.empty.sum() < 700
    assert (batch.lower == before).all()


def test_coordinates_of_extreme_size() -> None:
    largest = np.finfo(np.float64).max
    assert not Segment((-largest, -largest), (largest, largest)).contract(Boxes.of([(1, 2), (1, 2)])).empty[0]
    assert not Segment((0, 0), (5e-324, 5e-324)).contract(Boxes.of([(0, 1), (0, 1)])).empty[0]


def test_segments_that_cannot_be_meant() -> None:
    with pytest.raises(ValueError, match="starts of the segments"):
        Segments(np.empty((0, 2)), np.empty((0, 2)))
    with pytest.raises(ValueError, match="one end for each"):
        Segments([[0, 0]], [[0, 0], [1, 1]])
    with pytest.raises(ValueError, match="row 1 of the ends"):
        Segments([[0, 0], [1, 1]], [[0, 0], [1, math.nan]])
    with pytest.raises(ValueError, match="use Segments"):
        Segment([[0, 0], [1, 1]], [[0, 0], [1, 1]])
    with pytest.raises(ValueError, match="needs 2"):
        Segment((0, 0), (1, 1)).contract(Boxes.of([(0, 1)]))
