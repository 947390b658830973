"""Polar coordinates, as a kernel and as the contractor `Polar`."""

import math

import numpy as np

from ial.contractors.boxes import FloatArray
from ial.contractors.intervals.arithmetic import add, mul, sub
from ial.contractors.intervals.reverse import mul_reverse
from ial.contractors.intervals.reverse_polar import hypot_backward
from ial.contractors.intervals.sets import hull, intersect
from ial.contractors.intervals.trigonometric import HALF_PI_LOWER, HALF_PI_UPPER, LARGEST_ANGLE, atan2, cos, hypot, sin
from ial.contractors.kernels import kernel
from ial.contractors.row_contractor import RowContractor
from ial.contractors.threads import run

_QUADRANTS_PER_RADIAN = 2.0 / math.pi
_MORE_THAN_A_TURN = 7.0


@kernel
def _quadrants(number):  # type: ignore[no-untyped-def]
    """Return a number of quadrants in radians."""
    return mul(number, number, HALF_PI_LOWER, HALF_PI_UPPER)


@kernel
def _quadrant_below(angle):  # type: ignore[no-untyped-def]
    """Return the largest n for which n·π/2 is proved not to exceed an angle; at 0, where that is exact, 0."""
    number = np.floor(angle * _QUADRANTS_PER_RADIAN)
    if _quadrants(number + 1.0)[1] <= angle:
        return number + 1.0
    return number if _quadrants(number)[1] <= angle else number - 1.0


@kernel
def _turned(number, xl, xu, yl, yu):  # type: ignore[no-untyped-def]
    """Return a box turned back by a number of quadrants, which is exact."""
    quadrant = number - 4.0 * np.floor(0.25 * number)
    odd = (quadrant == 1.0) | (quadrant == 3.0)
    al, au = (yl, yu) if odd else (xl, xu)
    bl, bu = (-xu, -xl) if odd else (yl, yu)
    half = quadrant >= 2.0
    al, au = (-au, -al) if half else (al, au)
    bl, bu = (-bu, -bl) if half else (bl, bu)
    return al, au, bl, bu


@kernel
def _contract_quadrant(number, xl, xu, yl, yu, rl, ru, tl, tu):  # type: ignore[no-untyped-def]
    """Return x, y, r, θ narrowed to the solutions with θ between `number` and `number` + 1 times π/2, as eight bounds; any may be empty.

    Turned into the first quadrant, each of x = r·cos θ, y = r·sin θ, r² = x² + y² and x·tan θ = y is monotone in each variable. A bound of
    x (or y) is attained where two of the bounds of the three other variables meet, so the three ways to find it from two of them give it
    exactly. Bounds of r and θ are then those of the corners of the narrowed x and y.
    """
    al, au, bl, bu = _turned(number, xl, xu, yl, yu)
    al, au = intersect(al, au, 0.0, np.inf)
    bl, bu = intersect(bl, bu, 0.0, np.inf)
    if al > au or bl > bu:
        return np.inf, -np.inf, np.inf, -np.inf, np.inf, -np.inf, np.inf, -np.inf
    begin, end = _quadrants(number), _quadrants(number + 1.0)
    tl, tu = intersect(tl, tu, begin[0], end[1])
    cl, cu, sl, su = _turned(number, *cos(tl, tu), *sin(tl, tu))
    cl, cu = intersect(cl, cu, 0.0, 1.0)
    sl, su = intersect(sl, su, 0.0, 1.0)
    pl, pu, ql, qu = hypot_backward(rl, ru, al, au, bl, bu)
    pl, pu = intersect(pl, pu, *mul(rl, ru, cl, cu))
    ql, qu = intersect(ql, qu, *mul(rl, ru, sl, su))
    pl, pu = mul_reverse(sl, su, *mul(bl, bu, cl, cu), pl, pu)
    ql, qu = mul_reverse(cl, cu, *mul(al, au, sl, su), ql, qu)
    rl, ru = intersect(rl, ru, *hypot(pl, pu, ql, qu))
    if pl > 0.0 or ql > 0.0:  # else this is, but for rounding, the origin, which has every direction, or a corner at it
        # From the end of the quadrant that is nearer to 0, where doubles are denser.
        if number >= 0.0:
            tl, tu = intersect(tl, tu, *add(*begin, *atan2(ql, qu, pl, pu)))
        else:
            tl, tu = intersect(tl, tu, *sub(*end, *atan2(pl, pu, ql, qu)))
    xl, xu, yl, yu = _turned(-number, pl, pu, ql, qu)
    return xl, xu, yl, yu, rl, ru, tl, tu


