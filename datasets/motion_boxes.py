"""Compiled kernels on boxes of motions and poses: rows (x, y, theta) of (lower, upper), every bound rounded outward.

An odometry is a row (x, y, z, w, error_m, error_rad), as in `OdometryPath`.
"""

import numpy as np

from ial.contractors.intervals.angle import wrap_angle
from ial.contractors.intervals.arithmetic import add, div, mul, sub
from ial.contractors.intervals.rotation import rotate
from ial.contractors.intervals.trigonometric import PI_LOWER, PI_UPPER, atan2, cos, hypot, sin
from ial.contractors.kernels import kernel

PER_MESSAGE, PER_METRE, PER_RADIAN, PER_SECOND, PER_SCAN = range(5)  # columns of the parts of a bound; the rows are dx, dy, dtheta

# An arc with the chord d that turns by φ <= π stays within its sagitta ½·d·tan(φ/4) of the chord; tan(φ/4) <= φ/π there, and 1/(2π) < 0.16.
_SAGITTA = 0.16

_NANOSECONDS = 1e9


@kernel
def turn(x, y, heading, turned):  # type: ignore[no-untyped-def]
    """Write the points (x, y), turned by all headings, to `turned[0:2]`; all are (lower, upper) pairs in arrays."""
    bounds = rotate(*cos(heading[0], heading[1]), *sin(heading[0], heading[1]), x[0], x[1], y[0], y[1])
    turned[0, 0], turned[0, 1], turned[1, 0], turned[1, 1] = bounds


@kernel
def compose(first, second, composed):  # type: ignore[no-untyped-def]
    """Write first ⊕ second: ``d = d1 + R(θ1) d2, θ = θ1 + θ2``."""
    turn(second[0], second[1], first[2], composed)
    composed[0, 0], composed[0, 1] = add(first[0, 0], first[0, 1], composed[0, 0], composed[0, 1])
    composed[1, 0], composed[1, 1] = add(first[1, 0], first[1, 1], composed[1, 0], composed[1, 1])
    composed[2, 0], composed[2, 1] = add(first[2, 0], first[2, 1], second[2, 0], second[2, 1])


@kernel
def heading(odometry):  # type: ignore[no-untyped-def]
    """Return bounds of the heading 2·atan2(z, w) of a quaternion of any length, plus and minus its error."""
    lower, upper = atan2(odometry[2], odometry[2], odometry[3], odometry[3])
    return add(2.0 * lower, 2.0 * upper, -odometry[5], odometry[5])  # doubling is exact


@kernel
def _shift(previous, now, position):  # type: ignore[no-untyped-def]
    """Write how far two positions lie apart, rows (x, y) in the odometry frame, for all within their errors."""
    for axis in range(2):
        before = add(previous[axis], previous[axis], -previous[4], previous[4])
        after = add(now[axis], now[axis], -now[4], now[4])
        position[axis, 0], position[axis, 1] = sub(after[0], after[1], before[0], before[1])


@kernel
def _turned(start, end):  # type: ignore[no-untyped-def]
    """Return the turn from one heading to another, given their bounds; its lower bound lies in [-π, π]."""
    return wrap_angle(*sub(end[0], end[1], start[0], start[1]))


@kernel
def difference(previous, now, moved):  # type: ignore[no-untyped-def]
    """Write ``previous⁻¹ ⊕ now`` for all poses within the errors of two odometry rows."""
    position = np.empty((2, 2))
    _shift(previous, now, position)
    start, end = heading(previous), heading(now)
    turn(position[0], position[1], np.array([-start[1], -start[0]]), moved)
    moved[2, 0], moved[2, 1] = _turned(start, end)


@kernel
def farthest(box):  # type: ignore[no-untyped-def]
    """Return upper bounds of the way and of the turn of the motions in a box."""
    dx = max(abs(box[0, 0]), abs(box[0, 1]))
    dy = max(abs(box[1, 0]), abs(box[1, 1]))
    return hypot(0.0, dx, 0.0, dy)[1], max(abs(box[2, 0]), abs(box[2, 1]))


