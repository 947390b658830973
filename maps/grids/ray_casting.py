"""Ray casting in a grid of cells, for simulation and pictures.

The walk from cell to cell follows Amanatides and Woo (1987). Cells are closed, so a ray that touches a corner of an occupied cell, or runs
along its edge, hits it; "touches" means: passes within `TOUCH` cells. Distances are computed to nearest, not outward, and are right
within a few `TOUCH` cells where the ray is not nearly parallel to the edge it meets.
"""

import numpy as np
import numpy.typing as npt

from ial.contractors import threads
from ial.contractors.intervals.trigonometric import LARGEST_ANGLE, sincos
from ial.contractors.kernels import kernel
from ial.maps.grids.occupancy_grid import check_resolution, check_size

TOUCH = 1e-9  # cells
FARTHEST = 2.0**40  # cells; from farther away, a double does not tell the cells of a grid apart

FloatArray = npt.NDArray[np.float64]


@kernel
def _occupied(mask, row, column):  # type: ignore[no-untyped-def]
    return 0 <= row < mask.shape[0] and 0 <= column < mask.shape[1] and mask[row, column]


@kernel
def _touches(mask, u, v):  # type: ignore[no-untyped-def]
    """Return whether a point, in cells, lies in a closed occupied cell."""
    for row in range(int(np.ceil(v - TOUCH)) - 1, int(np.floor(v + TOUCH)) + 1):
        for column in range(int(np.ceil(u - TOUCH)) - 1, int(np.floor(u + TOUCH)) + 1):
            if _occupied(mask, row, column):
                return True
    return False


@kernel
def _span(at, direction, cells):  # type: ignore[no-untyped-def]
    """Return at which distances a ray enters and leaves the closed strip 0 … cells."""
    if direction == 0.0:
        return (-np.inf, np.inf) if 0.0 <= at <= cells else (np.inf, -np.inf)
    first, second = -at / direction, (cells - at) / direction
    return min(first, second), max(first, second)


@kernel
def _along_lines(mask, u, v, du, dv, reach):  # type: ignore[no-untyped-def]
    """Cast a ray parallel to an axis: where it runs along the edge of two rows of cells, it touches both."""
    if du == 0.0:
        mask, u, v, du = mask.T, v, u, dv
    row0, row1 = max(int(np.ceil(v - TOUCH)) - 1, 0), min(int(np.floor(v + TOUCH)), mask.shape[0] - 1)
    step = 1 if du > 0.0 else -1
    column = int(max(np.floor(u), 0.0) if step > 0 else min(np.ceil(u) - 1.0, mask.shape[1] - 1.0))
    while 0 <= column < mask.shape[1]:
        edge = column if step > 0 else column + 1
        distance = max((edge - u) * step, 0.0)
        if distance > reach:
            break
        for row in range(row0, row1 + 1):
            if mask[row, column]:
                return distance
        column += step
    return np.inf


@kernel
def _walk(mask, u, v, du, dv, start, reach):  # type: ignore[no-untyped-def]
    """Cast a ray that crosses lines of both axes, from a point at distance `start` on."""
    at_u, at_v = u + start * du, v + start * dv
    column_step, row_step = (1 if du > 0.0 else -1), (1 if dv > 0.0 else -1)
    column = int(np.floor(at_u)) if column_step > 0 else int(np.ceil(at_u)) - 1
    row = int(np.floor(at_v)) if row_step > 0 else int(np.ceil(at_v)) - 1
    next_column = column + 1 if column_step > 0 else column  # the next line of each axis that is crossed
    next_row = row + 1 if row_step > 0 else row
    per_column, per_row = 1.0 / du, 1.0 / dv
    corner = TOUCH / abs(du * dv)  # crossings of two lines nearer than this meet in a corner
    while True:
        to_column, to_row = (next_column - u) * per_column, (next_row - v) * per_row
        distance = min(to_column, to_row)
        if not distance <= reach:
            return np.inf
        hit = np.inf  # where a cell beside the corner is touched: for a ray along its side, far from the other crossing
        if abs(to_column - to_row) <= corner:
            if _occupied(mask, row, column + column_step):
                hit = to_column
            if _occupied(mask, row + row_step, column):
                hit = min(hit, to_row)
        if to_column <= to_row:
            column += column_step
            next_column += column_step
        if to_row <= to_column:
            row += row_step
            next_row += row_step
        if _occupied(mask, row, column):
            hit = min(hit, distance)
        if hit < np.inf:
            return max(hit, 0.0) if hit <= reach else np.inf
        beyond_column = column >= mask.shape[1] if column_step > 0 else column < 0
        beyond_row = row >= mask.shape[0] if row_step > 0 else row < 0
        if beyond_column or beyond_row:
            return np.inf


