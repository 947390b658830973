from fractions import Fraction

import pytest

from ial.bouncing.start import ANYWHERE, Start
from ial.errors import ConfigError


def test_nothing_is_known_by_default() -> None:
    assert ANYWHERE.holds_heading(Fraction(5), Fraction(5))
    assert ANYWHERE.holds_place(Fraction(-100), Fraction(10**6))
    assert Start() == ANYWHERE


HELD = [(80, 90), (90, 95), (100, 100), (60, 200), (440, 450), (-280, -260)]
NOT_HELD = [(101, 110), (70, 89), (461, 470), (-180, -80)]


@pytest.mark.parametrize(("low", "high", "held"), [(*each, True) for each in HELD] + [(*each, False) for each in NOT_HELD])
def test_headings_are_held_whatever_turn_they_are_of(low: int, high: int, held: bool) -> None:
    start = Start(headings_deg=((Fraction(90), Fraction(100)),))
    assert start.holds_heading(Fraction(low), Fraction(high)) == held


def test_an_interval_may_pass_zero() -> None:
    start = Start(headings_deg=((Fraction(-10), Fraction(10)), (Fraction(180), Fraction(180))))
    held = {each: start.holds_heading(Fraction(each), Fraction(each)) for each in (350, 349, 0, 10, 11, 180, 181)}
    assert held == {350: True, 349: False, 0: True, 10: True, 11: False, 180: True, 181: False}


def test_a_region_has_its_border() -> None:
    start = Start((Fraction(1), Fraction(2), Fraction(3), Fraction(4)))
    assert all(start.holds_place(Fraction(x), Fraction(y)) for x, y in ((1, 2), (3, 4), (2, 3)))
    assert not any(start.holds_place(Fraction(x), Fraction(y)) for x, y in ((0, 3), (2, 5)))


def test_a_record_gives_the_start_back() -> None:
    for start in (ANYWHERE, Start((Fraction(1, 3), *map(Fraction, (2, 3, 4))), ((Fraction(1), Fraction(7, 2)),))):
        assert Start.of_record(start.record()) == start


def test_what_holds_nothing_is_refused() -> None:
    with pytest.raises(ConfigError, match="ends before it begins"):
        Start(headings_deg=((Fraction(2), Fraction(1)),))
    with pytest.raises(ConfigError, match="region at the start is empty"):
        Start((Fraction(2), Fraction(0), Fraction(1), Fraction(1)))
