"""Sign and rounding to whole numbers as compiled kernels on pairs of bounds, after IEEE 1788-2015, table 9.1.

Bounds are passed and returned as in `ial.contractors.intervals.arithmetic`. All of these functions grow with their argument and their
values are doubles, so every result is tight without any rounding.
"""

import numpy as np

from ial.contractors.intervals.sets import unless
from ial.contractors.kernels import kernel


@kernel
def _sign(x):  # type: ignore[no-untyped-def]
    return 1.0 if x > 0.0 else -1.0 if x < 0.0 else 0.0


@kernel
def _away(x):  # type: ignore[no-untyped-def]
    """Return the nearest whole number, of two equally near ones that farther from 0; the difference from it is exact."""
    whole = np.trunc(x)
    step = _sign(x) if abs(x - whole) >= 0.5 else 0.0
    return whole + step


@kernel
def sign(al, au):  # type: ignore[no-untyped-def]
    """Return the signs, −1, 0 and 1, of the points of a."""
    return unless(al > au, _sign(al), _sign(au))


@kernel
def floor(al, au):  # type: ignore[no-untyped-def]
    """Return the hull of the points of a rounded down to whole numbers."""
    return np.floor(al), np.floor(au)


@kernel
def ceil(al, au):  # type: ignore[no-untyped-def]
    """Return the hull of the points of a rounded up to whole numbers."""
    return np.ceil(al), np.ceil(au)


@kernel
def trunc(al, au):  # type: ignore[no-untyped-def]
    """Return the hull of the points of a rounded towards 0 to whole numbers."""
    return np.trunc(al), np.trunc(au)


@kernel
def round_ties_to_even(al, au):  # type: ignore[no-untyped-def]
    """Return the hull of the points of a rounded to the nearest whole number, of two equally near ones the even one."""
    return np.rint(al), np.rint(au)


@kernel
def round_ties_to_away(al, au):  # type: ignore[no-untyped-def]
    """Return the hull of the points of a rounded to the nearest whole number, of two equally near ones that farther from 0."""
    return _away(al), _away(au)
