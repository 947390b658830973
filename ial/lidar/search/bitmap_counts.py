"""How many beams fail from each cell of one bitmap, for one interval of headings.

A cell is divided into parts, as wide as a cell of the map. For one beam the rectangles of end points of neighbouring parts are neighbours
in the map, a cell apart, so eight of them are looked up together.
"""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ial.contractors.kernels import kernel
from ial.lidar.search.cell_bitmaps import BITMAP_COLUMNS, BITMAP_ROWS
from ial.lidar.search.empty_rectangles import LANES, count_empty_rectangles
from ial.maps.grids.cell_table import BORDER

_SEGMENT = BORDER // LANES  # groups of lanes in one segment: what a table's border allows
_NEVER = 1 << 20  # more than any number of beams: a part outside the domain
_BEAMS_PER_CHECK = 8


class LineTables(NamedTuple):
    """Two tables of equal size, each with its border as one line: the cells that beams may end at, and those in which the robot may be.

    Rows are `stride` apart; `rows` and `columns` are the largest indices, without the border.
    """

    occupied: npt.NDArray[np.int32]
    domain: npt.NDArray[np.uint16]
    stride: int
    rows: int
    columns: int


class Space(NamedTuple):
    """Segments, int64 of shape (n, 4), and the counts of their parts.

    A segment is a run of parts: its row in the tables, its first column, the number of groups of lanes, and the place of its first count.
    """

    segments: npt.NDArray[np.int64]
    counts: npt.NDArray[np.int32]


@kernel
def line_tables(occupied, domain):  # type: ignore[no-untyped-def]
    """Return two tables with their borders as lines."""
    rows, columns = occupied.shape[0] - 1, occupied.shape[1] - 1 - 2 * BORDER
    return LineTables(occupied.reshape(-1), domain.reshape(-1), occupied.shape[1], rows, columns)


@kernel
def _clamped(value, low, high):  # type: ignore[no-untyped-def]
    return min(max(value, low), high)


@kernel
def place(bounds, drift, places):  # type: ignore[no-untyped-def]
    """Write which table corners belong to each beam from the part whose lower corner is the origin: left, below, right, above."""
    for i in range(len(bounds)):
        places[i, 0] = int(np.floor(bounds[i, 0]))
        places[i, 1] = int(np.floor(bounds[i, 1]))
        places[i, 2] = int(np.floor(bounds[i, 2] + drift)) + 2
        places[i, 3] = int(np.floor(bounds[i, 3] + drift)) + 2


@kernel
def _add_empty(line, tables, places, segment, counts):  # type: ignore[no-untyped-def]
    """Add 1 to the counts of the parts of a segment whose rectangle is empty, in one of the tables."""
    row, first, groups, at = segment
    left = _clamped(first + places[0], -BORDER, tables.columns) + BORDER
    right = _clamped(first + places[2], -BORDER, tables.columns) + BORDER
    below = _clamped(row + places[1], 0, tables.rows) * tables.stride
    above = _clamped(row + places[3], 0, tables.rows) * tables.stride
    for group in range(groups):
        step = group * LANES
        count_empty_rectangles(
            line, above + right + step, above + left + step, below + right + step, below + left + step, counts, at + step
        )


@kernel
def list_segments(words, corner, parts, segments):  # type: ignore[no-untyped-def]
    """List the runs of parts that hold the set cells of a bitmap with its first part in some row and column; return how many."""
    row0, column0 = corner
    listed = at_count = 0
    for y in range(BITMAP_ROWS):
        word = words[y]
        if word == np.uint64(0):
            continue
        low, high = 0, BITMAP_COLUMNS - 1
        while not (word >> np.uint64(low)) & np.uint64(1):
            low += 1
        while not (word >> np.uint64(high)) & np.uint64(1):
            high -= 1
        first, stop = low * parts, (high + 1) * parts
        for part in range(parts):
            at = first
            while at < stop:
                groups = min((stop - at + LANES - 1) // LANES, _SEGMENT)
                segments[listed, 0] = row0 + y * parts + part
                segments[listed, 1] = column0 + at
                segments[listed, 2] = groups
                segments[listed, 3] = at_count
                at_count += groups * LANES
                listed += 1
                at += groups * LANES
    return listed


@kernel
def _refine(segments, listed, most, counts):  # type: ignore[no-untyped-def]
    """Take the groups without a promising part off both ends of the segments; return whether any group is left."""
    left = False
    for k in range(listed):
        first, groups, at = segments[k, 1], segments[k, 2], segments[k, 3]
        while groups > 0 and not _promising(counts, at, most):
            first += LANES
            at += LANES
            groups -= 1
        while groups > 0 and not _promising(counts, at + (groups - 1) * LANES, most):
            groups -= 1
        segments[k, 1], segments[k, 2], segments[k, 3] = first, groups, at
        left = left or groups > 0
    return left


@kernel
def _promising(counts, at, most):  # type: ignore[no-untyped-def]
    smallest = counts[at]
    for lane in range(1, LANES):
        smallest = min(smallest, counts[at + lane])
    return smallest <= most


@kernel
def count_bitmap(space, listed, corner, parts, places, most, tables, least):  # type: ignore[no-untyped-def]
    """Lower `least` to the smallest count among the parts of each cell of a bitmap, for one interval of headings.

    Parameters
    ----------
    space
        The `Space`, whose first segments are those of the bitmap; they are cut short.
    listed
        How many these are.
    corner, parts
        Row and column of the bitmap's first part in the tables, and how many parts a cell has along an axis.
    places
        What `place` has written.
    most
        Counts above this are not finished.
    tables
        The `LineTables`.
    least
        For each cell, shape (16, 64).
    """
    segments, counts = space
    row0, column0 = corner
    beams = len(places)
    around = np.array([-1, -1, 2, 2])
    for k in range(listed):
        row, first, groups, at = segments[k]
        for i in range(at, at + groups * LANES):
            counts[i] = 0
        _add_empty(tables.domain, tables, around, (row, first, groups, at), counts)
        for i in range(at, at + groups * LANES):
            counts[i] *= _NEVER
    start = 0
    left = _refine(segments, listed, most, counts)
    while start < beams and left:
        stop = min(start + _BEAMS_PER_CHECK, beams)
        for i in range(start, stop):
            for k in range(listed):
                row, first, groups, at = segments[k]
                if groups > 0:
                    _add_empty(tables.occupied, tables, places[i], (row, first, groups, at), counts)
        start = stop
        left = _refine(segments, listed, most, counts)
    for k in range(listed):
        row, first, groups, at = segments[k]
        y = (row - row0) // parts
        for i in range(groups * LANES):
            x = (first - column0 + i) // parts
            if x < BITMAP_COLUMNS and counts[at + i] < least[y, x]:
                least[y, x] = counts[at + i]


@kernel
def working_space(parts):  # type: ignore[no-untyped-def]
    """Return room for the segments of a bitmap and the counts of their parts."""
    longest = parts * (BITMAP_COLUMNS * parts // (_SEGMENT * LANES) + 1) * BITMAP_ROWS
    counts = np.empty(BITMAP_ROWS * parts * (BITMAP_COLUMNS * parts + LANES), dtype=np.int32)
    return Space(np.empty((longest, 4), dtype=np.int64), counts)
