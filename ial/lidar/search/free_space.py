"""Rays that occupied cells block, wherever in a box of poses the robot is.

A ray is *blocked* at a pose if it and every ray beside it, parallel and at most a margin away, meets a closed occupied cell before its
length. Together these rays sweep a strip. Seen from a box of poses the strip is wider: it holds all rays of all poses and bearings. The map
is walked through column by column (or row by row, where rays run upwards), and what a ray can reach of a column through free cells is kept
as bits. If that is nothing, occupied cells cut the strip, and every ray in it has met one: straight rays are among the paths that step
from a cell to one of its four neighbours, and a ray through the corner of an occupied cell has met it.
"""

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ial.contractors.boxes import Boxes
from ial.contractors.groups import group_rows
from ial.contractors.intervals.rotation import turn_point
from ial.contractors.intervals.trigonometric import sincos
from ial.contractors.kernels import kernel
from ial.contractors.margins import ROUNDINGS
from ial.contractors.threads import run
from ial.lidar.evidence.beams import Beams
from ial.lidar.evidence.end_points import relative_bounds
from ial.lidar.margins import MARGIN, NEAR
from ial.lidar.search.bit_columns import BitColumns, read_bits
from ial.lidar.search.flat_table import ends_nowhere, flat_table
from ial.lidar.search.rectangle_indices import OFFSET
from ial.lidar.search.table_coordinates import in_cells
from ial.maps.grids.cell_index import CellIndex
from ial.maps.grids.cell_table import CellTable

_STEEPEST = 0.55  # a ray runs along an axis if its cosine with it is above this at both ends of its interval
_CHUNK = 16  # columns that are passed at once where the strip is free
_WIDEST_TURN = 0.5  # radians; a slope has bounds only where no pole of the tangent lies between
_WIDEST = 64  # rows of a strip: the bits of a word


class BlockingCells(NamedTuple):
    """The occupied cells: their table, and themselves packed along both axes; see `BitColumns`."""

    cells: CellTable
    upwards: npt.NDArray[np.uint64]
    rightwards: npt.NDArray[np.uint64]


class _Strip(NamedTuple):
    """Rays side by side: along them runs the coordinate a, across them b.

    They start between the lows and the highs, and rise along b by a slope for each step along a.
    """

    a_low: float
    a_high: float
    b_low: float
    b_high: float
    slope_low: float
    slope_high: float


@kernel
def _rows_met(strip, k):  # type: ignore[no-untyped-def]
    """Return the first and the last row that a strip meets between the lines k and k + 1."""
    near, far = k - strip.a_high, k + 1 - strip.a_low
    low = strip.b_low + strip.slope_low * (near if strip.slope_low >= 0.0 else far)
    high = strip.b_high + strip.slope_high * (far if strip.slope_high >= 0.0 else near)
    return int(np.floor(low - MARGIN)), int(np.floor(high + MARGIN))


@kernel
def _spread(reached, free):  # type: ignore[no-untyped-def]
    """Return which free rows of a column are connected with reached ones."""
    while True:
        more = (reached | (reached << np.uint64(1)) | (reached >> np.uint64(1))) & free
        if more == reached:
            return reached
        reached = more


@kernel
def _cut(strip, first, last, sign, columns_along, blocking):  # type: ignore[no-untyped-def]
    """Return whether occupied cells cut a strip between the lines `first` and `last` + 1.

    Parameters
    ----------
    strip
        The `_Strip`.
    first, last, sign
        Lines of the map, and which way a counts them.
    columns_along
        Whether they are its columns.
    blocking
        The `BlockingCells`.
    """
    table, lines = blocking.cells.table, blocking.upwards if columns_along else blocking.rightwards
    reached = np.uint64(0)
    started = False
    base = 0
    k = first
    while k <= last:
        low, high = _rows_met(strip, k)
        if high - low >= _WIDEST:
            return False
        until = min(k + _CHUNK - 1, last)
        end_low, end_high = _rows_met(strip, until)
        a0, a1 = (k, until + 1) if sign > 0 else (-until - 1, -k)
        if _free(table, columns_along, a0, a1, min(low, end_low), max(high, end_high) + 1):
            started = False  # every row can be reached again
            k = until + 1
            continue
        while k <= until:
            low, high = _rows_met(strip, k)
            if high - low >= _WIDEST:
                return False
            within = ~np.uint64(0) >> np.uint64(_WIDEST - 1 - (high - low))
            free = within & ~read_bits(lines, k if sign > 0 else -k - 1, low)
            if started:
                moved = low - base
                if abs(moved) >= _WIDEST:
                    return False
                reached = reached >> np.uint64(moved) if moved >= 0 else reached << np.uint64(-moved)
                reached = _spread(reached & free, free)
            else:
                reached = free
                started = True
            if reached == np.uint64(0):
                return True
            base = low
            k += 1
    return False


