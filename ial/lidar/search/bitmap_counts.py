"""How many beams fail from each cell of one bitmap, for one interval of headings.

A cell is divided into parts, as wide as a cell of the map. For one beam the rectangles of end points of neighbouring parts are neighbours
in the map, a cell apart, so eight of them are looked up together.
"""

import numpy as np

from ial.contractors.kernels import kernel
from ial.lidar.search.cell_bitmaps import BITMAP_COLUMNS, BITMAP_ROWS
from ial.lidar.search.empty_rectangles import LANES, count_empty_rectangles
from ial.maps.grids.cell_index import BORDER

_SEGMENT = BORDER // LANES  # groups of lanes in one segment: what a table's border allows
_NEVER = 1 << 20  # more than any number of beams: a part outside the domain
_BEAMS_PER_CHECK = 8


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
def _add_empty(flat, stride, limits, places, rows, first, groups, counts, at):  # type: ignore[no-untyped-def]
    """Add 1 to the counts of the parts of a segment, in table row `rows` from column `first` on, whose rectangle is empty."""
    row_limit, column_limit = limits
    left = _clamped(first + places[0], -BORDER, column_limit) + BORDER
    right = _clamped(first + places[2], -BORDER, column_limit) + BORDER
    below = _clamped(rows + places[1], 0, row_limit) * stride
    above = _clamped(rows + places[3], 0, row_limit) * stride
    for group in range(groups):
        step = group * LANES
        count_empty_rectangles(
            flat, above + right + step, above + left + step, below + right + step, below + left + step, counts, at + step
        )


@kernel
def list_segments(words, row0, column0, parts, segments):  # type: ignore[no-untyped-def]
    """List the runs of parts that hold the set cells of a bitmap; return how many.

    A row holds the table row, the first column, the number of groups of lanes, and the place of the first count.
    """
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
def count_bitmap(segments, listed, row0, column0, parts, places, most, tables, counts, least):  # type: ignore[no-untyped-def]
    """Lower `least` to the smallest count among the parts of each cell of a bitmap, for one interval of headings.

    The segments are cut short; counts above `most` are not finished.
    """
    flat, domain, stride, limits = tables
    beams = len(places)
    around = np.array([-1, -1, 2, 2])
    for k in range(listed):
        row, first, groups, at = segments[k]
        for i in range(at, at + groups * LANES):
            counts[i] = 0
        _add_empty(domain, stride, limits, around, row, first, groups, counts, at)
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
                    _add_empty(flat, stride, limits, places[i], row, first, groups, counts, at)
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
    """Return arrays for the segments of a bitmap and for the counts of their parts."""
    longest = parts * (BITMAP_COLUMNS * parts // (_SEGMENT * LANES) + 1) * BITMAP_ROWS
    counts = np.empty(BITMAP_ROWS * parts * (BITMAP_COLUMNS * parts + LANES), dtype=np.int32)
    return np.empty((longest, 4), dtype=np.int64), counts
