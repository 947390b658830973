"""Interval literals: what people write for an interval, read exactly (IEEE 1788-2015, clauses 9.7 and 12.11)."""

import math
import re
from fractions import Fraction

from ial.contractors.intervals.double import above, below

_MOST_CHARACTERS = 4096
_LARGEST_EXPONENT = 9999  # far beyond doubles; an exact number with a much larger one would take for ever

_EXPONENT = r"(?:e(?P<exponent>[+-]?\d+))?"
_DECIMAL = r"(?P<sign>[+-]?)(?=\.?\d)(?P<whole>\d*)\.?(?P<fraction>\d*)"
_NUMBERS = {
    kind: re.compile(pattern, re.ASCII)
    for kind, pattern in {
        "infinity": r"(?P<sign>[+-]?)inf(?:inity)?",
        "rational": r"(?P<numerator>[+-]?\d+)/(?P<denominator>\d+)",
        "hexadecimal": r"(?P<sign>[+-]?)0x(?=\.?[0-9a-f])(?P<whole>[0-9a-f]*)\.?(?P<fraction>[0-9a-f]*)(?:p(?P<exponent>[+-]?\d+))?",
        "decimal": _DECIMAL + _EXPONENT,
    }.items()
}
_UNCERTAIN = re.compile(_DECIMAL + r"\?(?P<radius>\?|\d*)(?P<direction>[ud]?)" + _EXPONENT, re.ASCII)

_Number = Fraction | float  # a float is an infinity


def bounds_of_literal(text: str) -> tuple[float, float]:
    """Return the smallest bounds around the interval that a text denotes; (inf, -inf) for the empty one.

    Parameters
    ----------
    text
        ``[1.0, 2.0]``, ``[1]``, ``[empty]``, ``[]``, ``[entire]``, ``[,]``, ``[-inf, 3]``, ``[,3]``, with numbers such as ``1.5e-3``,
        ``1/3``, ``0x1.8p-1``; or the uncertain form ``1.50?2e3``: the number ± 2 units of its last digit. Without a radius it is half a
        unit, ``??`` is unbounded; ``u`` or ``d`` before the exponent keeps the part above or below. Upper and lower case are the same.

    Raises
    ------
    ValueError
        If the text is no such literal, its bounds are in the wrong order (compared exactly), it is longer than 4096 characters or has an
        exponent beyond ±9999. Decorations are not offered.
    """
    if len(text) > _MOST_CHARACTERS:
        raise ValueError(f"the literal {text[:20]!r}… has {len(text)} characters; at most {_MOST_CHARACTERS} are read")
    word = text.strip().lower()
    inside = word[1:-1].strip()
    if not (word.startswith("[") and word.endswith("]")):
        lower, upper = _uncertain(word, text)
    elif inside in ("", "empty"):
        return math.inf, -math.inf
    elif inside == "entire":
        return -math.inf, math.inf
    elif "," in inside:
        first, _, second = inside.partition(",")
        lower = _number(first.strip() or "-inf", text)
        upper = _number(second.strip() or "inf", text)
    else:
        lower = upper = _number(inside, text)
    if lower > upper or lower == math.inf or upper == -math.inf:
        raise _refused(text, "no real number lies between its bounds; give the lower one first, and [empty] for the empty interval")
    return below(lower), above(upper)


def _refused(text: str, reason: str) -> ValueError:
    return ValueError(f"{text!r} is no interval: {reason}")


def _number(word: str, text: str) -> _Number:
    for kind, pattern in _NUMBERS.items():
        match = pattern.fullmatch(word)
        if not match:
            continue
        if kind == "infinity":
            return -math.inf if match["sign"] == "-" else math.inf
        if kind == "rational":
            if int(match["denominator"]) == 0:
                raise _refused(text, "it divides by zero")
            return Fraction(int(match["numerator"]), int(match["denominator"]))
        value, unit = _value_and_unit(match, text, *((16, 2, 4) if kind == "hexadecimal" else (10, 10, 1)))
        return value * unit
    raise _refused(text, f"{word!r} is no number such as 1.5, 1/3, 0x1.8p-1 or -inf")


def _value_and_unit(match: re.Match[str], text: str, base: int, step: int, steps_per_digit: int) -> tuple[int, Fraction]:
    """Return the digits as a whole number, and what its last digit counts: a power of `step`."""
    exponent = int(match["exponent"] or 0)
    if abs(exponent) > _LARGEST_EXPONENT:
        raise _refused(text, f"the exponent {exponent} is beyond ±{_LARGEST_EXPONENT}; write inf, or 0")
    digits = int(match["whole"] + match["fraction"], base)
    unit = Fraction(step) ** (exponent - steps_per_digit * len(match["fraction"]))
    return -digits if match["sign"] == "-" else digits, unit


def _uncertain(word: str, text: str) -> tuple[_Number, _Number]:
    match = _UNCERTAIN.fullmatch(word)
    if not match:
        raise _refused(text, "write [1.0, 2.0], [1/3], [empty], [entire] or 1.5?, without a decoration")
    value, unit = _value_and_unit(match, text, 10, 10, 1)
    middle = value * unit
    if match["radius"] == "?":
        bounds: tuple[_Number, _Number] = -math.inf, math.inf
    else:
        radius = int(match["radius"]) * unit if match["radius"] else unit / 2
        bounds = middle - radius, middle + radius
    return middle if match["direction"] == "u" else bounds[0], middle if match["direction"] == "d" else bounds[1]
