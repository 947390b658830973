"""Annuli and discs, both sides of them."""

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ial.contractors import Annulus, Boxes, Interval, Separator

INF = math.inf
ENTIRE = (-INF, INF)


@given(
    st.tuples(st.floats(-50, 50), st.floats(-50, 50)),
    st.tuples(st.floats(-50, 50), st.floats(-50, 50)),
    st.floats(0, 60),
    st.floats(0, 5),
    st.lists(st.floats(0, 20), min_size=4, max_size=4),
)
def test_a_point_is_kept_by_the_side_of_an_annulus_it_is_on(
    centre: tuple[float, float], point: tuple[float, float], near: float, width: float, moves: list[float]
) -> None:
    separator = Separator.of(Annulus(centre, Interval(near, near + width)))
    box = Boxes.of([(point[i] - moves[2 * i], point[i] + moves[2 * i + 1]) for i in range(2)])
    square = sum((Fraction(p) - Fraction(c)) ** 2 for p, c in zip(point, centre, strict=True))
    inside = Fraction(near) ** 2 <= square <= Fraction(near + width) ** 2
    inner, outer = separator.separate(box)
    assert (outer if inside else inner).contain(point)[0]


def test_an_annulus_around_a_centre() -> None:
    ring = Annulus((10, 0), Interval(1, 2))
    boxes = Boxes.of([ENTIRE, ENTIRE], [(9.5, 10.5), (-0.5, 0.5)], [(10, 20), (0, 0)], [(0, 5), ENTIRE])
    narrowed = ring.contract(boxes)
    assert narrowed.empty.tolist() == [False, True, False, True]
    assert narrowed[[0, 2]].lower == pytest.approx(np.array([[8, -2], [11, 0]]), rel=1e-15)
    assert narrowed[[0, 2]].upper == pytest.approx(np.array([[12, 2], [12, 0]]), rel=1e-15)
    outside = (~ring).contract(boxes)
    assert outside.lower.tolist() == [[-INF, -INF], [9.5, -0.5], [10, 0], [0, -INF]]
    assert outside.upper.tolist() == [[INF, INF], [10.5, 0.5], [20, 0], [5, INF]]


@pytest.mark.parametrize(("x", "y", "r"), [(3, 4, 5), (5, -12, 13), (-8, 15, 17), (7 / 64, 24 / 64, 25 / 64), (0, 2, 2)])
def test_a_point_on_a_circle_lies_on_both_sides_of_it(x: float, y: float, r: float) -> None:
    point = Boxes.of([(x, x), (y, y)])
    for distance in (Interval(r, 2.0 * r), Interval(0.5 * r, r), Interval(r, r)):
        separator = Separator.of(Annulus((0.0, 0.0), distance))
        assert not separator.outer.contract(point).empty.any()
        assert not separator.inner.contract(point).empty.any()


def test_a_disc_and_the_whole_plane() -> None:
    boxes = Boxes.of([(-0.5, 0.5), (-0.5, 0.5)], [(3, 4), (3, 4)])
    disc = Annulus((0, 0), Interval(-1, 1))
    assert disc.distance == Interval(0, 1)
    assert disc.contract(boxes).empty.tolist() == [False, True]
    assert (~disc).contract(boxes).empty.tolist() == [True, False]
    assert (~Annulus((0, 0), Interval(0, INF))).contract(boxes).empty.all()
    assert (~Annulus((0, 0), Interval(2, INF))).contract(boxes).empty.tolist() == [False, True]


def test_annuli_that_cannot_be_meant() -> None:
    with pytest.raises(ValueError, match="centre"):
        Annulus((0, math.nan), Interval(1, 2))
    with pytest.raises(ValueError, match="centre"):
        Annulus((0, 1, 2), Interval(1, 2))
    with pytest.raises(ValueError, match="at least 0"):
        Annulus((0, 1), Interval(-2, -1))
    with pytest.raises(ValueError, match="at least 0"):
        Annulus((0, 1), Interval.empty())
    with pytest.raises(ValueError, match="Annulus needs 2"):
        Annulus((0, 0), Interval(1, 2)).contract(Boxes.of([(0, 1)]))
