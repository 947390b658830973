"""Where the beams of a scan can end, seen from a robot whose heading lies in an interval."""

import math

from ial.contractors.intervals.rotation import turn_point
from ial.contractors.intervals.trigonometric import LARGEST_ANGLE, sincos
from ial.contractors.kernels import kernel
from ial.lidar.margins import MARGIN, REACH


@kernel
def _drawn_in(cells):  # type: ignore[no-untyped-def]
    return min(max(cells, -REACH), REACH)


@kernel
def relative_bounds(theta_lower, theta_upper, evidence, resolution, out):  # type: ignore[no-untyped-def]
    """Fill `out` with the bounds of each end point relative to the robot, in cells: x lower, y lower, x upper, y upper.

    The distance that the map may be wrong is included, and `margins.MARGIN`.

    Parameters
    ----------
    theta_lower, theta_upper
        The heading.
    evidence
        The `Evidence` of the scan.
    resolution
        The width of a cell.
    out
        Where to write the bounds, float64 of shape (n, 4).
    """
    ends, directions, errors, map_error = evidence.ends, evidence.directions, evidence.errors, evidence.map_error
    # `turn_point` takes arcs below π, and sines are known up to a largest angle; beyond, every heading may be meant.
    whole = not (theta_upper - theta_lower < 3.0 and theta_lower >= -LARGEST_ANGLE and theta_upper <= LARGEST_ANGLE)
    s0, c0 = sincos(theta_lower)
    s1, c1 = sincos(theta_upper)
    for i in range(len(ends)):
        px, py = ends[i, 0], ends[i, 1]
        along, across = errors[i, 0], errors[i, 1]
        if whole:
            radius = math.sqrt(px * px + py * py) + along + across
            xl, xu, yl, yu = -radius, radius, -radius, radius
        else:
            xl, xu, yl, yu = turn_point(px, py, s0, c0, s1, c1)
            dxl, dxu, dyl, dyu = turn_point(directions[i, 0], directions[i, 1], s0, c0, s1, c1)
            most_x = max(abs(dxl), abs(dxu))
            most_y = max(abs(dyl), abs(dyu))
            # Of lengths within reach the margin covers what is rounded here; of a farther point, that by which `turn_point` has widened it.
            wide_x = along * most_x + across * most_y
            wide_y = along * most_y + across * most_x
            xl -= wide_x
            xu += wide_x
            yl -= wide_y
            yu += wide_y
        out[i, 0] = _drawn_in((xl - map_error) / resolution) - MARGIN
        out[i, 1] = _drawn_in((yl - map_error) / resolution) - MARGIN
        out[i, 2] = _drawn_in((xu + map_error) / resolution) + MARGIN
        out[i, 3] = _drawn_in((yu + map_error) / resolution) + MARGIN
