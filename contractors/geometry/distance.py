"""The distance between two points of the plane, as a kernel and as the contractor `Distance`."""

import numpy as np

from ial.contractors.boxes import FloatArray
from ial.contractors.intervals.arithmetic import sub
from ial.contractors.intervals.backward import sub_backward
from ial.contractors.intervals.reverse_polar import hypot_backward
from ial.contractors.intervals.sets import intersect
from ial.contractors.intervals.trigonometric import hypot
from ial.contractors.kernels import kernel
from ial.contractors.row_contractor import RowContractor
from ial.contractors.threads import run


@kernel
def contract_distance(pl, pu, ql, qu, vl, vu, wl, wu, dl, du):  # type: ignore[no-untyped-def]
    """Return p, q, v, w and d narrowed by d = √((v − p)² + (w − q)²), as ten bounds in this order; any may be empty."""
    xl, xu = sub(vl, vu, pl, pu)
    yl, yu = sub(wl, wu, ql, qu)
    dl, du = intersect(dl, du, *hypot(xl, xu, yl, yu))
    xl, xu, yl, yu = hypot_backward(dl, du, xl, xu, yl, yu)
    vl, vu, pl, pu = sub_backward(xl, xu, vl, vu, pl, pu)
    wl, wu, ql, qu = sub_backward(yl, yu, wl, wu, ql, qu)
    return pl, pu, ql, qu, vl, vu, wl, wu, dl, du


@kernel
def _contract_rows(start, stop, lower, upper):  # type: ignore[no-untyped-def]
    """Narrow rows of (ax, ay, bx, by, d) in place."""
    for i in range(start, stop):
        low, high = lower[i], upper[i]
        pl, pu, ql, qu, vl, vu, wl, wu, dl, du = contract_distance(
            low[0], high[0], low[1], high[1], low[2], high[2], low[3], high[3], low[4], high[4]
        )
        if pl > pu or ql > qu or vl > vu or wl > wu or dl > du:
            low[:] = np.inf
            high[:] = -np.inf
        else:
            low[0], low[1], low[2], low[3], low[4] = pl, ql, vl, wl, dl
            high[0], high[1], high[2], high[3], high[4] = pu, qu, vu, wu, du


class Distance(RowContractor):
    """The contractor of the distance of two points a and b: d = √((bx − ax)² + (by − ay)²).

    The variables are, in this order: ax, ay, bx, by and d, in one unit of length. A box shrinks to the hull of its solutions, up to the
    rounding of a few operations.

    References
    ----------
    Jaulin, Kieffer, Didrit, Walter: Applied Interval Analysis (2001), section 4.2, for the projection of such a constraint on its
    variables. One pass is enough here: the differences bx − ax and by − ay are narrowed exactly, and each shares one variable only with d.
    """

    variables = ("ax", "ay", "bx", "by", "d")
    dimension = len(variables)

    def _narrow_rows(self, lower: FloatArray, upper: FloatArray) -> None:
        run(_contract_rows, len(lower), lower, upper)
