import math
from fractions import Fraction
from itertools import islice

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ial.maps.polygons.exact_cosine import cosine_bounds, rational_cosine
from tests.bouncing.cells.test_headings import cosine


@pytest.mark.slow
@given(st.fractions(-2, 2, max_denominator=720))
def test_bounds_hold_the_cosine_and_become_narrower(turn: Fraction) -> None:
    exact = cosine(turn)
    widths = []
    for lower, upper in islice(cosine_bounds(turn), 3):
        assert lower - Fraction(1, 10**110) <= exact <= upper + Fraction(1, 10**110)
        widths.append(upper - lower)
    assert widths[0] < Fraction(1, 2**48)
    assert widths[1] < Fraction(1, 2**58)
    assert widths[2] < Fraction(1, 2**120)


def test_the_rational_cosines_are_those_of_nivens_theorem() -> None:
    cosines = {degrees: rational_cosine(Fraction(degrees, 360)) for degrees in range(-360, 720)}
    for degrees, value in cosines.items():
        assert (value is not None) == (degrees % 60 == 0 or degrees % 90 == 0)
        if value is not None:
            assert math.isclose(value, math.cos(math.radians(degrees)), abs_tol=1e-12)
