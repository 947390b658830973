"""Directions in whole numbers: cosine and sine of a rational turn, right to 100 bits, for a simulation that serves as truth."""

from fractions import Fraction

BITS = 112
ONE = 1 << BITS


def _arctangent(inverse: int) -> int:
    """Return arctan(1/inverse) in units of 2^-BITS, by its series."""
    power, total, index = ONE // inverse, 0, 1
    while power:
        total += power // index if index % 4 == 1 else -(power // index)
        power //= inverse * inverse
        index += 2
    return total


_PI = 4 * (4 * _arctangent(5) - _arctangent(239))


def direction(turn: Fraction) -> tuple[int, int]:
    """Return cosine and sine of a part of a full turn, in units of 2^-BITS; wrong by less than 2^-100.

    Multiples of a quarter turn are exact.
    """
    turn %= 1
    quarter, rest = divmod(4 * turn, 1)
    x = 2 * _PI * rest.numerator // (4 * rest.denominator)  # from 0 to π/2
    square = x * x >> BITS
    cosine, sine, term_c, term_s, index = ONE, x, ONE, x, 0
    while term_c or term_s:
        index += 2
        term_c = -(term_c * square >> BITS) // ((index - 1) * index)
        term_s = -(term_s * square >> BITS) // (index * (index + 1))
        cosine, sine = cosine + term_c, sine + term_s
        if abs(term_c) <= 1 and abs(term_s) <= 1:
            break
    for _ in range(int(quarter)):
        cosine, sine = -sine, cosine
    return cosine, sine
