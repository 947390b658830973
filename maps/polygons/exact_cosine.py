"""Cosines of rational turns, decided exactly: which are rational, and bounds as narrow as one asks for."""

from collections.abc import Iterator
from fractions import Fraction

from ial.contractors.intervals.interval import Interval
from ial.contractors.intervals.trigonometric import TWO_PI_LOWER, TWO_PI_UPPER, cos

_RATIONAL = {
    Fraction(0): Fraction(1),
    Fraction(1, 6): Fraction(1, 2),
    Fraction(1, 4): Fraction(0),
    Fraction(1, 3): Fraction(-1, 2),
    Fraction(1, 2): Fraction(-1),
}


def rational_cosine(turn: Fraction) -> Fraction | None:
    """Return the cosine of a rational part of a full turn if it is rational; None if it is not.

    By Niven's theorem the only rational cosines of rational angles are 0, ±1/2 and ±1, at multiples of 60° and 90°.
    """
    turn %= 1
    return _RATIONAL.get(min(turn, 1 - turn))


def cosine_bounds(turn: Fraction) -> Iterator[tuple[Fraction, Fraction]]:
    """Yield bounds of the cosine of a part of a full turn, each narrower than the ones before: those in doubles first."""
    turn %= 1
    turn = min(turn, 1 - turn)  # cos is even: an angle from 0 to π
    angle = Interval(TWO_PI_LOWER, TWO_PI_UPPER) * turn
    lower, upper = cos(angle.lower, angle.upper)
    yield Fraction(lower), Fraction(upper)
    bits = 64
    while True:
        pi_lower, pi_upper = _pi_bounds(bits)
        upper_angle = 2 * turn * pi_upper
        # Cosine falls from 0 to π only: where the bound of the angle may lie beyond π, -1 is the lower bound.
        yield (_series(upper_angle, bits)[0] if upper_angle < pi_lower else Fraction(-1)), _series(2 * turn * pi_lower, bits)[1]
        bits *= 2


def _series(x: Fraction, bits: int) -> tuple[Fraction, Fraction]:
    """Return two partial sums of the series of the cosine that enclose it, nearer than 2^-bits to each other; 0 <= x < 4."""
    x = Fraction(round(x * 2 ** (2 * bits)), 2 ** (2 * bits)) if x.denominator.bit_length() > 2 * bits else x
    slack = Fraction(1, 2 ** (2 * bits))  # the cosine moves by no more than its angle
    term = total = Fraction(1)
    index = 0
    while index < 4 or abs(term) > Fraction(1, 2**bits):  # from the third term on they fall, since x² < 5·6
        before = total
        index += 2
        term *= -x * x / ((index - 1) * index)
        total += term
    return min(before, total) - slack, max(before, total) + slack


def _pi_bounds(bits: int) -> tuple[Fraction, Fraction]:
    """Return bounds of π, nearer than 2^-bits to each other, by Machin's formula."""
    fifth, other = _arctangent(5, bits + 6), _arctangent(239, bits + 6)
    return 16 * fifth[0] - 4 * other[1], 16 * fifth[1] - 4 * other[0]


def _arctangent(inverse: int, bits: int) -> tuple[Fraction, Fraction]:
    """Return two partial sums of the series of arctan(1/inverse), which enclose it."""
    total, before, power, index = Fraction(1, inverse), Fraction(0), Fraction(1, inverse), 1
    while abs(total - before) > Fraction(1, 2**bits):
        index += 2
        power /= -(inverse**2)
        before, total = total, total + power / index
    return min(before, total), max(before, total)