@kernel
def contract_polar(xl, xu, yl, yu, rl, ru, tl, tu):  # type: ignore[no-untyped-def]
    """Return x, y, r, θ narrowed by x = r·cos θ, y = r·sin θ, r >= 0, as eight bounds in this order; all are empty if one is.

    The solutions are taken quadrant by quadrant. Where θ spans more than ten quadrants, the first five and the last five are enough: they
    hold every direction, and the first and the last copy of each.
    """
    left, right, bottom, top = np.inf, -np.inf, np.inf, -np.inf
    near, far, low, high = np.inf, -np.inf, np.inf, -np.inf
    rl, ru = intersect(rl, ru, 0.0, np.inf)
    if xl <= xu and yl <= yu and rl <= ru and tl <= tu:
        start, stop = max(tl, -LARGEST_ANGLE), min(tu, LARGEST_ANGLE)
        cut_below, cut_above = start > tl, stop < tu
        if (cut_below and cut_above) or ((cut_below or cut_above) and not stop - start >= _MORE_THAN_A_TURN):
            start, stop = -0.5 * _MORE_THAN_A_TURN, 0.5 * _MORE_THAN_A_TURN
            cut_below = cut_above = True
        first = _quadrant_below(start)
        last = max(first, -1.0 - _quadrant_below(-stop))
        count = int(last - first) + 1
        for i in range(min(count, 10)):
            number = first + i if i < 5 or count <= 10 else last - (i - 5)
            al, au, bl, bu, cl, cu, dl, du = _contract_quadrant(number, xl, xu, yl, yu, rl, ru, start, stop)
            if al <= au and bl <= bu and cl <= cu and dl <= du:
                left, right = hull(left, right, al, au)
                bottom, top = hull(bottom, top, bl, bu)
                near, far = hull(near, far, cl, cu)
                low, high = hull(low, high, dl, du)
        if low <= high:
            low = tl if cut_below else low
            high = tu if cut_above else high
    return left, right, bottom, top, near, far, low, high


@kernel
def _contract_rows(start, stop, lower, upper):  # type: ignore[no-untyped-def]
    """Narrow rows of (x, y, r, theta) in place."""
    for i in range(start, stop):
        low, high = lower[i], upper[i]
        xl, xu, yl, yu, rl, ru, tl, tu = contract_polar(low[0], high[0], low[1], high[1], low[2], high[2], low[3], high[3])
        low[0], low[1], low[2], low[3] = xl, yl, rl, tl
        high[0], high[1], high[2], high[3] = xu, yu, ru, tu


class Polar(RowContractor):
    """The contractor of polar coordinates: x = r·cos θ, y = r·sin θ, r >= 0.

    The variables are, in this order: x, y, r and θ, lengths in one unit, θ in radians, counter-clockwise from the x axis, a real number,
    not reduced to a turn. A box shrinks to the hull of its solutions, up to the rounding of a few operations: no narrower box would do. The
    one exception is a θ that leaves ±`LARGEST_ANGLE`: the bound beyond it stays.

    References
    ----------
    Desrochers, Jaulin: A minimal contractor for the polar equation: application to robot localization, Engineering Applications of
    Artificial Intelligence 55 (2016), defines the problem. The construction here, quadrant by quadrant, is another one.
    """

    variables = ("x", "y", "r", "theta")
    dimension = len(variables)

    def _narrow_rows(self, lower: FloatArray, upper: FloatArray) -> None:
        run(_contract_rows, len(lower), lower, upper)
