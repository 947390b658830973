"""Backward and reverse operations of length and angle as compiled kernels on pairs of bounds.

See `ial.contractors.intervals.backward` and `ial.contractors.intervals.reverse`. Bounds are within a few bits of tight.
"""

import numpy as np

from ial.contractors.intervals.arithmetic import absolute, add, mul, sqrt, sub
from ial.contractors.intervals.backward import both
from ial.contractors.intervals.reverse import abs_reverse, mul_reverse
from ial.contractors.intervals.sets import hull, intersect
from ial.contractors.intervals.trigonometric import HALF_PI_LOWER, HALF_PI_UPPER, PI_UPPER, cos, sin
from ial.contractors.kernels import kernel


@kernel
def _leg(r, b):  # type: ignore[no-untyped-def]
    """Return √(r² − b²) of two numbers as an interval, empty for r < b; as a product, it neither overflows nor cancels."""
    return mul(*sqrt(*sub(r, r, b, b)), *sqrt(*add(r, r, b, b)))


@kernel
def _other_leg(rl, ru, bl, bu, al, au):  # type: ignore[no-untyped-def]
    """Return the hull of {a : hypot(a, b) in r for some b} within a, for r >= 0."""
    near, far = absolute(bl, bu)
    lower = _leg(rl, far)[0] if rl > far else 0.0
    return abs_reverse(lower, _leg(ru, near)[1], al, au)


@kernel
def hypot_backward(rl, ru, al, au, bl, bu):  # type: ignore[no-untyped-def]
    """Narrow a and b by r = √(a² + b²)."""
    rl, ru = intersect(rl, ru, 0.0, np.inf)
    if rl > ru or al > au or bl > bu:
        return np.inf, -np.inf, np.inf, -np.inf
    a = _other_leg(rl, ru, bl, bu, al, au)
    b = _other_leg(rl, ru, al, au, bl, bu)
    return both(*a, *b)


@kernel
def _mirrored(sign, lower, upper):  # type: ignore[no-untyped-def]
    """Return an interval, or its negative."""
    return (lower, upper) if sign > 0.0 else (-upper, -lower)


@kernel
def atan2_backward(rl, ru, yl, yu, xl, xu):  # type: ignore[no-untyped-def]
    """Narrow y and x by r = the angle of the point (x, y), in (-π, π]; (0, 0) has none."""
    # In each quadrant, mirrored to the first, y·cos r = x·sin r with all four >= 0. Sine and cosine are monotone there, so that each bound
    # of y/x takes both from the same end of r: nothing is lost by treating them as independent.
    al, au, bl, bu = np.inf, -np.inf, np.inf, -np.inf
    for up in (1.0, -1.0):
        tl, tu = _mirrored(up, rl, ru)
        ql, qu = intersect(*_mirrored(up, yl, yu), 0.0, np.inf)
        for ahead in (1.0, -1.0):
            angle = intersect(tl, tu, 0.0 if ahead > 0.0 else HALF_PI_LOWER, HALF_PI_UPPER if ahead > 0.0 else PI_UPPER)
            pl, pu = intersect(*_mirrored(ahead, xl, xu), 0.0, np.inf)
            if angle[0] > angle[1] or ql > qu or pl > pu:
                continue
            sl, su = intersect(*sin(*angle), 0.0, 1.0)
            cl, cu = intersect(*_mirrored(ahead, *cos(*angle)), 0.0, 1.0)
            low, high = mul_reverse(cl, cu, *mul(pl, pu, sl, su), ql, qu)
            start, stop = mul_reverse(sl, su, *mul(ql, qu, cl, cu), pl, pu)
            # (0, 0) has no angle, and -π, unlike π, is the angle of no point.
            if low > high or start > stop or (high == 0.0 and (stop == 0.0 or (up < 0.0 and ahead < 0.0))):
                continue
            al, au = hull(al, au, *_mirrored(up, low, high))
            bl, bu = hull(bl, bu, *_mirrored(ahead, start, stop))
    return al, au, bl, bu


@kernel
def atan2_reverse_y(xl, xu, cl, cu, yl, yu):  # type: ignore[no-untyped-def]
    """Return the hull of {y : atan2(y, x) in c for some x} within y (IEEE 1788-2015, atan2Rev1)."""
    lower, upper, _, _ = atan2_backward(cl, cu, yl, yu, xl, xu)
    return lower, upper


@kernel
def atan2_reverse_x(yl, yu, cl, cu, xl, xu):  # type: ignore[no-untyped-def]
    """Return the hull of {x : atan2(y, x) in c for some y} within x (IEEE 1788-2015, atan2Rev2)."""
    _, _, lower, upper = atan2_backward(cl, cu, yl, yu, xl, xu)
    return lower, upper
