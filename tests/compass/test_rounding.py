import math
import random
from fractions import Fraction

from ial.compass.planning import localizing_sequence
from ial.compass.rounding import rounded, rounded_share
from tests.maps.polygons.exact.test_shooter import starts
from tests.maps.polygons.known_polygons import SQUARE
from tests.maps.polygons.random_polygons import random_polygon


def test_a_rounded_direction_is_the_unit_vector_of_doubles() -> None:
    for direction in [(3, 4), (1, 3), (-(10**15), 7), (2**63 - 1, 2**62 + 1)]:
        x, y = rounded(direction)
        length = math.hypot(*direction)
        assert abs(Fraction(x, y) - Fraction(*direction)) <= abs(Fraction(*direction)) * Fraction(1, 2**50)
        assert (x * direction[0] > 0, y * direction[1] > 0) == (True, True)
        assert length > 0
    assert Fraction(*rounded((1, 3))) != Fraction(1, 3)
    assert Fraction(*rounded((0, -5))) == 0


def test_axes_survive_and_walls_at_an_angle_do_not() -> None:
    square = localizing_sequence(SQUARE)
    assert rounded_share(square, SQUARE.outer) == 1.0
    polygon = random_polygon(20, 1)
    sequence = localizing_sequence(polygon)
    places = [*polygon.outer, *starts(polygon, random.Random(3), 20)]
    assert rounded_share(sequence, places) < 0.5
