"""`primitive`: a direction of a compass as two whole numbers without a common divisor, exactly."""

import math
from fractions import Fraction
from numbers import Rational as AnyRational
from typing import Any

from ial.errors import ConfigError

Direction = tuple[int, int]

MOST_BITS = 64
"""A direction is meant to be carried out by a robot: its two numbers have at most so many bits each."""


def primitive(x: Any, y: Any) -> Direction:
    """Return the shortest vector of whole numbers in a direction.

    Parameters
    ----------
    x, y
        A vector in that direction: whole numbers or fractions.

    Raises
    ------
    ConfigError
        If one is a float, which has been rounded already, or both are 0.
    """
    exact = _exact(x), _exact(y)
    if not any(exact):
        raise ConfigError("a direction is (0, 0), which leads nowhere; give a vector that is longer than 0")
    scale = math.lcm(exact[0].denominator, exact[1].denominator)
    whole = int(exact[0] * scale), int(exact[1] * scale)
    common = math.gcd(*whole)
    return whole[0] // common, whole[1] // common


def bits(direction: Direction) -> int:
    """Return how many bits the larger one of the two numbers has."""
    return max(abs(each).bit_length() for each in direction)


def reverse(direction: Direction) -> Direction:
    """Return the opposite direction."""
    return -direction[0], -direction[1]


def _exact(number: Any) -> Fraction:
    try:
        if isinstance(number, AnyRational):
            return Fraction(number)
        return Fraction(int(number.numerator), int(number.denominator))  # of gmpy2
    except (AttributeError, TypeError):
        raise ConfigError(
            f"a direction has the component {number!r}, which is no exact number; give whole numbers or fractions, since a robot that "
            "misses a direction by the rounding of a double ends elsewhere from most starts"
        ) from None
