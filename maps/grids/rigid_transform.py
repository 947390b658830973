"""Boxes of poses (x, y, θ) seen from another frame, rounded outward.

A rotated box is enclosed in an upright one. Each coordinate of the old frame occurs once in each of the new, so interval arithmetic gives
the tightest such box, but for rounding. A rotation by exactly 0 only adds or subtracts the origin. Headings may have any turn, and come out
in the form of `ial.contractors.intervals.angle`.
"""

import numpy as np

from ial.contractors import threads
from ial.contractors.angles import wrapped
from ial.contractors.boxes import Boxes
from ial.contractors.intervals.angle import wrap_angle
from ial.contractors.intervals.arithmetic import add, sub
from ial.contractors.intervals.rotation import rotate
from ial.contractors.intervals.trigonometric import cos, sin
from ial.contractors.kernels import kernel
from ial.pose import Pose


@kernel
def _from_frame(start, stop, frame, lower, upper, new_lower, new_upper):  # type: ignore[no-untyped-def]
    x, y, yaw = frame
    cl, cu = cos(yaw, yaw)
    sl, su = sin(yaw, yaw)
    for i in range(start, stop):
        xl, xu, yl, yu = lower[i, 0], upper[i, 0], lower[i, 1], upper[i, 1]
        tl, tu = lower[i, 2], upper[i, 2]
        if xl <= xu and yl <= yu and tl <= tu:
            if yaw != 0.0:
                xl, xu, yl, yu = rotate(cl, cu, sl, su, xl, xu, yl, yu)
                tl, tu = wrap_angle(*add(tl, tu, yaw, yaw))
            xl, xu = add(xl, xu, x, x)
            yl, yu = add(yl, yu, y, y)
            new_lower[i, 0], new_lower[i, 1], new_lower[i, 2] = xl, yl, tl
            new_upper[i, 0], new_upper[i, 1], new_upper[i, 2] = xu, yu, tu


@kernel
def _into_frame(start, stop, frame, lower, upper, new_lower, new_upper):  # type: ignore[no-untyped-def]
    x, y, yaw = frame
    cl, cu = cos(-yaw, -yaw)
    sl, su = sin(-yaw, -yaw)
    for i in range(start, stop):
        xl, xu, yl, yu = lower[i, 0], upper[i, 0], lower[i, 1], upper[i, 1]
        tl, tu = lower[i, 2], upper[i, 2]
        if xl <= xu and yl <= yu and tl <= tu:
            xl, xu = sub(xl, xu, x, x)
            yl, yu = sub(yl, yu, y, y)
            if yaw != 0.0:
                xl, xu, yl, yu = rotate(cl, cu, sl, su, xl, xu, yl, yu)
                tl, tu = wrap_angle(*sub(tl, tu, yaw, yaw))
            new_lower[i, 0], new_lower[i, 1], new_lower[i, 2] = xl, yl, tl
            new_upper[i, 0], new_upper[i, 1], new_upper[i, 2] = xu, yu, tu


def boxes_from_frame(boxes: Boxes, pose: Pose) -> Boxes:
    """Return boxes of poses that are given in the frame at `pose`, in the frame in which `pose` is given.

    Parameters
    ----------
    boxes
        Boxes (x, y, θ) of shape (n, 3).
    pose
        T_outer_inner; its three numbers are taken as exact.

    Raises
    ------
    ValueError
        If the boxes have another dimension, or a bound is NaN.
    """
    return _transformed(_from_frame, boxes, pose)


def boxes_into_frame(boxes: Boxes, pose: Pose) -> Boxes:
    """Return boxes of poses in the frame at `pose`, given in the frame in which `pose` is given: the way back of `boxes_from_frame`."""
    return _transformed(_into_frame, boxes, pose)


def _transformed(transform, boxes: Boxes, pose: Pose) -> Boxes:  # type: ignore[no-untyped-def]
    if boxes.dimension != 3:
        raise ValueError(f"boxes have {boxes.dimension} dimensions; boxes of poses have 3: x, y, θ")
    boxes = wrapped(boxes, 2)
    lower, upper = np.full(boxes.lower.shape, np.inf), np.full(boxes.lower.shape, -np.inf)
    frame = float(pose.x), float(pose.y), float(pose.theta)
    threads.run(transform, len(boxes), frame, boxes.lower, boxes.upper, lower, upper)
    return Boxes(lower, upper)
