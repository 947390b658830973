"""How many beams fail from each cell of a lattice: the search's last levels, all at once.

A cell is divided into parts, as wide as a cell of the map and half a layer of headings each. For one beam and one interval of headings the
rectangles of end points of neighbouring parts are neighbours in the map, a cell apart, so eight of them are looked up together.
"""

import functools
import math

import numpy as np
import numpy.typing as npt

from ial.contractors.kernels import kernel
from ial.contractors.threads import run
from ial.lidar.beams import Beams
from ial.lidar.count_empty import LANES, count_empty
from ial.lidar.end_points import MARGIN, relative_bounds
from ial.lidar.lattice import Lattice, layer_edges
from ial.lidar.tiles import TILE_COLUMNS, TILE_ROWS, Tiles, WordArray
from ial.maps.cell_index import BORDER, CellIndex

LARGEST_COUNT = 1 << 14

_SEGMENT = BORDER // LANES  # groups of lanes in one segment: what a table's border allows
_NEVER = 1 << 20  # more than any number of beams: a part outside the domain
_BEAMS_PER_CHECK = 8
_GOLDEN = 0.5 * (math.sqrt(5.0) - 1.0)


@kernel
def _clamped(value, low, high):  # type: ignore[no-untyped-def]
    return min(max(value, low), high)


@kernel
def _place(bounds, drift, places):  # type: ignore[no-untyped-def]
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
        count_empty(flat, above + right + step, above + left + step, below + right + step, below + left + step, counts, at + step)


