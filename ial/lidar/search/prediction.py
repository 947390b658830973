"""Boxes of poses, moved by an interval motion."""

import numpy as np

from ial.contractors.angles import wrapped
from ial.contractors.boxes import Boxes
from ial.contractors.intervals.angle import wrap_angle
from ial.contractors.intervals.arithmetic import add
from ial.contractors.intervals.rotation import rotate
from ial.contractors.intervals.trigonometric import cos, sin
from ial.contractors.kernels import kernel
from ial.contractors.threads import run
from ial.datasets.motion import Motion


@kernel
def _move(start, stop, lower, upper, motion_lower, motion_upper, moved_lower, moved_upper):  # type: ignore[no-untyped-def]
    dxl, dyl, turn_l = motion_lower
    dxu, dyu, turn_u = motion_upper
    for row in range(start, stop):
        cl, cu = cos(lower[row, 2], upper[row, 2])
        sl, su = sin(lower[row, 2], upper[row, 2])
        ul, uu, vl, vu = rotate(cl, cu, sl, su, dxl, dxu, dyl, dyu)
        moved_lower[row, 0], moved_upper[row, 0] = add(lower[row, 0], upper[row, 0], ul, uu)
        moved_lower[row, 1], moved_upper[row, 1] = add(lower[row, 1], upper[row, 1], vl, vu)
        tl, tu = add(lower[row, 2], upper[row, 2], turn_l, turn_u)
        moved_lower[row, 2], moved_upper[row, 2] = wrap_angle(tl, tu)


def move(boxes: Boxes, motion: Motion) -> Boxes:
    """Return, for each box of poses (x, y, θ), a box around all poses that a motion can lead to from it; an empty row stays empty.

    ``x' = x + dx cos θ − dy sin θ, y' = y + dx sin θ + dy cos θ, θ' = θ + dθ``, in interval arithmetic.

    Raises
    ------
    ValueError
        If a bound is NaN.

    Source: Guyonneau et al. 2014, eq. 3, with a sideways component, in the axes of REP-103.
    """
    boxes = wrapped(boxes, 2)
    lower, upper = np.empty_like(boxes.lower), np.empty_like(boxes.upper)
    run(_move, len(boxes), boxes.lower, boxes.upper, tuple(motion.lower.tolist()), tuple(motion.upper.tolist()), lower, upper)
    return Boxes(lower, upper)


def in_rows(boxes: Boxes) -> Boxes:
    """Return the same set of poses as fewer boxes: neighbours along x that follow each other become one.

    What moves a box depends on its headings alone, so `move` makes of a row what it makes of its boxes together.
    """
    if not len(boxes):
        return boxes
    lower, upper = boxes.lower, boxes.upper
    alike = (lower[1:, 1:] == lower[:-1, 1:]) & (upper[1:, 1:] == upper[:-1, 1:])
    starts = np.append(True, ~(alike.all(axis=1) & (lower[1:, 0] == upper[:-1, 0])))
    first = np.flatnonzero(starts)
    row_upper = upper[first]
    row_upper[:, 0] = upper[np.append(first[1:], len(boxes)) - 1, 0]
    return Boxes(lower[first], row_upper)
