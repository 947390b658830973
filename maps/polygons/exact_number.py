"""Numbers as people write them, read exactly: ``3``, ``-0.25``, ``1e-3``, ``1/3``."""

import re
from fractions import Fraction

from ial.errors import MapError

_NUMBER = re.compile(r"[+-]?(\d+/\d+|(\d+\.?\d*|\.\d+)([eE][+-]?\d{1,3})?)", re.ASCII)
_MOST_CHARACTERS = 400
LARGEST = 10**15
"""Metres, degrees or seconds beyond this are a mistake, and doubles would no longer tell millimetres apart."""


def exact_number(value: object, where: str) -> Fraction:
    """Return the number that a text or an integer denotes, without any rounding.

    Parameters
    ----------
    value
        A whole number, a `Fraction`, or a text: decimal or ``"p/q"``. A `float` is refused, since it has been rounded already.
    where
        What the number belongs to, for the message.

    Raises
    ------
    MapError
        If it is no such number, is greater than 10¹⁵ in size, has more than 400 characters or a three-digit exponent is not enough for it.
    """
    number = _read(value, where)
    if abs(number) > LARGEST:
        raise MapError(f"{where}: {str(value)[:40]!r} is too large; write a number of at most 1e15, in metres, degrees or seconds")
    return number


def _read(value: object, where: str) -> Fraction:
    if isinstance(value, Fraction):
        return value
    if isinstance(value, int) and not isinstance(value, bool):
        return Fraction(value)
    text = value.strip() if isinstance(value, str) else ""
    if len(text) > _MOST_CHARACTERS or not _NUMBER.fullmatch(text):
        raise MapError(f'{where}: {str(value)[:40]!r} is no number; write 3, -0.25, 1e-3 or a fraction such as "1/3"')
    try:
        return Fraction(text)
    except ZeroDivisionError:
        raise MapError(f"{where}: {text!r} divides by zero; write a fraction with another denominator") from None


def text_of(number: Fraction) -> str:
    """Return the shortest text ``"p/q"``, or ``"p"`` for a whole number; `exact_number` gives the same number back."""
    return str(number)
