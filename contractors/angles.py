"""`wrapped`: boxes of which some sides are angles, in the one form that `ial.contractors.intervals.angle` describes."""

import numpy as np

from ial.contractors.boxes import Boxes
from ial.contractors.intervals.angle import wrap_angle
from ial.contractors.kernels import kernel
from ial.contractors.rounding import check_rounding


@kernel
def _survey(lower, upper, axes):  # type: ignore[no-untyped-def]
    """Return the first row with a bound that is NaN, and the first that is not in the form; -1 where there is none."""
    rows, dimension = lower.shape
    other = -1
    for row in range(rows):
        empty = False
        for axis in range(dimension):
            low, high = lower[row, axis], upper[row, axis]
            if low != low or high != high:
                return row, row
            empty |= low > high
        for axis in axes:
            low, high = wrap_angle(lower[row, axis], upper[row, axis])
            if other < 0 and (empty or low != lower[row, axis] or high != upper[row, axis]):
                other = row
    return -1, other


@kernel
def _wrap(lower, upper, axes):  # type: ignore[no-untyped-def]
    for row in range(len(lower)):
        for axis in axes:
            lower[row, axis], upper[row, axis] = wrap_angle(lower[row, axis], upper[row, axis])


def wrapped(boxes: Boxes, *axes: int) -> Boxes:
    """Return boxes that hold the same points, angles taken modulo 2π; the very same boxes if they have the form already.

    Every interval of angles begins in [-π, π] and ends above π where it crosses the cut; a turn or more is the full circle, [-π, π] rounded
    outward. An interval that is moved by whole turns is rounded outward. Rows stay rows, and an empty one becomes ``lower = +inf,
    upper = -inf`` in every dimension.

    Parameters
    ----------
    boxes
        Boxes whose angles may have any turn; [-inf, inf] is the full circle.
    axes
        The axes that are angles in radians.

    Raises
    ------
    ValueError
        If a bound is NaN, or if there is no such axis.
    """
    check_rounding()
    for axis in axes:
        if not 0 <= axis < boxes.dimension:
            raise ValueError(f"axis {axis} was said to be circular; the boxes have the axes 0 to {boxes.dimension - 1}")
    angles = np.array(axes, dtype=np.int64)
    unknown, other = _survey(boxes.lower, boxes.upper, angles)
    if unknown >= 0:
        raise ValueError(f"box {unknown} of {len(boxes)} has a bound that is NaN; give numbers, or lower = inf and upper = -inf for none")
    if other < 0:
        return boxes
    turned = Boxes(boxes.lower.copy(), boxes.upper.copy())
    _wrap(turned.lower, turned.upper, angles)
    return turned.where(~boxes.empty)
