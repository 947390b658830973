from fractions import Fraction

import pytest

from ial.maps.polygons.direction import BITS, ONE, direction
from ial.maps.polygons.exact_cosine import cosine_bounds


@pytest.mark.parametrize("turn", [Fraction(0), Fraction(1, 4), Fraction(1, 2), Fraction(3, 4), Fraction(-5, 4)])
def test_quarter_turns_are_exact(turn: Fraction) -> None:
    expected = [(1, 0), (0, 1), (-1, 0), (0, -1)][int(4 * turn) % 4]
    assert direction(turn) == (expected[0] * ONE, expected[1] * ONE)


@pytest.mark.parametrize("turn", [Fraction(1, 3), Fraction(1, 7), Fraction(-3, 11), Fraction(99, 100), Fraction(1, 10**9), Fraction(5, 8)])
def test_a_direction_is_right_to_a_hundred_bits(turn: Fraction) -> None:
    for part, number in zip((turn, turn - Fraction(1, 4)), direction(turn), strict=True):
        for lower, upper in cosine_bounds(part):
            if upper - lower < Fraction(1, 2**110):
                break
        assert lower - Fraction(1, 2**100) <= Fraction(number, ONE) <= upper + Fraction(1, 2**100)


def test_a_direction_has_length_one() -> None:
    for at in range(360):
        cosine, sine = direction(Fraction(at, 360))
        assert abs(cosine**2 + sine**2 - ONE**2) < 2 ** (2 * BITS - 100)
