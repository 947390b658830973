"""Reverse operations of sine, cosine and tangent, and of their inverses, as compiled kernels (see `ial.contractors.intervals.reverse`).

The solutions of sin x in c repeat without end. Only the lowest and the highest within the prior count, so the few branches next to the
bounds of the prior are looked at and no others, however wide the prior is. A bound beyond `LARGEST_ANGLE` stays. Bounds are within a few
bits of tight.
"""

import math

import numpy as np

from ial.contractors.intervals.arithmetic import add, mul
from ial.contractors.intervals.sets import intersect, unless
from ial.contractors.intervals.trigonometric import (
    HALF_PI_LOWER,
    HALF_PI_UPPER,
    LARGEST_ANGLE,
    PI_LOWER,
    PI_UPPER,
    acos,
    asin,
    atan,
    cos,
    sin,
    tan,
)
from ial.contractors.kernels import kernel
from ial.contractors.margins import ROUNDINGS

_HALVES_PER_RADIAN = 1.0 / math.pi
_CANDIDATES = 3  # the branch of a bound, the next one, and one more because of the margin


@kernel
def _branch(number, alternate, offset, low, high):  # type: ignore[no-untyped-def]
    """Return the solutions of one monotone branch: [low, high] plus a multiple of π; turned over where odd branches are."""
    odd = alternate & (number != 2.0 * np.floor(0.5 * number))
    low, high = (-high, -low) if odd else (low, high)
    halves = number + offset if odd else number
    return add(low, high, *mul(halves, halves, PI_LOWER, PI_UPPER))


@kernel
def _margin(x):  # type: ignore[no-untyped-def]
    """Return what the number of a branch may be wrong by: 1/π, a product and two sums of terms below abs(x)/π + 1."""
    return ROUNDINGS * (abs(x) + 1.0)


@kernel
def _nearest(alternate, offset, phase, low, high, xl, xu):  # type: ignore[no-untyped-def]
    """Return the hull of the solutions within x of all branches, the k-th of which covers [k − phase, k − phase + 1]·π."""
    left, right = xl, xu
    if abs(xl) <= LARGEST_ANGLE:
        left = np.inf
        first = np.floor(xl * _HALVES_PER_RADIAN + phase - _margin(xl))
        for i in range(_CANDIDATES):
            lower, upper = _branch(first + i, alternate, offset, low, high)
            if lower <= xu and upper >= xl:
                left = max(lower, xl)
                break
    if abs(xu) <= LARGEST_ANGLE:
        right = -np.inf
        last = np.floor(xu * _HALVES_PER_RADIAN + phase + _margin(xu))
        for i in range(_CANDIDATES):
            lower, upper = _branch(last - i, alternate, offset, low, high)
            if lower <= xu and upper >= xl:
                right = min(upper, xu)
                break
    return unless((left > right) | (low > high) | (xl > xu), left, right)


@kernel
def sin_reverse(cl, cu, xl, xu):  # type: ignore[no-untyped-def]
    """Return the hull of {x : sin x in c} within x (IEEE 1788-2015, sinRev)."""
    if cl <= -1.0 and cu >= 1.0:
        return xl, xu
    return _nearest(True, 0.0, 0.5, *asin(cl, cu), xl, xu)


@kernel
def cos_reverse(cl, cu, xl, xu):  # type: ignore[no-untyped-def]
    """Return the hull of {x : cos x in c} within x (IEEE 1788-2015, cosRev)."""
    if cl <= -1.0 and cu >= 1.0:
        return xl, xu
    return _nearest(True, 1.0, 0.0, *acos(cl, cu), xl, xu)


@kernel
def tan_reverse(cl, cu, xl, xu):  # type: ignore[no-untyped-def]
    """Return the hull of {x : tan x in c} within x (IEEE 1788-2015, tanRev)."""
    if cl == -np.inf and cu == np.inf:
        return xl, xu
    return _nearest(False, 0.0, 0.5, *atan(cl, cu), xl, xu)


@kernel
def asin_reverse(cl, cu, xl, xu):  # type: ignore[no-untyped-def]
    """Return {x : asin x in c} within x."""
    return intersect(*sin(*intersect(cl, cu, -HALF_PI_UPPER, HALF_PI_UPPER)), xl, xu)


@kernel
def acos_reverse(cl, cu, xl, xu):  # type: ignore[no-untyped-def]
    """Return {x : acos x in c} within x."""
    return intersect(*cos(*intersect(cl, cu, 0.0, PI_UPPER)), xl, xu)


@kernel
def atan_reverse(cl, cu, xl, xu):  # type: ignore[no-untyped-def]
    """Return {x : atan x in c} within x."""
    # The doubles next to ±π/2 on its inner side still have a finite tangent; all beyond stand for the limit.
    lower = -np.inf if cl < -HALF_PI_LOWER else tan(cl, cl)[0]
    upper = np.inf if cu > HALF_PI_LOWER else tan(cu, cu)[1]
    empty = (cl > cu) | (cl > HALF_PI_LOWER) | (cu < -HALF_PI_LOWER)
    return intersect(*unless(empty, lower, upper), xl, xu)
