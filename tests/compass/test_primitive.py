from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from ial.compass.primitive import bits, primitive, reverse
from ial.errors import ConfigError
from ial.maps.polygons.exact.rational import rational


@pytest.mark.parametrize(
    ("given", "shortest"),
    [
        ((6, -4), (3, -2)),
        ((0, 9), (0, 1)),
        ((-5, 0), (-1, 0)),
        ((Fraction(1, 3), Fraction(1, 2)), (2, 3)),
        ((rational(3) / 4, -1), (3, -4)),
        ((10**40, 10**40), (1, 1)),
    ],
)
def test_a_direction_is_two_whole_numbers_without_a_common_divisor(given: tuple[Any, Any], shortest: tuple[int, int]) -> None:
    assert primitive(*given) == shortest
    assert reverse(shortest) == primitive(*(-each for each in given))
    assert all(type(each) is int for each in primitive(*given))


@pytest.mark.parametrize("component", [0.5, 1.0, np.float64(2.0), "1", None])
def test_what_is_no_exact_number_is_refused(component: Any) -> None:
    for given in ((component, 1), (1, component)):
        with pytest.raises(ConfigError, match="give whole numbers or fractions"):
            primitive(*given)


def test_a_direction_leads_somewhere() -> None:
    with pytest.raises(ConfigError, match="leads nowhere"):
        primitive(0, Fraction(0))


def test_bits() -> None:
    assert bits((3, -8)) == 4
    assert bits((2**63, 1)) == 64
