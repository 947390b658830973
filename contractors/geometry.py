"""Contractors for relations of plane geometry."""

import numpy as np

from ial.contractors.angle import direction, intersect_angle
from ial.contractors.arithmetic import add, div, intersect, mul, sub
from ial.contractors.boxes import Boxes
from ial.contractors.contractor import require_dimension
from ial.contractors.elementary import cos, hypot, sin
from ial.contractors.kernels import kernel
from ial.contractors.threads import run


@kernel
def _divide_out(rl, ru, dl, du, cl, cu):  # type: ignore[no-untyped-def]
    """Return the part of r that can satisfy d = r·c."""
    if dl <= 0.0 <= du and cl <= 0.0 <= cu:
        return rl, ru  # 0 = r·0 holds for every r
    return intersect(rl, ru, *div(dl, du, cl, cu))


@kernel
def _contract_offset(dl, du, wl, wu, xl, xu):  # type: ignore[no-untyped-def]
    """Return d, w and x narrowed by w = x + d."""
    dl, du = intersect(dl, du, *sub(wl, wu, xl, xu))
    wl, wu = intersect(wl, wu, *add(xl, xu, dl, du))
    xl, xu = intersect(xl, xu, *sub(wl, wu, dl, du))
    return dl, du, wl, wu, xl, xu


@kernel
def _contract_polar(start, stop, lower, upper):  # type: ignore[no-untyped-def]
    """Narrow rows of (x, y, theta, r, bearing, wx, wy) in place."""
    for i in range(start, stop):
        low, high = lower[i], upper[i]
        xl, yl, tl, rl, bl, vl, wl = low[0], low[1], low[2], low[3], low[4], low[5], low[6]
        xu, yu, tu, ru, bu, vu, wu = high[0], high[1], high[2], high[3], high[4], high[5], high[6]
        # Forward: the direction of the ray, and the offset from x to w.
        rl, ru = intersect(rl, ru, 0.0, np.inf)
        al, au = add(tl, tu, bl, bu)
        cl, cu = cos(al, au)
        sl, su = sin(al, au)
        dl, du = mul(rl, ru, cl, cu)
        el, eu = mul(rl, ru, sl, su)
        dl, du, vl, vu, xl, xu = _contract_offset(dl, du, vl, vu, xl, xu)
        el, eu, wl, wu, yl, yu = _contract_offset(el, eu, wl, wu, yl, yu)
        # Backward: the offset's length and direction. A length of 0 would have any direction.
        rl, ru = intersect(rl, ru, *hypot(dl, du, el, eu))
        rl, ru = _divide_out(rl, ru, dl, du, cl, cu)
        rl, ru = _divide_out(rl, ru, el, eu, sl, su)
        if rl > 0.0 or dl > 0.0 or du < 0.0 or el > 0.0 or eu < 0.0:
            al, au = intersect_angle(al, au, *direction(el, eu, dl, du))
        tl, tu = intersect(tl, tu, *sub(al, au, bl, bu))
        bl, bu = intersect(bl, bu, *sub(al, au, tl, tu))
        if xl > xu or yl > yu or tl > tu or rl > ru or bl > bu or vl > vu or wl > wu:
            low[:] = np.inf
            high[:] = -np.inf
        else:
            low[:] = (xl, yl, tl, rl, bl, vl, wl)
            high[:] = (xu, yu, tu, ru, bu, vu, wu)


class Polar:
    """Narrows all seven variables of a range measurement: w = (x, y) + r·(cos(θ + γ), sin(θ + γ)) with r >= 0.

    The variables are, in this order: the sensor's position x, y and heading θ, the measured range r and bearing γ, and the point
    w = (wx, wy) that was hit. Lengths are in metres, angles in radians, counter-clockwise from the x axis; θ and γ are real numbers, not
    reduced to a turn.

    References
    ----------
    Guyonneau, Lagrange, Hardouin, Lucidarme: Guaranteed interval analysis localization for mobile robots, Advanced Robotics 28 (2014),
    equation 6, in the axes of REP-103 (the paper measures θ from the y axis).
    """

    variables = ("x", "y", "theta", "r", "bearing", "wx", "wy")
    dimension = len(variables)

    def contract(self, boxes: Boxes) -> Boxes:
        """Return the narrowed boxes.

        Parameters
        ----------
        boxes
            n boxes over `variables`.

        Raises
        ------
        ValueError
            If the boxes do not have seven dimensions.
        RoundingModeError
            If the processor does not round to nearest.
        """
        require_dimension(self, boxes)
        lower, upper = boxes.lower.copy(), boxes.upper.copy()
        run(_contract_polar, len(boxes), lower, upper)
        return Boxes(lower, upper)