@kernel
def sagitta(box):  # type: ignore[no-untyped-def]
    """Return an upper bound of how far an arc that leads to a motion in a box may be from its chord."""
    way, turned = farthest(box)
    return mul(0.0, way, *mul(0.0, min(turned, PI_UPPER), _SAGITTA, _SAGITTA))[1]


@kernel
def widen(box, parts, seconds):  # type: ignore[no-untyped-def]
    """Widen a recorded motion by all parts of its bounds but that of the scan, in place."""
    way, turned = farthest(box)
    for axis in range(3):
        # What was travelled is an interval, because it may be infinite, and 0·∞ is 0 there.
        half = add(0.0, parts[axis, PER_MESSAGE], *mul(parts[axis, PER_METRE], parts[axis, PER_METRE], 0.0, way))
        half = add(half[0], half[1], *mul(parts[axis, PER_RADIAN], parts[axis, PER_RADIAN], 0.0, turned))
        half = add(half[0], half[1], *mul(parts[axis, PER_SECOND], parts[axis, PER_SECOND], 0.0, seconds))
        box[axis, 0], box[axis, 1] = add(box[axis, 0], box[axis, 1], -half[1], half[1])


@kernel
def seconds_between(start_ns, stop_ns):  # type: ignore[no-untyped-def]
    """Return an upper bound of the time between two stamps, whichever comes first."""
    span = float(abs(stop_ns - start_ns))
    return div(span, span, _NANOSECONDS, _NANOSECONDS)[1]


@kernel
def piece(stamps, numbers, row, parts, moved):  # type: ignore[no-untyped-def]
    """Write all true motions from one row of a path to the next."""
    difference(numbers[row], numbers[row + 1], moved)
    widen(moved, parts, seconds_between(stamps[row], stamps[row + 1]))


@kernel
def along(stamps, numbers, parts, moved):  # type: ignore[no-untyped-def]
    """Write all true motions from the first row of a path to its last: its pieces composed, and once widened by the part of a scan."""
    one, composed = np.empty((3, 2)), np.empty((3, 2))
    for row in range(len(stamps) - 1):  # `piece` is long, and takes long to compile: it is called in one place
        piece(stamps, numbers, row, parts, one)
        if row:
            compose(moved, one, composed)
        for axis in range(3):
            bounds = composed[axis] if row else one[axis]
            moved[axis, 0], moved[axis, 1] = bounds[0], bounds[1]
    for axis in range(3):
        moved[axis, 0], moved[axis, 1] = add(moved[axis, 0], moved[axis, 1], -parts[axis, PER_SCAN], parts[axis, PER_SCAN])


@kernel
def interpolation_error(first, second, between):  # type: ignore[no-untyped-def]
    """Return how far each coordinate and the heading may be from `between`, an odometry without errors, on the way from one to another.

    The robot stays as near to the box of the two positions as an arc does to its chord, and its heading in the shorter arc.
    """
    box = np.zeros((3, 2))
    aside, angle = 0.0, 0.0
    for neighbour in (first, second):
        _shift(between, neighbour, box)
        box[2, 0], box[2, 1] = _turned(heading(between), heading(neighbour))
        aside = max(aside, max(max(-box[0, 0], box[0, 1]), max(-box[1, 0], box[1, 1])))
        angle = max(angle, max(-box[2, 0], box[2, 1]))
    _shift(first, second, box)
    box[2, 0], box[2, 1] = _turned(heading(first), heading(second))
    if box[2, 0] < -PI_LOWER or box[2, 1] > PI_LOWER:  # half a circle may have been turned either way
        angle = max(angle, PI_UPPER)
    return add(aside, aside, 0.0, sagitta(box))[1], angle
