import math
import random
from fractions import Fraction

import pytest

from ial.maps.polygons.exact.congruence import congruences, near_congruences
from ial.maps.polygons.polygon import Polygon
from tests.odometer.worlds import HALL, L_SHAPE, S_SHAPE, SQUARE, WORLDS, regular, ring


def laid_upon(one: Polygon, other: Polygon) -> int:
    """How many motions lay each corner upon a corner, by trying all pairs of corners of the outer rings."""
    count, targets = 0, set(other.rings[0])
    (ax, ay), (bx, by) = one.outer[:2]
    square = (bx - ax) ** 2 + (by - ay) ** 2
    for at, (cx, cy) in enumerate(other.outer):
        dx, dy = other.outer[(at + 1) % len(other.outer)]
        if (dx - cx) ** 2 + (dy - cy) ** 2 != square:
            continue
        c = ((bx - ax) * (dx - cx) + (by - ay) * (dy - cy)) / square
        s = ((bx - ax) * (dy - cy) - (by - ay) * (dx - cx)) / square
        moved = [[(cx + c * (x - ax) - s * (y - ay), cy + s * (x - ax) + c * (y - ay)) for x, y in each] for each in one.rings]
        count += set(moved[0]) == targets and {frozenset(each) for each in moved} == {frozenset(each) for each in other.rings}
    return count


@pytest.mark.parametrize(("polygon", "order"), [(SQUARE, 4), (S_SHAPE, 2), (L_SHAPE, 1), (HALL, 1)])
def test_symmetries(polygon: Polygon, order: int) -> None:
    found = congruences(polygon, polygon)
    assert len(found) == order == len(near_congruences(polygon, polygon, 1e-9))
    assert (found[0].cosine, found[0].sine, found[0].x, found[0].y) == (1, 0, 0, 0)
    assert all(each.exact for each in found)


def test_all_worlds_as_by_trial() -> None:
    for polygon in WORLDS.values():
        assert len(congruences(polygon, polygon)) == laid_upon(polygon, polygon)


def test_holes_count() -> None:
    hole = ring((1, 1), (1, 2), (2, 2), (2, 1))
    assert len(congruences(*[Polygon(SQUARE.outer, (hole,))] * 2)) == 4
    aside = Polygon(SQUARE.outer, (ring((1, 1), (1, 2), (1.5, 2), (1.5, 1)),))
    assert len(congruences(aside, aside)) == 1
    assert len(near_congruences(aside, aside, 1e-9)) == 1
    assert congruences(aside, SQUARE) == near_congruences(aside, SQUARE, 1e-9) == []
    two = Polygon(SQUARE.outer, (ring((0.5, 0.5), (0.5, 1), (1, 1), (1, 0.5)), ring((2, 2), (2, 2.5), (2.5, 2.5), (2.5, 2))))
    assert len(congruences(two, two)) == len(near_congruences(two, two, 1e-9)) == 2


def test_a_polygon_that_was_moved_is_found_again() -> None:
    chooser = random.Random(2)
    for polygon in (L_SHAPE, HALL, S_SHAPE):
        x, y = Fraction(chooser.randrange(-50, 50), 7), Fraction(chooser.randrange(-50, 50), 3)
        c, s = Fraction(3, 5), Fraction(4, 5)
        outer, *holes = (tuple((c * a - s * b + x, s * a + c * b + y) for a, b in each) for each in polygon.rings)
        moved = Polygon((*outer[2:], *outer[:2]), tuple(holes))
        found = congruences(polygon, moved)
        assert len(found) == laid_upon(polygon, moved) > 0
        assert (c, s, x, y) in [(each.cosine, each.sine, each.x, each.y) for each in found]
        (px, py) = polygon.outer[0]
        assert found[0].moved(float(px), float(py)) in [pytest.approx((float(a), float(b))) for a, b in moved.outer]


def test_a_reflection_is_none() -> None:
    mirrored = Polygon(tuple((-x, y) for x, y in L_SHAPE.outer))
    bent = Polygon(ring((0, 0), (5, 0), (5, 2), (2, 1), (2, 4), (0, 4)))
    assert congruences(bent, Polygon(tuple((-x, y) for x, y in bent.outer))) == []
    assert len(congruences(L_SHAPE, mirrored)) == laid_upon(L_SHAPE, mirrored)


def test_a_pentagon_has_five_near_rotations_and_one_exact() -> None:
    found = near_congruences(regular(5), regular(5), 1e-9)
    assert len(found) == 5
    assert len(congruences(regular(5), regular(5))) == 1
    assert sorted(round(math.degrees(each.turn_rad)) for each in found) == [-144, -72, 0, 72, 144]
    assert not any(each.exact for each in found)


def test_corners_at_which_a_ring_goes_straight_on_do_not_count() -> None:
    plain = Polygon(((0, 0), (6, 0), (6, 5), (0, 5)))  # type: ignore[arg-type]
    marked = Polygon(((0, 0), (3, 0), (6, 0), (6, 5), (0, 5), (0, 1)))  # type: ignore[arg-type]
    hole = ((2, 2), (3, 2), (4, 2), (4, 3), (2, 3))
    holed = Polygon(((0, 0), (6, 0), (6, 5), (0, 5)), (hole,))  # type: ignore[arg-type]
    for one, other in ((plain, marked), (marked, plain), (marked, marked)):
        assert len(congruences(one, other)) == len(near_congruences(one, other, 1e-9)) == 2
    assert len(congruences(holed, holed)) == len(near_congruences(holed, holed, 1e-9)) == 2
