"""Where the robot was at each beam of a scan, as compiled code on the odometry recorded during the scan."""

import numpy as np

from ial.contractors.boxes import FloatArray
from ial.contractors.intervals.arithmetic import add, div, mul, sub
from ial.contractors.intervals.trigonometric import PI_LOWER, PI_UPPER
from ial.contractors.kernels import kernel
from ial.contractors.rounding import check_rounding
from ial.datasets.motion import MotionBounds
from ial.datasets.motion_boxes import compose, piece, sagitta
from ial.datasets.odometry_path import OdometryPath

_CLOCK_NS = 1.0  # the last beam's stamp is rounded to a nanosecond, and so is the time of every other one


@kernel
def _share(time, start, stop):  # type: ignore[no-untyped-def]
    """Return the share of a piece that has passed at a time, within [0, 1]."""
    low, high = sub(time, time, start, start)
    span = stop - start
    if span == 0.0:
        return 0.0, 1.0
    low, high = div(*add(low, high, -_CLOCK_NS, _CLOCK_NS), span, span)
    return min(max(low, 0.0), 1.0), min(max(high, 0.0), 1.0)


@kernel
def _sweep(stamps, numbers, parts, boxes):  # type: ignore[no-untyped-def]
    """Write the motion from the first beam to each, rows (x, y, theta) of (lower, upper)."""
    before, whole, part, moved = np.zeros((3, 2)), np.empty((3, 2)), np.empty((3, 2)), np.empty((3, 2))
    beam, last = 0, len(boxes) - 1
    way = float(abs(stamps[-1] - stamps[0]))
    for row in range(len(stamps) - 1):
        start, stop = float(abs(stamps[row] - stamps[0])), float(abs(stamps[row + 1] - stamps[0]))
        piece(stamps, numbers, row, parts, whole)
        aside = sagitta(whole)
        if whole[2, 0] < -PI_LOWER or whole[2, 1] > PI_LOWER:  # half a circle may have been turned either way
            whole[2, 0], whole[2, 1] = min(whole[2, 0], -PI_UPPER), max(whole[2, 1], PI_UPPER)
        while beam <= last and (beam * way / last <= stop or row == len(stamps) - 2):
            low, high = _share(beam * way / last, start, stop)
            for axis in range(3):
                part[axis, 0], part[axis, 1] = mul(low, high, whole[axis, 0], whole[axis, 1])
                if axis < 2:
                    part[axis, 0], part[axis, 1] = add(part[axis, 0], part[axis, 1], -aside, aside)
            compose(before, part, boxes[beam])
            beam += 1
        compose(before, whole, moved)
        for axis in range(3):
            before[axis, 0], before[axis, 1] = moved[axis, 0], moved[axis, 1]


def sweep_boxes(path: OdometryPath, bounds: MotionBounds, beams: int) -> FloatArray:
    """Return boxes of the true motion from the first beam of a scan to each of its beams.

    The pieces of the path are bounded as those from scan to scan, but for `per_scan`. Within a piece the motion up to a beam is assumed to
    be the beam's share, by time, of the piece's true (dx, dy, dtheta), within 0.16·d·φ in dx and in dy, where d and φ are the way and the
    turn of the piece, which is at most half a circle. So it is for a robot that stands, and for one that goes evenly along a line or an
    arc.

    Parameters
    ----------
    path
        `LaserScan.sweep`.
    bounds
        How far recorded odometry may be from the truth.
    beams
        How many beams there are, evenly spread over the time of the path; at least 2.

    Returns
    -------
    FloatArray
        Rows (dx, dy, dtheta) of (lower, upper) in the frame of the base at the first beam, metres and radians, shape (beams, 3, 2).
    """
    check_rounding()
    boxes = np.empty((beams, 3, 2))
    _sweep(path.stamps_ns, path.numbers, bounds.parts, boxes)
    return boxes