@kernel
def _free(table, columns_along, a0, a1, b0, b1):  # type: ignore[no-untyped-def]
    """Return whether no cell of the set lies in a rectangle of cells, clamped to the map."""
    left, right, below, above = (a0, a1, b0, b1) if columns_along else (b0, b1, a0, a1)
    rows, columns = table.shape[0] - 1, table.shape[1] - 1
    left, right = min(max(left, 0), columns), min(max(right, 0), columns)
    below, above = min(max(below, 0), rows), min(max(above, 0), rows)
    return table[above, right] - table[below, right] - table[above, left] + table[below, left] == 0


@kernel
def blocked(box, laser, ray, margin, blocking):  # type: ignore[no-untyped-def]
    """Return whether a ray is certainly blocked from everywhere in a box; lengths in cells.

    Parameters
    ----------
    box
        xl, yl, xu, yu of the robot.
    laser
        Bounds ul, uu, vl, vu of the laser's position relative to it.
    ray
        Cosine and sine at the lower and at the upper end of its direction in the map, each wrong by less than 2^-53, and its length.
    margin
        How far beside it rays must be blocked, too.
    blocking
        The `BlockingCells`.
    """
    table = blocking.cells.table
    c0, s0, c1, s1, length = ray
    margin += MARGIN
    if min(abs(c0), abs(c1)) >= _STEEPEST and c0 * c1 > 0.0:
        along = True
        a0, a1, b0, b1 = c0, c1, s0, s1
        la_low, la_high = box[0] + laser[0], box[2] + laser[1]
        lb_low, lb_high = box[1] + laser[2], box[3] + laser[3]
    elif min(abs(s0), abs(s1)) >= _STEEPEST and s0 * s1 > 0.0:
        along = False
        a0, a1, b0, b1 = s0, s1, c0, c1
        la_low, la_high = box[1] + laser[2], box[3] + laser[3]
        lb_low, lb_high = box[0] + laser[0], box[2] + laser[1]
    else:
        return False
    sign = 1 if a0 > 0.0 else -1
    if sign < 0:
        la_low, la_high = -la_high, -la_low
    # Cosines are below 1 and slopes below 2: an error of both, and a quotient of numbers above a half.
    smallest = min(abs(a0), abs(a1)) - ROUNDINGS
    wide = margin / smallest
    first_slope, second_slope = b0 / abs(a0), b1 / abs(a1)
    # Outside of the map nothing stands, so the walk may begin and end at its edges, however long the ray is.
    cells = table.shape[1] - 1 if along else table.shape[0] - 1
    lowest, highest = (0, cells - 1) if sign > 0 else (-cells, -1)
    first = max(int(math.ceil(la_high + margin)), lowest)
    last = int(min(math.floor(la_low + length * smallest - margin) - 1.0, float(highest)))
    slope_low = min(first_slope, second_slope) - ROUNDINGS
    slope_high = max(first_slope, second_slope) + ROUNDINGS
    strip = _Strip(la_low, la_high, lb_low - wide, lb_high + wide, slope_low, slope_high)
    return _cut(strip, first, last, sign, along, blocking)


