"""`RangeBearing`: what a range and a bearing, measured from a pose, say about the pose and the point that was seen."""

import numpy as np

from ial.contractors.boxes import FloatArray
from ial.contractors.geometry.polar import contract_polar
from ial.contractors.intervals.arithmetic import add, sub
from ial.contractors.intervals.backward import add_backward, sub_backward
from ial.contractors.kernels import kernel
from ial.contractors.row_contractor import RowContractor
from ial.contractors.threads import run


@kernel
def _contract_rows(start, stop, lower, upper):  # type: ignore[no-untyped-def]
    """Narrow rows of (x, y, theta, r, bearing, wx, wy) in place."""
    for i in range(start, stop):
        low, high = lower[i], upper[i]
        xl, yl, tl, rl, bl, vl, wl = low[0], low[1], low[2], low[3], low[4], low[5], low[6]
        xu, yu, tu, ru, bu, vu, wu = high[0], high[1], high[2], high[3], high[4], high[5], high[6]
        al, au = add(tl, tu, bl, bu)
        dl, du, el, eu, rl, ru, al, au = contract_polar(*sub(vl, vu, xl, xu), *sub(wl, wu, yl, yu), rl, ru, al, au)
        vl, vu, xl, xu = sub_backward(dl, du, vl, vu, xl, xu)
        wl, wu, yl, yu = sub_backward(el, eu, wl, wu, yl, yu)
        tl, tu, bl, bu = add_backward(al, au, tl, tu, bl, bu)
        if xl > xu or yl > yu or tl > tu or rl > ru or bl > bu or vl > vu or wl > wu:
            low[:] = np.inf
            high[:] = -np.inf
        else:
            low[0], low[1], low[2], low[3], low[4], low[5], low[6] = xl, yl, tl, rl, bl, vl, wl
            high[0], high[1], high[2], high[3], high[4], high[5], high[6] = xu, yu, tu, ru, bu, vu, wu


class RangeBearing(RowContractor):
    """The contractor of a range measurement: w = (x, y) + r·(cos(θ + γ), sin(θ + γ)) with r >= 0.

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

    def _narrow_rows(self, lower: FloatArray, upper: FloatArray) -> None:
        run(_contract_rows, len(lower), lower, upper)
