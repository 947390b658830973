import random
from fractions import Fraction

import pytest

from ial.maps.polygons.exact.shooter import Shooter
from ial.maps.polygons.exact.visibility import Visibility
from ial.maps.polygons.exact.visibility_polygon import SPURIOUS, VisibilityPolygon
from ial.maps.polygons.polygon import ExactPoint
from ial.maps.polygons.ring import side
from tests.maps.polygons.exact.test_shooter import starts
from tests.maps.polygons.known_polygons import HOLED, L_SHAPE, SQUARE, TOUCHING, Z_SHAPE
from tests.maps.polygons.random_polygons import random_polygon


def holds(ring: tuple[ExactPoint, ...], x: Fraction, y: Fraction) -> int:
    scale = x.denominator * y.denominator
    for corner in ring:
        scale *= int(corner[0].denominator * corner[1].denominator)
    return side((int(x * scale), int(y * scale)), [(int(a * scale), int(b * scale)) for a, b in ring])


@pytest.mark.parametrize("seed", range(8))
def test_it_holds_what_is_seen_and_nothing_else(seed: int) -> None:
    chooser = random.Random(seed)
    polygon = [SQUARE, L_SHAPE, Z_SHAPE, HOLED, TOUCHING, *(random_polygon(9, each, 40) for each in range(3))][seed]
    shooter = Shooter(polygon)
    sight = Visibility(shooter)
    for place in starts(polygon, chooser, 6):
        seen = VisibilityPolygon.of(shooter, place)
        assert len(seen.corners) == len(seen.walls)
        for x, y in starts(polygon, chooser, 40):
            where = holds(seen.corners, x, y)
            if sight.sees(place, (x, y)):
                assert where >= 0 or not is_wide(sight, place, (x, y))
            else:
                assert where < 0


def is_wide(sight: Visibility, place: ExactPoint, other: ExactPoint) -> bool:
    """Whether more than a line is seen there: so is a point a little before it and aside."""
    (px, py), (x, y) = place, other
    before, aside = Fraction(1, 10**4), Fraction(1, 10**7)
    nearer = x + before * (px - x), y + before * (py - y)
    return any(sight.sees(place, (nearer[0] + sign * aside * (py - y), nearer[1] + sign * aside * (x - px))) for sign in (1, -1))


def test_spurious_edges_lie_on_rays_past_corners() -> None:
    seen = VisibilityPolygon.of(Shooter(L_SHAPE), (Fraction(3), Fraction(1)))
    assert seen.spurious == (((2, 2), (0, 4)),)
    assert VisibilityPolygon.of(Shooter(SQUARE), (Fraction(1), Fraction(2))).spurious == ()
    for begin, end in VisibilityPolygon.of(Shooter(HOLED), (Fraction(1), Fraction(1))).spurious:
        (ax, ay), (bx, by) = begin, end
        assert (ax - 1) * (by - 1) == (ay - 1) * (bx - 1)


def test_from_a_wall_and_from_a_corner() -> None:
    whole = VisibilityPolygon.of(Shooter(SQUARE), (Fraction(0), Fraction(0)))
    assert set(whole.corners) == {(0, 0), (4, 0), (4, 4), (0, 4)}
    on_wall = VisibilityPolygon.of(Shooter(L_SHAPE), (Fraction(1), Fraction(0)))
    assert (1, 0) in on_wall.corners
    assert on_wall.walls.count(SPURIOUS) >= 2, "to the point itself"