@kernel
def _block_rows(start, stop, order, lower, upper, evidence, rays, parts, blocking, least):  # type: ignore[no-untyped-def]
    origins, angles, turns, lengths, numbers, margins = rays
    resolution, origin, table = blocking.cells.resolution, blocking.cells.origin, flat_table(blocking.cells.bordered)
    beams = len(evidence.ends)
    count = len(angles)
    headings = np.empty((count, 5))
    lasers = np.empty((count, 4))
    bounds = np.empty((2, beams, 4))
    barred = np.empty(beams, dtype=np.bool_)
    theta_lower, theta_upper = np.nan, np.nan
    for at in range(start, stop):
        row = order[at]
        if lower[row, 2] != theta_lower or upper[row, 2] != theta_upper:
            theta_lower, theta_upper = lower[row, 2], upper[row, 2]
            middle = theta_lower + 0.5 * (theta_upper - theta_lower)
            relative_bounds(theta_lower, middle, evidence, resolution, bounds[0])
            relative_bounds(middle, theta_upper, evidence, resolution, bounds[1])
            sl, cl = sincos(theta_lower)
            su, cu = sincos(theta_upper)
            for i in range(count):
                ul, uu, vl, vu = turn_point(origins[i, 0], origins[i, 1], sl, cl, su, cu)
                lasers[i, 0], lasers[i, 1] = ul / resolution - MARGIN, uu / resolution + MARGIN
                lasers[i, 2], lasers[i, 3] = vl / resolution - MARGIN, vu / resolution + MARGIN
                turn = turns[i] + ROUNDINGS * (abs(theta_lower) + abs(theta_upper) + abs(angles[i]) + turns[i])  # two sums
                headings[i, 1], headings[i, 0] = sincos(theta_lower + angles[i] - turn)
                headings[i, 3], headings[i, 2] = sincos(theta_upper + angles[i] + turn)
                headings[i, 4] = lengths[i] / resolution - MARGIN
                near = min(lasers[i, 0], lasers[i, 2]) >= -NEAR and max(lasers[i, 1], lasers[i, 3]) <= NEAR
                if not near or theta_upper - theta_lower + 2.0 * turn > _WIDEST_TURN:
                    headings[i, :4] = 0.0  # along no axis: such a ray is never counted as blocked
        xl, yl, xu, yu, near = in_cells(lower[row, 0], lower[row, 1], upper[row, 0], upper[row, 1], resolution, origin)
        if not near or theta_upper - theta_lower > _WIDEST_TURN:
            continue
        box = (xl - MARGIN, yl - MARGIN, xu + MARGIN, yu + MARGIN)
        barred[:] = False
        alone = blocked_rays = 0
        for i in range(count):
            ray = (headings[i, 0], headings[i, 1], headings[i, 2], headings[i, 3], headings[i, 4])
            laser = (lasers[i, 0], lasers[i, 1], lasers[i, 2], lasers[i, 3])
            if blocked(box, laser, ray, margins[i] / resolution, blocking):
                blocked_rays += 1
                if numbers[i] >= 0:
                    barred[numbers[i]] = True
                else:
                    alone += 1
        if blocked_rays:
            fewest = np.int64(1) << 30
            wide = (xu - xl) / parts
            high = (yu - yl) / parts
            for part in range(2 * parts * parts):
                half, place = part % 2, part // 2
                left, below = xl + (place % parts) * wide - MARGIN, yl + (place // parts) * high - MARGIN
                right, above = left + wide + 2.0 * MARGIN, below + high + 2.0 * MARGIN
                fewest = min(fewest, alone + _bad(table, bounds[half], barred, left, below, right, above))
            least[row] = max(least[row], fewest)


@kernel
def _bad(table, bounds, barred, xl, yl, xu, yu):  # type: ignore[no-untyped-def]
    """Return how many beams fail from a box: those that are barred, and those that meet no occupied cell of a `FlatTable`."""
    xl, yl = xl + OFFSET, yl + OFFSET
    xu, yu = xu + (OFFSET + 1.0), yu + (OFFSET + 1.0)
    failed = 0
    for i in range(len(bounds)):
        failed += 1 if barred[i] else ends_nowhere(table, bounds, i, xl, yl, xu, yu)
    return failed


def count_blocked(
    boxes: Boxes,
    least: npt.NDArray[np.int16],
    beams: Beams,
    parts: int,
    occupied: CellIndex,
    bits: BitColumns,
) -> npt.NDArray[np.int16]:
    """Return how many beams are bad at least in each box, those counted that are blocked; int16 of shape (n,).

    Parameters
    ----------
    boxes
        Cells of poses, narrower than half a radian where anything shall be found.
    least
        How many are bad at least without regard to free space; int16 of shape (n,).
    beams
        The evidence of the scan, with its rays.
    parts
        Into how many parts a cell is divided, along x and along y, to count the beams that end nowhere.
    occupied, bits
        The occupied cells.
    """
    rays = beams.rays
    counted = least.astype(np.int64)
    if rays is None or not len(rays):
        return least
    order = group_rows(boxes.lower[:, 2], boxes.upper[:, 2])
    paths = (rays.origins, rays.angles, rays.turns, rays.lengths, rays.beams, rays.margins)
    blocking = BlockingCells(occupied.cells, bits.upwards, bits.rightwards)
    run(_block_rows, len(boxes), order, boxes.lower, boxes.upper, beams.evidence, paths, parts, blocking, counted, minimum=16)
    return np.minimum(counted, np.iinfo(np.int16).max).astype(np.int16)
