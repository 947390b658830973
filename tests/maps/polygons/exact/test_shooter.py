"""Rays against a twin that knows the closed polygon only as a set of points, and shares no code with the shooter."""

import random
from fractions import Fraction
from itertools import pairwise

import pytest

from ial.maps.polygons.exact.rational import fraction
from ial.maps.polygons.exact.shooter import Shooter
from ial.maps.polygons.polygon import ExactPoint, Polygon
from ial.maps.polygons.ring import side
from tests.bouncing.truth import random_environment

L = Polygon(((0, 0), (4, 0), (4, 2), (2, 2), (2, 4), (0, 4)))  # type: ignore[arg-type]
HOLED = Polygon(((0, 0), (9, 0), (9, 4), (5, 4), (5, 7), (0, 7)), (((2, 2), (2, 4), (3, 4), (3, 2)),))  # type: ignore[arg-type]
STRAIGHT = Polygon(((0, 0), (2, 0), (4, 0), (4, 3), (3, 3), (0, 3)))  # type: ignore[arg-type]


def is_free(polygon: Polygon, x: Fraction, y: Fraction) -> bool:
    """Return whether a point lies in the closed polygon."""
    sides = []
    for ring in polygon.rings:
        scale = x.denominator * y.denominator
        for corner in ring:
            scale *= corner[0].denominator * corner[1].denominator
        sides.append(side((int(x * scale), int(y * scale)), [(int(a * scale), int(b * scale)) for a, b in ring]))
    return sides[0] >= 0 and all(each <= 0 for each in sides[1:])


def end_of_ray(polygon: Polygon, start: ExactPoint, direction: tuple[int, int]) -> ExactPoint:
    """Cut the ray at every line of a wall; it goes on as long as the middles of the parts are free."""
    (px, py), (ux, uy) = start, direction
    stops = {Fraction(0)}
    for ring in polygon.rings:
        for (ax, ay), (bx, by) in zip(ring, [*ring[1:], ring[0]], strict=True):
            for cx, cy in ((ax, ay), (bx, by)):
                if ux * (cy - py) == uy * (cx - px):
                    stops.add(((cx - px) * ux + (cy - py) * uy) / Fraction(ux * ux + uy * uy))
            slope = ux * (by - ay) - uy * (bx - ax)
            if slope:
                stops.add(((ax - px) * (by - ay) - (ay - py) * (bx - ax)) / slope)
    ways = sorted(way for way in stops if way >= 0)
    for near, far in pairwise([*ways, ways[-1] + 1]):
        middle = (near + far) / 2
        if not is_free(polygon, px + middle * ux, py + middle * uy):
            return px + near * ux, py + near * uy
    raise AssertionError("unreachable")


def starts(polygon: Polygon, chooser: random.Random, count: int) -> list[ExactPoint]:
    """Corners, points on walls, and points inside."""
    found = []
    x0, y0, x1, y1 = polygon.bounds
    while len(found) < count:
        ring = chooser.choice(polygon.rings)
        at = chooser.randrange(len(ring))
        (ax, ay), (bx, by) = ring[at], ring[(at + 1) % len(ring)]
        part = Fraction(chooser.randrange(8), 8)
        inside = x0 + (x1 - x0) * Fraction(chooser.randrange(17), 16), y0 + (y1 - y0) * Fraction(chooser.randrange(17), 16)
        place = chooser.choice([(ax, ay), (ax + part * (bx - ax), ay + part * (by - ay)), inside])
        if is_free(polygon, *place):
            found.append(place)
    return found


def directions(polygon: Polygon, start: ExactPoint, chooser: random.Random) -> list[tuple[int, int]]:
    """Along the axes and the walls, to corners, and any."""
    made = [(1, 0), (0, 1), (-1, 0), (0, -1), (chooser.randrange(-9, 10), chooser.randrange(-9, 10))]
    for _ in range(3):
        ring = chooser.choice(polygon.rings)
        (ax, ay), (bx, by) = chooser.choice(list(pairwise(ring)))
        for x, y in ((bx - ax, by - ay), (ax - start[0], ay - start[1])):
            scale = x.denominator * y.denominator
            made.append((int(x * scale), int(y * scale)))
    return [each for each in made if each != (0, 0)]


@pytest.mark.many
@pytest.mark.parametrize("seed", range(24))
def test_rays_end_where_the_next_part_is_not_free(seed: int) -> None:
    chooser = random.Random(seed)
    polygons = [L, HOLED, STRAIGHT, *random_environment(seed).polygons]
    for polygon in polygons[seed % 3 :: 3] if seed % 2 else polygons[3:]:
        shooter = Shooter(polygon)
        for start in starts(polygon, chooser, 12):
            for direction in directions(polygon, start, chooser):
                hit = shooter.shoot(start, direction)
                assert (fraction(hit.x), fraction(hit.y)) == end_of_ray(polygon, start, direction)
                assert hit.corner == (hit.place in shooter.corners)
                part = shooter.part(hit, hit.edge)
                assert 0 <= part < 1
                assert (part == 0) == hit.corner


