from fractions import Fraction

import pytest

from ial.errors import MapError
from ial.maps.polygons.exact_number import exact_number, text_of


@pytest.mark.parametrize(
    ("value", "number"),
    [("1/3", Fraction(1, 3)), ("-0.1", Fraction(-1, 10)), ("2.5e-3", Fraction(1, 400)), (7, Fraction(7)), (" .5 ", Fraction(1, 2))],
)
def test_numbers_are_read_without_rounding(value: object, number: Fraction) -> None:
    assert exact_number(value, "here") == number
    assert exact_number(text_of(number), "here") == number


@pytest.mark.parametrize("value", ["", "x", "1e99999", "nan", "inf", "1/2/3", "0x1", 0.5, None, True, "9" * 500, "1 2"])
def test_what_is_no_exact_number_is_refused(value: object) -> None:
    with pytest.raises(MapError, match=r"corner 3: .* is no number"):
        exact_number(value, "corner 3")


def test_a_zero_denominator_is_named() -> None:
    with pytest.raises(MapError, match="divides by zero"):
        exact_number("1/0", "here")


@pytest.mark.parametrize("value", ["1e999", "-1e16", 10**16, Fraction(10**16), "1000000000000001"])
def test_what_no_plan_or_clock_can_mean_is_refused(value: object) -> None:
    with pytest.raises(MapError, match="is too large"):
        exact_number(value, "here")
    assert exact_number("1e15", "here") == exact_number(10**15, "here") == 10**15
