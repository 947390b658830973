import math
import random
from fractions import Fraction

import pytest
import shapely

from ial.bouncing.rays.contact_wall import TINY, ContactWall
from ial.maps.polygons.direction import ONE, direction

WALL = ContactWall(2 * ONE, 2 * ONE, 2 * ONE, 5 * ONE, 2 * ONE, 0)
"""Up along x = 2 from y = 2 to 5, with free space on its left, and straight on from the wall before it."""

RIGHT, UP = (ONE, 0), (0, ONE)


def way(wall: ContactWall, x: float, y: float, heading: tuple[int, int], radius: float = 0) -> tuple[float | None, float | None]:
    """The ways to the side and to the corner, in metres."""
    place = round(Fraction(x) * ONE), round(Fraction(y) * ONE)
    ways = (each(*place, *heading, round(Fraction(radius) * ONE)) for each in (wall.way_to_side, wall.way_to_corner))
    return tuple(None if each is None else each / ONE for each in ways)  # type: ignore[return-value]


def test_distances_are_those_of_shapely() -> None:
    chooser = random.Random(0)
    for _ in range(200):
        ax, ay, bx, by, x, y = (chooser.randint(-9, 9) for _ in range(6))
        if (ax, ay) != (bx, by):
            expected = shapely.LineString([(ax, ay), (bx, by)]).distance(shapely.Point(x, y))
            assert math.sqrt(ContactWall(ax, ay, bx, by, 0, 0).square_from(x, y)) == pytest.approx(expected)


def test_an_odd_number_of_walls_is_crossed_from_inside() -> None:
    corners = [(0, 0), (8, 1), (5, 4), (9, 9), (4, 6), (1, 9), (3, 5)]
    walls = [ContactWall(*corners[at - 1], *corners[at], 0, 0) for at in range(len(corners))]
    polygon = shapely.Polygon(corners)
    for x in range(-1, 11):
        for y in range(-1, 11):
            if not polygon.boundary.intersects(shapely.Point(x, y)):
                crossed = sum(wall.is_crossed_leftwards_of(x, y) for wall in walls)
                assert crossed % 2 == polygon.contains(shapely.Point(x, y))


def test_a_side_is_met_between_its_ends_by_what_leads_into_it() -> None:
    assert way(WALL, 0, 3, RIGHT) == (2, None)
    assert way(WALL, 0, 3, RIGHT, 0.5) == (1.5, None)
    assert way(WALL, 0, 6, RIGHT) == (None, None), "above its end"
    assert way(WALL, 0, 3, UP) == (None, None), "along it"
    assert way(WALL, 2, 3, (-ONE, 0)) == (None, None), "away from it"
    assert way(WALL, 3, 3, RIGHT) == (None, None), "behind it"
    assert way(WALL, 2, 3, direction(Fraction(1, 10**9))) == (0, None), "it stands there"
    near = -TINY, TINY
    assert [WALL.way_to_side(2 * ONE + off, 3 * ONE, ONE, 0, 0) for off in near] == [TINY, 0], "rounding has put it behind the wall"


def test_a_corner_is_met_by_a_disk_that_passes_nearer_than_its_radius() -> None:
    assert way(WALL, 0, 1.7, RIGHT, 0.5)[1] == pytest.approx(1.6), "3, 4, 5"
    assert way(WALL, 0, 1.5, RIGHT, 0.5)[1] is None, "a graze"
    assert way(WALL, 0, 1.5 + 1e-20, RIGHT, 0.5)[1] is None, "the sum is rounded to a graze"
    assert way(WALL, 0, 1.5 + 2**-50, RIGHT, 0.5)[1] == pytest.approx(2.0, abs=1e-7)
    assert way(WALL, 4, 2, RIGHT, 0.5)[1] is None, "behind it"


@pytest.mark.parametrize(
    ("before", "after", "passed", "stopped"),
    [
        ((0, -1), (-1, 0), [180, 225, 270], [0, 45, 90, 135, 315]),  # convex: free space is the quarter to the lower left
        ((-1, 0), (0, -1), [0, 45, 90, 135, 180, 270, 300], [190, 225, 260]),  # reflex: all but that quarter is free
        ((-1, 0), (1, 0), [0, 90, 180], [190, 270, 350]),  # straight on
    ],
)
def test_a_point_at_a_corner_drives_on_if_free_space_lies_ahead(
    before: tuple[int, int], after: tuple[int, int], passed: list[int], stopped: list[int]
) -> None:
    """Walls lead from `before` to (0, 0) and on to `after`."""
    wall = ContactWall(0, 0, after[0] * ONE, after[1] * ONE, before[0] * ONE, before[1] * ONE)
    ways = {degrees: wall.way_to_corner(0, 0, *direction(Fraction(degrees, 360)), 0) for degrees in (*passed, *stopped)}
    assert ways == dict.fromkeys(passed) | dict.fromkeys(stopped, 0)