@kernel
def cast_ray(mask, u, v, du, dv, reach):  # type: ignore[no-untyped-def]
    """Return the distance, in cells, at which a ray enters an occupied cell; inf if it does not within `reach`.

    Parameters
    ----------
    u, v
        Where it starts, in cells; du, dv its direction, of length 1.
    """
    rows, columns = mask.shape
    # A direction that leaves its line of cells by less than a touch on the whole way is parallel to the axis.
    longest = min(reach, float(rows + columns) + abs(u) + abs(v))
    du = 0.0 if abs(du) * longest <= TOUCH else du
    dv = 0.0 if abs(dv) * longest <= TOUCH else dv
    enter_u, leave_u = _span(u, du, columns)
    enter_v, leave_v = _span(v, dv, rows)
    enter, leave = max(enter_u, enter_v), min(leave_u, leave_v)
    if enter > min(leave, reach) or leave < 0.0:
        return np.inf
    if enter <= 0.0 and _touches(mask, u, v):
        return 0.0
    if du == 0.0 or dv == 0.0:
        return _along_lines(mask, u, v, du, dv, reach)
    return _walk(mask, u, v, du, dv, max(enter - 2.0, 0.0), reach)


@kernel
def _cast_rows(start, stop, mask, resolution, x, y, angle, reach, distance):  # type: ignore[no-untyped-def]
    for i in range(start, stop):
        s, c = sincos(angle[i])
        distance[i] = resolution * cast_ray(mask, x[i] / resolution, y[i] / resolution, c, s, reach / resolution)


def cast_rays(
    mask: npt.NDArray[np.bool_], resolution: float, x: npt.ArrayLike, y: npt.ArrayLike, angles: npt.ArrayLike, max_range: float = np.inf
) -> FloatArray:
    """Return how far rays get before they enter an occupied cell.

    Parameters
    ----------
    mask
        Which cells are occupied, bool of shape (rows, columns), row 0 at the bottom.
    resolution
        The width of a cell in metres.
    x, y
        Where the rays start, in the grid frame, in metres; a number or an array each, inside the grid or not.
    angles
        Their directions in radians, counter-clockwise from the x axis of the grid.
    max_range
        In metres.

    Returns
    -------
    numpy.ndarray
        Distances in metres, in the common shape of `x`, `y` and `angles`: 0 for a ray that starts in an occupied cell, inf for one that
        meets none within `max_range`.

    Raises
    ------
    MapError
        If the mask has no cells or too many, or the resolution cannot be meant.
    ValueError
        If a start is NaN or farther away than 2**40 cells, an angle NaN or beyond 1e5 rad, or `max_range` NaN.
    """
    check_size(*mask.shape)
    check_resolution(resolution)
    at_x, at_y, angle = np.broadcast_arrays(*(np.asarray(each, dtype=np.float64) for each in (x, y, angles)))
    farthest = FARTHEST * resolution
    if not ((np.abs(at_x) <= farthest).all() and (np.abs(at_y) <= farthest).all() and (np.abs(angle) <= LARGEST_ANGLE).all()):
        raise ValueError(f"a ray starts at no point within ±{farthest:g} m, or its angle is not within ±{LARGEST_ANGLE:g} rad")
    if not max_range == max_range:
        raise ValueError("the maximum range of the rays is NaN")
    distance = np.empty(angle.shape)
    flat = [np.array(each, dtype=np.float64).reshape(-1) for each in (at_x, at_y, angle)]
    threads.run(_cast_rows, angle.size, np.ascontiguousarray(mask), resolution, *flat, float(max_range), distance.reshape(-1), minimum=64)
    return distance