def test_it_slides_along_walls_and_passes_corners_that_it_touches() -> None:
    shooter = Shooter(HOLED)
    for start, direction, end in [
        ((9, 4), (-1, 0), (0, 4)),  # along a wall, over a reflex corner, along the pillar
        ((0, 2), (1, 0), (9, 2)),  # along the pillar
        ((0, 4), (1, 0), (9, 4)),
        ((5, 0), (0, 1), (5, 7)),  # past the reflex corner, then along the wall
        ((0, 1), (2, 1), (2, 2)),  # into the corner of the pillar
        ((0, 0), (1, 1), (2, 2)),
        ((1, 1), (1, -1), (2, 0)),
        ((1, 3), (1, -1), (4, 0)),  # touches the corner
    ]:
        hit = shooter.shoot((Fraction(start[0]), Fraction(start[1])), direction)
        assert (hit.x, hit.y) == end
    collinear = Shooter(STRAIGHT)
    assert collinear.shoot((Fraction(0), Fraction(0)), (1, 0)).place == (4, 0)
    assert collinear.shoot((Fraction(4), Fraction(3)), (-1, 0)).place == (0, 3)


def test_a_point_that_faces_a_wall_stays() -> None:
    shooter = Shooter(L)
    assert shooter.shoot((Fraction(1), Fraction(0)), (1, -9)).place == (1, 0)
    assert shooter.shoot((Fraction(2), Fraction(2)), (1, 1)).place == (2, 2)
    assert shooter.shoot((Fraction(2), Fraction(2)), (0, 1)).place == (2, 4)


def test_what_lies_closer_together_than_doubles_tell_is_decided_exactly() -> None:
    tiny = Fraction(1, 10**40)
    slit = Polygon(((0, 0), (4, 0), (4, 3), (2 + tiny, 3), (2, 1), (2 - tiny, 3), (0, 3)))  # type: ignore[arg-type]
    shooter = Shooter(slit)
    left, right = shooter.shoot((Fraction(0), Fraction(1)), (1, 0)), shooter.shoot((Fraction(0), 1 + tiny**2), (1, 0))
    assert left.place == (4, 1)
    assert right.place != left.place
    assert 0 < 2 - right.x < tiny
    assert shooter.shoot((Fraction(0), 1 - tiny**2), (1, 0)).place == (4, 1 - tiny**2)


def test_directions_may_be_larger_than_doubles() -> None:
    hit = Shooter(L).shoot((Fraction(1), Fraction(1)), (10**400, 10**400 - 1))
    assert hit.place == end_of_ray(L, (Fraction(1), Fraction(1)), (10**400, 10**400 - 1))


def test_of_walls_closer_together_than_doubles_tell_the_first_one_stops_it() -> None:
    """One spike comes from above, and ends just below the ray; behind it one from below ends just above the ray."""
    chooser, tiny = random.Random(3), Fraction(1, 10**18)
    for _ in range(60):
        ux, uy = 40, chooser.randrange(10, 30)
        start = Fraction(chooser.randrange(-20, 0), 10), Fraction(chooser.randrange(5), 10)
        way, gap = Fraction(chooser.randrange(30, 90), 1001), tiny * chooser.choice([2, 3, 7])
        (x0, y0), (x1, y1) = ((start[0] + part * ux, start[1] + part * uy) for part in (way, way + gap))
        one, other = (Fraction(chooser.randrange(1, 400), 97) for _ in range(2))
        above = [(x0 + one + 1, Fraction(9)), (x0, y0 - tiny), (x0 + one, Fraction(9))]
        below = [(x1 - other - 1, Fraction(-3)), (x1, y1 + tiny), (x1 - other, Fraction(-3))]
        polygon = Polygon(((-12, -3), *below, (12, -3), (12, 9), *above, (-12, 9)))  # type: ignore[arg-type]
        assert Shooter(polygon).shoot(start, (ux, uy)).place == end_of_ray(polygon, start, (ux, uy))


def test_a_wall_nearly_along_the_ray_does_not_hide_the_one_before_it() -> None:
    """Doubles cannot tell where the slanted wall is crossed; the first place where that may be lies before the wall that is hit."""
    slope, crossed = Fraction(1, 10**10), Fraction(20005, 10000)
    slanted = ((Fraction(3, 2), 1 + slope * (Fraction(3, 2) - crossed)), (3, 1 + slope * (3 - crossed)))
    spike = ((2 + Fraction(1, 10**5), 3), (2, 1 - slope / 5000), (2, 3))
    polygon = Polygon(((0, 0), (3, 0), (3, Fraction(9, 10)), *slanted, (3, 3), *spike, (0, 3)))  # type: ignore[arg-type]
    assert Shooter(polygon).shoot((Fraction(0), Fraction(1)), (1, 0)).place == (2, 1)
