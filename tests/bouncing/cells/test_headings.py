import math
from fractions import Fraction

import mpmath
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ial.bouncing.cells.heading_classes import HeadingClasses
from ial.bouncing.cells.headings import Headings, rounded_cosine
from ial.errors import ConfigError
from ial.maps.polygons.exact_cosine import rational_cosine


def cosine(turn: Fraction) -> Fraction:
    with mpmath.workdps(120):
        return Fraction(*mpmath.libmp.to_rational(mpmath.cos(2 * mpmath.pi * turn.numerator / mpmath.mpf(turn.denominator))._mpf_))


@given(st.fractions(0, 1, max_denominator=360), st.fractions(Fraction(1, 2), 50, max_denominator=8))
def test_offsets_are_rounded_as_exact_numbers(turn: Fraction, length: Fraction) -> None:
    value = cosine(turn) * length
    if rational_cosine(turn) is not None:
        value = (rational_cosine(turn) or Fraction(0)) * length
    expected = math.floor(abs(value) + Fraction(1, 2)) * (1 if value >= 0 else -1)
    assert rounded_cosine(turn, length) == expected
    assert rounded_cosine(turn + Fraction(1, 2), length) == -expected


def test_halves_are_rounded_away_from_zero_in_both_directions() -> None:
    assert [rounded_cosine(Fraction(d, 360), Fraction(1)) for d in (60, 120, 240, 300)] == [1, -1, -1, 1]
    assert Headings.of_angle(Fraction(60), 6).offsets.tolist() == [[1, 0], [1, 1], [-1, 1], [-1, 0], [-1, -1], [1, -1]]


@pytest.mark.slow
def test_what_doubles_cannot_decide_is_decided() -> None:
    exact = cosine(Fraction(1, 5))
    for digits in (20, 40, 80):
        nearest = Fraction(round(10**digits / (2 * exact)), 10**digits)  # nearest·cos is a half up to 10^-digits
        for length in (nearest, nearest + Fraction(1, 10**digits), nearest - Fraction(1, 10**digits)):
            assert rounded_cosine(Fraction(1, 5), length) == math.floor(exact * length + Fraction(1, 2))


def test_offsets_turn_with_the_plane() -> None:
    for count in (4, 8, 12, 20, 360):
        offsets = Headings(count, 1).offsets.tolist()
        quarter = count // 4
        assert all(offsets[(t + quarter) % count] == [-y, x] for t, (x, y) in enumerate(offsets))


def test_steps_of_one_cell_know_eight_directions() -> None:
    headings = Headings.of_angle(Fraction(90), 360)
    assert len({tuple(offset) for offset in headings.offsets.tolist()}) == 8
    classes = HeadingClasses.merged(headings)
    assert len(classes) == 8
    assert sorted(classes.sizes.tolist()) == [31, 31, 31, 31, 59, 59, 59, 59]
    assert len({tuple(each) for each in Headings(360, 90, Fraction(4)).offsets.tolist()}) == 32


def test_an_angle_needs_as_many_headings() -> None:
    assert Headings.of_angle(Fraction(135)).count == 8
    assert Headings.of_angle(Fraction(-90)).turn == 3
    assert Headings.of_angle(Fraction(45, 2)).bounce_deg == Fraction(45, 2)
    assert Headings.of_angle(Fraction(100), 18).orbit == 18


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((Fraction(50), 8), "bouncing angle 50° is not a multiple of 45°.*multiple of 36 headings"),
        ((Fraction(360), 8), "multiple of 360°"),
        ((Fraction(0),), "multiple of 360°"),
        ((Fraction(90), 0), "number of headings is 0"),
        ((Fraction(90), 2**15 + 4), "number of headings is 32772"),
        ((Fraction(90), 8, Fraction(1, 2)), r"too short: in heading 1 \(45°\) it rounds to offset \(0, 0\)"),
        ((Fraction(90), 4, Fraction(-1)), "the step is -1 cells"),
    ],
)
def test_bad_headings_are_refused(arguments: tuple[Fraction, int, Fraction], message: str) -> None:
    with pytest.raises(ConfigError, match=message):
        Headings.of_angle(*arguments)


@pytest.mark.parametrize(
    ("angle", "count", "step", "aside_deg", "length"),
    [
        (90, None, 1, 0.0, 0.0),
        (90, None, 7, 0.0, 0.0),
        (45, None, 1, 0.0, math.sqrt(2) - 1),
        (Fraction(45, 2), None, 1, 22.5, math.sqrt(2) - 1),
        (90, None, Fraction(3, 4), 0.0, 1 / 3),
        (90, 36, 10**6, 0.0, 0.0),
    ],
)
def test_how_far_offsets_are_beside_steps(angle: Fraction, count: int | None, step: Fraction, aside_deg: float, length: float) -> None:
    errors = Headings.of_angle(Fraction(angle), count, Fraction(step)).offset_errors
    assert errors == pytest.approx((aside_deg, length), abs=1e-4)
    if aside_deg == length == 0.0 and count is None:
        assert errors == (0.0, 0.0)


@given(st.integers(1, 720), st.fractions(1, 40, max_denominator=6))
def test_no_offset_is_further_beside_its_step_than_is_said(count: int, step: Fraction) -> None:
    headings = Headings(count, 1, step) if count > 1 else Headings(2, 1, step)
    degrees, length = headings.offset_errors
    for heading, (x, y) in enumerate(headings.offsets.tolist()):
        turn = complex(x, y) / complex(math.cos(math.tau * heading / headings.count), math.sin(math.tau * heading / headings.count))
        assert abs(math.degrees(math.atan2(turn.imag, turn.real))) <= degrees + 1e-9
        assert abs(abs(turn) / float(step) - 1.0) <= length + 1e-9