@kernel
def _segments(words, row0, column0, parts, segments):  # type: ignore[no-untyped-def]
    """List the runs of parts that hold the set cells of a tile; return how many.

    A row holds the table row, the first column, the number of groups of lanes, and the place of the first count.
    """
    found = at_count = 0
    for y in range(TILE_ROWS):
        word = words[y]
        if word == np.uint64(0):
            continue
        low, high = 0, TILE_COLUMNS - 1
        while not (word >> np.uint64(low)) & np.uint64(1):
            low += 1
        while not (word >> np.uint64(high)) & np.uint64(1):
            high -= 1
        first, stop = low * parts, (high + 1) * parts
        for part in range(parts):
            at = first
            while at < stop:
                groups = min((stop - at + LANES - 1) // LANES, _SEGMENT)
                segments[found, 0] = row0 + y * parts + part
                segments[found, 1] = column0 + at
                segments[found, 2] = groups
                segments[found, 3] = at_count
                at_count += groups * LANES
                found += 1
                at += groups * LANES
    return found


@kernel
def _trim(segments, found, most, counts):  # type: ignore[no-untyped-def]
    """Take the groups without a promising part off both ends of the segments; return whether any group is left."""
    left = False
    for k in range(found):
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
def _count_tile(segments, found, row0, column0, parts, places, most, tables, counts, least):  # type: ignore[no-untyped-def]
    """Lower `least` to the smallest count among the parts of each cell of a tile, for one interval of headings.

    The segments are trimmed; counts above `most` are not finished.
    """
    flat, domain, stride, limits = tables
    beams = len(places)
    around = np.array([-1, -1, 2, 2])
    for k in range(found):
        row, first, groups, at = segments[k]
        for i in range(at, at + groups * LANES):
            counts[i] = 0
        _add_empty(domain, stride, limits, around, row, first, groups, counts, at)
        for i in range(at, at + groups * LANES):
            counts[i] *= _NEVER
    start = 0
    left = _trim(segments, found, most, counts)
    while start < beams and left:
        stop = min(start + _BEAMS_PER_CHECK, beams)
        for i in range(start, stop):
            for k in range(found):
                row, first, groups, at = segments[k]
                if groups > 0:
                    _add_empty(flat, stride, limits, places[i], row, first, groups, counts, at)
        start = stop
        left = _trim(segments, found, most, counts)
    for k in range(found):
        row, first, groups, at = segments[k]
        y = (row - row0) // parts
        for i in range(groups * LANES):
            x = (first - column0 + i) // parts
            if x < TILE_COLUMNS and counts[at + i] < least[y, x]:
                least[y, x] = counts[at + i]


@kernel
def _count(start, stop, keys, words, edges, parts, evidence, most, map_error, grid, kept, least):  # type: ignore[no-untyped-def]
    ends, directions, errors = evidence
    resolution, drift, table, domain = grid
    flat = table.reshape(-1)
    flat_domain = domain.reshape(-1)
    stride = table.shape[1]
    limits = (table.shape[0] - 1, table.shape[1] - 1 - 2 * BORDER)
    tables = (flat, flat_domain, stride, limits)
    bounds = np.empty((len(ends), 4))
    places = np.empty((2, len(ends), 4), dtype=np.int64)
    longest = parts * (TILE_COLUMNS * parts // (_SEGMENT * LANES) + 1) * TILE_ROWS
    segments = np.empty((longest, 4), dtype=np.int64)
    counts = np.empty(TILE_ROWS * parts * (TILE_COLUMNS * parts + LANES), dtype=np.int32)
    layer = -1
    for tile in range(start, stop):
        if keys[tile, 0] != layer:
            layer = keys[tile, 0]
            for half in range(2):
                relative_bounds(
                    edges[2 * layer + half], edges[2 * layer + half + 1], ends, directions, errors, map_error, resolution, bounds
                )
                _place(bounds, drift, places[half])
        row0, column0 = keys[tile, 1] * TILE_ROWS * parts, keys[tile, 2] * TILE_COLUMNS * parts
        least[tile, :, :] = LARGEST_COUNT
        for half in range(2):
            found = _segments(words[tile], row0, column0, parts, segments)
            _count_tile(segments, found, row0, column0, parts, places[half], most, tables, counts, least[tile])
        for y in range(TILE_ROWS):
            word = words[tile, y]
            if word:
                for x in range(TILE_COLUMNS):
                    if least[tile, y, x] > most:
                        word &= ~(np.uint64(1) << np.uint64(x))
            kept[tile, y] = word


@functools.lru_cache(maxsize=16)
def _spread_order(beams: int) -> npt.NDArray[np.intp]:
    """Return an order in which the first few beams look into all directions: they tell most poses apart."""
    return np.argsort(np.arange(beams) * _GOLDEN % 1.0, kind="stable")


def count_cells(
    tiles: Tiles, lattice: Lattice, beams: Beams, occupied: CellIndex, domain: CellIndex, map_error_m: float
) -> tuple[WordArray, npt.NDArray[np.int16]]:
    """Return which cells may hold a pose of the domain from which not too many beams are bad, and how many are at least.

    Parameters
    ----------
    tiles
        Cells of the finest level.
    lattice
        The lattice, whose parts are as wide as the cells of the map.
    beams
        The evidence of the scan, and how many of its beams may be bad.
    occupied, domain
        Which cells beams may end at, and in which the robot may be.
    map_error_m
        How far the map may be wrong.

    Returns
    -------
    words
        The cells that are left, in the form of `Tiles.words`.
    least
        For each cell that is left, a number that does not exceed the number of bad beams at any pose in it; int16 of shape (n, 16, 64).
    """
    kept, least = np.empty_like(tiles.words), np.empty((len(tiles.words), TILE_ROWS, TILE_COLUMNS), dtype=np.int16)
    rows, columns = occupied.table.shape
    # A part is a little wider than a cell, since its width has 24 bits: so much further right, at most, do its last columns lie.
    drift = (max(rows, columns) + TILE_COLUMNS * lattice.parts) * (lattice.part_m / occupied.resolution - 1.0) + MARGIN
    order = _spread_order(len(beams.ends))
    evidence = (beams.ends[order], beams.directions[order], beams.errors[order])
    grid = (occupied.resolution, drift, occupied.bordered, domain.bordered)
    edges = layer_edges(2 * lattice.layers)
    run(
        _count,
        len(tiles.words),
        tiles.keys,
        tiles.words,
        edges,
        lattice.parts,
        evidence,
        beams.outliers,
        map_error_m,
        grid,
        kept,
        least,
        minimum=4,
    )
    return kept, least
