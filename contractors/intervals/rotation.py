"""Rotations in the plane as compiled kernels on pairs of bounds."""

import math

from ial.contractors.intervals.arithmetic import add, mul, sub
from ial.contractors.kernels import kernel
from ial.contractors.margins import ROUNDINGS


@kernel
def rotate(cl, cu, sl, su, xl, xu, yl, yu):  # type: ignore[no-untyped-def]
    """Return (c·x − s·y, s·x + c·y) as four bounds, for the cosine c and the sine s of an angle.

    If the angle is one number this is the smallest upright box, but for rounding.
    """
    ul, uu = sub(*mul(cl, cu, xl, xu), *mul(sl, su, yl, yu))
    vl, vu = add(*mul(sl, su, xl, xu), *mul(cl, cu, yl, yu))
    return ul, uu, vl, vu


@kernel
def turn_point(x, y, s0, c0, s1, c1):  # type: ignore[no-untyped-def]
    """Return the smallest upright box, but for rounding, around a point turned by all angles of an interval narrower than π.

    Unlike `rotate`, which would take sine and cosine for independent, it follows the arc: u = x cos θ − y sin θ and v = x sin θ + y cos θ
    satisfy u' = −v and v' = u. So u has an inner maximum exactly where v passes zero upwards (u is then positive in the middle of the
    interval, and so is the sum of its ends), and so on; elsewhere the bounds are reached at the ends.

    Parameters
    ----------
    x, y
        The point; coordinates are 0 or of a size of at least 1e-140, so that no square underflows.
    s0, c0, s1, c1
        Sine and cosine of the lower and of the upper angle, each wrong by less than 2^-53 (`trigonometric.sincos`).

    Returns
    -------
    tuple
        ul, uu, vl, vu. They are widened by `ROUNDINGS` of abs(x) + abs(y), for two errors of sine or cosine, and up to seven roundings
        of terms below that.
    """
    slack = (abs(x) + abs(y)) * ROUNDINGS
    u0 = x * c0 - y * s0
    v0 = x * s0 + y * c0
    u1 = x * c1 - y * s1
    v1 = x * s1 + y * c1
    ul = min(u0, u1) - slack
    uu = max(u0, u1) + slack
    vl = min(v0, v1) - slack
    vu = max(v0, v1) + slack
    if min(abs(u0), abs(u1)) <= slack or min(abs(v0), abs(v1)) <= slack or u0 * u1 < 0.0 or v0 * v1 < 0.0:
        radius = math.sqrt(x * x + y * y) + slack
        if v0 <= slack and v1 >= -slack and u0 + u1 >= -slack:
            uu = radius
        if v0 >= -slack and v1 <= slack and u0 + u1 <= slack:
            ul = -radius
        if u0 >= -slack and u1 <= slack and v0 + v1 >= -slack:
            vu = radius
        if u0 <= slack and u1 >= -slack and v0 + v1 <= slack:
            vl = -radius
    return ul, uu, vl, vu
