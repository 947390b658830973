from fractions import Fraction

import pytest

from ial.errors import MapError
from ial.maps.polygons.polygon import Polygon

Corners = list[tuple[int, int]]
SQUARE: Corners = [(0, 0), (10, 0), (10, 10), (0, 10)]


def polygon(outer: Corners, *holes: Corners) -> Polygon:
    def exact(ring: Corners) -> tuple[tuple[Fraction, Fraction], ...]:
        return tuple((Fraction(x), Fraction(y)) for x, y in ring)

    return Polygon(exact(outer), tuple(map(exact, holes)))


def test_rings_are_turned_and_areas_are_exact() -> None:
    made = polygon(SQUARE[::-1], [(1, 1), (3, 1), (2, 4)])
    assert made.area == 100 - 3
    assert made.outer[0] == (0, 10)
    assert polygon(SQUARE).outer == polygon([SQUARE[0], *SQUARE[:0:-1]]).outer
    third = Polygon(((Fraction(0), Fraction(0)), (Fraction(1, 3), Fraction(0)), (Fraction(0), Fraction(1, 7))))
    assert third.area == Fraction(1, 42)
    assert third.bounds == (0, 0, Fraction(1, 3), Fraction(1, 7))


@pytest.mark.parametrize(
    "holes",
    [
        [[(0, 5), (4, 3), (4, 7)]],  # touches a wall with a corner
        [[(0, 0), (4, 1), (4, 3)]],  # touches a corner of the wall
        [[(2, 2), (5, 5), (2, 6)], [(5, 5), (8, 2), (8, 6)]],  # two holes touch
        [[(1, 1), (2, 1), (2, 2)], [(7, 7), (8, 7), (8, 8)]],
    ],
)
def test_rings_may_touch_in_points(holes: list[Corners]) -> None:
    assert len(polygon(SQUARE, *holes).holes) == len(holes)


@pytest.mark.parametrize(
    ("rings", "message"),
    [
        ([[(0, 0), (1, 0)]], "the outer ring has 2 corners"),
        ([[(0, 0), (1, 0), (2, 0)]], "has no area"),
        ([[*SQUARE, (0, 0)]], "has a corner twice"),
        ([[(0, 0), (10, 10), (10, 0), (0, 7)]], "the outer ring crosses or touches itself"),
        ([[(0, 0), (10, 0), (10, 10), (5, 0)]], "the outer ring crosses or touches itself"),  # a corner on another edge
        ([[(0, 0), (10, 0), (4, 0), (4, 8)]], "the outer ring crosses or touches itself"),  # a spike
        ([SQUARE, [(5, 5), (12, 5), (5, 6)]], "the outer ring and hole 1 cross"),
        ([SQUARE, [(0, 2), (0, 4), (3, 3)]], "the outer ring and hole 1 cross"),  # share a piece of a wall
        ([SQUARE, [(12, 2), (14, 2), (13, 4)]], "hole 1 does not lie inside of the outer ring"),
        ([SQUARE, [(10, 0), (20, 0), (20, 10), (10, 10)]], "the outer ring and hole 1 cross"),
        ([SQUARE, [(10, 5), (12, 4), (12, 6)]], "hole 1 does not lie inside"),  # touches from outside
        ([SQUARE, [(1, 1), (8, 1), (8, 8), (1, 8)], [(3, 3), (4, 3), (4, 4)]], "hole 2 lies in hole 1"),
        ([SQUARE, [(1, 1), (5, 1), (5, 5)], [(2, 1), (6, 0), (6, 4)]], "cross"),
    ],
)
def test_what_is_no_polygon_is_refused(rings: list[Corners], message: str) -> None:
    with pytest.raises(MapError, match=message):
        polygon(*rings)


def test_a_hole_that_leaves_through_corners_only_is_noticed() -> None:
    crown: Corners = [(0, 0), (12, 0), (12, 10), (9, 4), (6, 10), (3, 4), (0, 10)]
    with pytest.raises(MapError, match="hole 1 does not lie inside"):
        polygon(crown, [(3, 4), (6, 2), (9, 4), (9, 11), (3, 11)])
    assert polygon(crown, [(3, 4), (6, 2), (9, 4), (6, 6)]).area > 0
