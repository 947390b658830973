"""Intervals of angles on the circle.

An interval of angles is (lower, upper) with lower in [-π, π] and upper >= lower; upper exceeds π when the interval crosses the cut at ±π.
The full circle is exactly (`-PI_UPPER`, `PI_UPPER`): in doubles, [-π, π] does not cover it.
"""

import numpy as np

from ial.contractors.intervals.arithmetic import add, mul
from ial.contractors.intervals.sets import intersect, unless
from ial.contractors.intervals.trigonometric import LARGEST_ANGLE, PI_LOWER, PI_UPPER, TWO_PI_LOWER, TWO_PI_UPPER, atan2
from ial.contractors.kernels import kernel


@kernel
def shift_angle(lower, upper, turns):  # type: ignore[no-untyped-def]
    """Return an interval plus a whole number of turns; 2π is itself an interval, so the result is a little wider."""
    if turns == 0.0:
        return lower, upper
    low, high = mul(turns, turns, TWO_PI_LOWER, TWO_PI_UPPER)
    return add(lower, upper, low, high)


@kernel
def _covers_circle(lower, upper):  # type: ignore[no-untyped-def]
    """Return whether an interval may be as wide as a turn; a NaN width counts as wide."""
    return not upper - lower < TWO_PI_LOWER


@kernel
def wrap_angle(lower, upper):  # type: ignore[no-untyped-def]
    """Return the same angles in the form this module describes; an interval already in it is returned unchanged.

    An interval as wide as a turn gives the full circle, the empty interval stays empty. A shift rounds outward.
    """
    if lower > upper:
        return np.inf, -np.inf
    # One rounding in the number of turns, or in the shift, may miss the range by a hair; the second pass then moves by one more turn.
    for _ in range(3):
        if _covers_circle(lower, upper):
            break
        if abs(lower) <= PI_UPPER:
            return lower, upper
        lower, upper = shift_angle(lower, upper, -np.floor(lower / TWO_PI_LOWER + 0.5))
    return -PI_UPPER, PI_UPPER


@kernel
def contains_angle(lower, upper, angle):  # type: ignore[no-untyped-def]
    """Return whether `angle` plus some multiple of 2π lies in an interval; where rounding leaves that open, it does."""
    if lower > upper:
        return False
    if _covers_circle(lower, upper):
        return True
    turns = np.ceil((lower - angle) / TWO_PI_LOWER)
    for nearby in (turns - 1.0, turns, turns + 1.0):
        low, high = shift_angle(angle, angle, nearby)
        if low <= upper and lower <= high:
            return True
    return False


@kernel
def _congruent(lower, upper, low, high, turns):  # type: ignore[no-untyped-def]
    """Return the part of an interval that lies in [low, high] plus a number of turns."""
    return intersect(lower, upper, *shift_angle(low, high, turns))


@kernel
def intersect_angle(lower, upper, low, high):  # type: ignore[no-untyped-def]
    """Return the hull of the numbers in [lower, upper] that equal some number of [low, high] plus a multiple of 2π.

    [lower, upper] is an interval of real numbers, of any width, and stays one; beyond `LARGEST_ANGLE` it is returned unchanged.
    """
    if lower > upper or low > high:
        return np.inf, -np.inf
    if not (lower >= -LARGEST_ANGLE and upper <= LARGEST_ANGLE) or _covers_circle(low, high):
        return lower, upper
    # The numbers of turns of the lowest and the highest copy that can matter, one further out than computed.
    first = np.ceil((lower - high) / TWO_PI_LOWER) - 1.0
    last = np.floor((upper - low) / TWO_PI_LOWER) + 1.0
    left, right = np.inf, -np.inf
    for turns in (first, first + 1.0, first + 2.0):
        left = min(left, _congruent(lower, upper, low, high, turns)[0])
    for turns in (last, last - 1.0, last - 2.0):
        right = max(right, _congruent(lower, upper, low, high, turns)[1])
    return unless(left > right, left, right)


@kernel
def direction(yl, yu, xl, xu):  # type: ignore[no-untyped-def]
    """Return the angles of the points of a box, in the form this module describes.

    Unlike `atan2` it follows a box across the negative x axis: the angle of the opposite box plus π.
    """
    if yl < 0.0 <= yu and xl < 0.0:
        low, high = atan2(-yu, -yl, -xu, -xl)
        return add(low, high, PI_LOWER, PI_UPPER)
    return atan2(yl, yu, xl, xu)
