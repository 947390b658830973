"""Sight against a twin that walks along the segment and asks at the middle of every part whether it is free."""

import random
from fractions import Fraction
from itertools import combinations, pairwise

import pytest

from ial.maps.polygons.exact.shooter import Shooter
from ial.maps.polygons.exact.visibility import Visibility
from ial.maps.polygons.polygon import ExactPoint, Polygon
from tests.maps.polygons.exact.test_shooter import is_free, starts
from tests.maps.polygons.known_polygons import HOLED, L_SHAPE, STRAIGHT_CORNERS, TOUCHING, Z_SHAPE
from tests.maps.polygons.random_polygons import random_polygon

POLYGONS = [HOLED, L_SHAPE, STRAIGHT_CORNERS, TOUCHING, Z_SHAPE, random_polygon(9, 3, 30), random_polygon(14, 5, 40)]


def sees(polygon: Polygon, one: ExactPoint, other: ExactPoint) -> bool:
    """Cut the segment at the line of every wall; it is seen through if the middles of the parts are free."""
    (px, py), (ux, uy) = one, (other[0] - one[0], other[1] - one[1])
    cuts = {Fraction(0), Fraction(1)}
    for ring in polygon.rings:
        for (ax, ay), (bx, by) in zip(ring, [*ring[1:], ring[0]], strict=True):
            slope = ux * (by - ay) - uy * (bx - ax)
            if slope:
                cuts.add(((ax - px) * (by - ay) - (ay - py) * (bx - ax)) / slope)
            elif ux or uy:
                cuts |= {((x - px) * ux + (y - py) * uy) / (ux * ux + uy * uy) for x, y in ((ax, ay), (bx, by))}
    inside = sorted(cut for cut in cuts if 0 <= cut <= 1)
    return all(is_free(polygon, px + (near + far) / 2 * ux, py + (near + far) / 2 * uy) for near, far in pairwise(inside))


@pytest.mark.parametrize("polygon", POLYGONS)
def test_points_see_each_other_if_all_between_is_free(polygon: Polygon) -> None:
    sight = Visibility(Shooter(polygon))
    places = starts(polygon, random.Random(1), 9)
    answers = []
    for one, other in combinations(places, 2):
        answers.append(sees(polygon, one, other))
        assert sight.sees(one, other) == sight.sees(other, one) == answers[-1]
    assert sight.sees(places[0], places[0])
    assert any(answers)
    for place in places:
        assert sight.seen(place, places) == [sees(polygon, place, other) for other in places]
        assert sight.seen_turns(place) == [corner for corner in sight.turns if sees(polygon, place, sight.shooter.corners[corner])]


def test_paths_turn_at_reflex_corners_alone() -> None:
    assert [Shooter(Z_SHAPE).corners[corner] for corner in Visibility(Shooter(Z_SHAPE)).turns] == [(4, 3), (5, 6)]
    assert len(Visibility(Shooter(HOLED)).turns) == 1 + 4
    assert Visibility(Shooter(STRAIGHT_CORNERS)).turns == []
    assert Visibility(Shooter(STRAIGHT_CORNERS)).seen_turns((Fraction(0), Fraction(0))) == []


@pytest.mark.parametrize("polygon", POLYGONS)
def test_a_bitangent_touches_both_corners_and_goes_on_behind_them(polygon: Polygon) -> None:
    sight = Visibility(Shooter(polygon))
    corners = sight.shooter.corners
    found = set(sight.bitangents())
    for one, other in combinations(sight.turns, 2):
        (ax, ay), (bx, by) = ((Fraction(int(x)), Fraction(int(y))) for x, y in (corners[one], corners[other]))
        tiny = Fraction(1, 10**9)
        behind = (ax - tiny * (bx - ax), ay - tiny * (by - ay)), (bx + tiny * (bx - ax), by + tiny * (by - ay))
        longer = all(is_free(polygon, *place) for place in behind) and sees(polygon, (ax, ay), (bx, by))
        assert ((one, other) in found) == longer
        assert sight.is_bitangent(other, one) == longer
    assert not sight.is_bitangent(0, 0)


def test_which_walls_are_bitangents() -> None:
    assert len(list(Visibility(Shooter(Z_SHAPE)).bitangents())) == 1
    assert list(Visibility(Shooter(L_SHAPE)).bitangents()) == []
    assert len(list(Visibility(Shooter(HOLED)).bitangents())) >= 4
