from fractions import Fraction

import numpy as np
import pytest

from ial.compass.primitive import primitive
from ial.compass.strips import NOT_HERE, STAYS, Strips
from ial.maps.polygons.exact.rational import rational
from ial.maps.polygons.exact.shooter import Shooter
from ial.maps.polygons.polygon import Polygon
from tests.maps.polygons.known_polygons import HOLED, L_SHAPE, SPIKES, TOUCHING, comb
from tests.maps.polygons.random_polygons import random_polygon

TINY = Fraction(1, 10**30)
_TOOTH = ((4, 0), (4, 3), (2, 3), (Fraction(3, 2), -TINY / 4), (1, -TINY / 4), (Fraction(1, 2), 3), (-1, 3))
FLAT = Polygon(((-1, 0), (0, -TINY), *_TOOTH))  # type: ignore[arg-type]
"""Its lowest walls are so nearly level that doubles cannot tell, and a tooth comes down to them."""
SLIT = Polygon(((0, 0), (4, 0), (4, 3), (2 + TINY, 3), (2, 1), (2 - TINY, 3), (0, 3)))  # type: ignore[arg-type]


@pytest.mark.parametrize(
    "polygon", [HOLED, L_SHAPE, SPIKES, TOUCHING, SLIT, FLAT, comb(4), random_polygon(15, 1), random_polygon(30, 2, 60)]
)
def test_the_wall_ahead_is_the_one_where_a_ray_ends(polygon: Polygon) -> None:
    shooter = Shooter(polygon)
    tried = 0
    for direction in [(1, 0), (-1, 0), (0, -1), (7, 3), primitive(*shooter.edges[1]), primitive(*shooter.edges[-1]), (10**15, 10**15 - 1)]:
        strips = Strips(shooter, direction)
        assert strips.ahead.shape == (len(strips.levels) - 1, len(shooter))
        for strip, edge in np.argwhere(strips.ahead != NOT_HERE).tolist():
            part = strips.part(edge, (strips.levels[strip] + strips.levels[strip + 1]) / rational(2))
            assert 0 < part < 1
            start = shooter.on_edge(edge, part)
            stop = shooter.shoot(start.place, direction)
            hit = int(strips.ahead[strip, edge])
            assert strips.turn(edge) == (1 if hit != STAYS else -1)
            assert stop.edge == (edge if hit == STAYS else hit)
            assert strips.level(edge, part) * 2 == strips.levels[strip] + strips.levels[strip + 1]
            tried += 1
    assert tried > 30


@pytest.mark.parametrize("seed", range(12))
def test_walls_of_which_doubles_cannot_tell_the_order(seed: int) -> None:
    """A slit from the right, nearly along the direction and much narrower than that."""
    tip = Fraction(1000 + 91 * seed, 997)
    low, high, between = (tip + each for each in (Fraction(1, 10**9), Fraction(1, 10**9) + Fraction(1, 10**19), Fraction(3, 10**10)))
    slit = ((0, 0), (4, 0), (4, low), (1, tip), (4, high), (4, 3), (0, 3), (0, between))
    strips = Strips(Shooter(Polygon(slit)), (1, 0))  # type: ignore[arg-type]
    assert strips.ahead[1].tolist() == [NOT_HERE, STAYS, 1, STAYS, NOT_HERE, NOT_HERE, NOT_HERE, 3]
    assert strips.ahead[2].tolist() == [NOT_HERE, STAYS, 1, STAYS, NOT_HERE, NOT_HERE, 3, NOT_HERE]


def test_a_level_lies_in_a_strip_or_is_that_of_a_corner() -> None:
    strips = Strips(Shooter(L_SHAPE), (1, 0))
    assert strips.levels == [0, 2, 4]
    assert [strips.strip(rational(each) / 2) for each in (1, 4, 5)] == [(0, False), (1, True), (1, False)]
    assert strips.turn(0) == strips.turn(2) == 0


def test_corners_that_are_passed_are_hit_or_left_behind() -> None:
    shooter = Shooter(L_SHAPE)
    strips = Strips(shooter, (1, 0))
    below = [(5, 1)]  # from the left wall at the height of the inner corner
    assert [point.place for point in strips.passed([*below, *below])] == [(4, 2), (4, 2)]
    assert repr(strips) == "<Strips: 2 in direction (1, 0)>"
