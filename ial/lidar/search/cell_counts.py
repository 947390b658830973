"""How many beams fail from each cell of a lattice: the search's last levels, all at once.

Cells that differ only in their layers are tried together: first with the whole interval of headings that they span, then with its halves,
and so on down to half a layer. Most cells of a prediction fail at once for several layers.
"""

import functools
import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ial.contractors.boxes import FloatArray
from ial.contractors.kernels import kernel
from ial.contractors.threads import run
from ial.lidar.evidence.beams import Beams
from ial.lidar.evidence.end_points import relative_bounds
from ial.lidar.margins import MOST_BEAMS
from ial.lidar.search.bitmap_counts import count_bitmap, line_tables, list_segments, place, working_space
from ial.lidar.search.cell_bitmaps import BITMAP_COLUMNS, BITMAP_ROWS, CellBitmaps, IntArray, WordArray
from ial.lidar.search.lattice import Lattice, layer_edges
from ial.maps.grids.cell_index import CellIndex
from ial.maps.grids.cell_table import CellTable

LARGEST_COUNT = 2 * MOST_BEAMS

_LEVELS = 3  # blocks of 2³ layers: 11° with the default precision
_GOLDEN = 0.5 * (math.sqrt(5.0) - 1.0)


class _Bitmaps(NamedTuple):
    """Bitmaps in an order: those of run i are order[runs[i]] … order[runs[i + 1] - 1]. See `CellBitmaps` for keys and words."""

    runs: IntArray
    order: IntArray
    keys: IntArray
    words: WordArray


class _Headings(NamedTuple):
    """How many times blocks of layers are halved down to layers, and the boundaries of all half layers."""

    levels: int
    edges: FloatArray


class _Ground(NamedTuple):
    """The cells that beams may end at and those in which the robot may be, and how the lattice lies on them.

    A cell of the lattice has so many parts along an axis, which drift by so much from the cells of the tables on the way across the map.
    """

    occupied: CellTable
    domain: CellTable
    parts: int
    drift: float


@kernel
def _without(words, least, most, left):  # type: ignore[no-untyped-def]
    """Write the set cells of a bitmap without those whose count is above `most`."""
    for y in range(BITMAP_ROWS):
        word = words[y]
        if word:
            for x in range(BITMAP_COLUMNS):
                if least[y, x] > most:
                    word &= ~(np.uint64(1) << np.uint64(x))
        left[y] = word


@kernel
def _place_node(node, block, headings, evidence, ground, bounds, places):  # type: ignore[no-untyped-def]
    """Write which table corners belong to each beam, for the headings of a node of the tree over a block."""
    across = half_layers = 2 << headings.levels
    level = 1
    while level <= node >> 1:  # a level further down, intervals are half as wide
        level <<= 1
        across >>= 1
    at = half_layers * block + (node - level) * across
    relative_bounds(headings.edges[at], headings.edges[at + across], evidence, ground.occupied.resolution, bounds)
    place(bounds, ground.drift, places)


@kernel
def _count(start, stop, bitmaps, headings, evidence, ground, kept, least):  # type: ignore[no-untyped-def]
    """Count the failing beams for runs of bitmaps, which share their place and a block of 2**levels layers.

    The headings of a block form a tree, numbered as a heap: node 1 is the block, nodes 2n and 2n + 1 are the halves of node n, and below
    the layers lie half layers.

    Parameters
    ----------
    bitmaps
        `_Bitmaps`.
    headings
        `_Headings`.
    evidence
        The `Evidence` of the scan, its beams in the order in which they are tried.
    ground
        `_Ground`.
    kept, least
        Where to write what `count_cells` returns.
    """
    runs, order, keys, words = bitmaps
    levels, parts, most = headings.levels, ground.parts, evidence.outliers
    row_origin, column_origin = ground.occupied.origin
    tables = line_tables(ground.occupied.bordered, ground.domain.bordered)
    beams = len(evidence.ends)
    layers = 1 << levels
    bounds = np.empty((beams, 4))
    places = np.empty((4 * layers, beams, 4), dtype=np.int64)
    placed = np.zeros(4 * layers, dtype=np.bool_)
    space = working_space(parts)
    above = np.empty((BITMAP_ROWS, BITMAP_COLUMNS), dtype=np.int16)
    left = np.empty((levels + 2, BITMAP_ROWS), dtype=np.uint64)  # what the nodes above a layer have left
    left[0, :] = ~np.uint64(0)
    nodes = np.empty(levels + 1, dtype=np.int64)  # and which nodes these are
    block = -1
    for number in range(start, stop):
        bitmap = order[runs[number]]
        if keys[bitmap, 0] >> levels != block:
            block = keys[bitmap, 0] >> levels
            placed[:] = False
        corner = (
            keys[bitmap, 1] * BITMAP_ROWS * parts - row_origin,
            keys[bitmap, 2] * BITMAP_COLUMNS * parts - column_origin,
        )
        nodes[:] = 0
        for at in range(runs[number], runs[number + 1]):
            bitmap = order[at]
            leaf = layers + keys[bitmap, 0] - (block << levels)
            least[bitmap, :, :] = LARGEST_COUNT
            kept[bitmap, :] = np.uint64(0)
            for level in range(levels + 1):
                node = leaf >> (levels - level)
                if nodes[level] == node:
                    continue
                nodes[level] = node
                left[level + 1, :] = np.uint64(0)
                alike = 0  # bitmaps below this node
                for other in range(at, runs[number + 1]):
                    if (layers + keys[order[other], 0] - (block << levels)) >> (levels - level) == node:
                        alike += 1
                        for y in range(BITMAP_ROWS):
                            left[level + 1, y] |= words[order[other], y] & left[level, y]
                if alike > 1 or level == levels:
                    if not placed[node]:
                        _place_node(node, block, headings, evidence, ground, bounds, places[node])
                        placed[node] = True
                    listed = list_segments(left[level + 1], corner, parts, space.segments)
                    above[:, :] = LARGEST_COUNT
                    count_bitmap(space, listed, corner, parts, places[node], most, tables, above)
                    _without(left[level + 1], above, most, left[level + 1])
            listed = list_segments(left[levels + 1], corner, parts, space.segments)
            if not listed:
                continue
            for node in range(2 * leaf, 2 * leaf + 2):
                if not placed[node]:
                    _place_node(node, block, headings, evidence, ground, bounds, places[node])
                    placed[node] = True
                listed = list_segments(left[levels + 1], corner, parts, space.segments)
                count_bitmap(space, listed, corner, parts, places[node], most, tables, least[bitmap])
            _without(left[levels + 1], least[bitmap], most, kept[bitmap])


@functools.lru_cache(maxsize=16)
def _spread_order(beams: int) -> npt.NDArray[np.intp]:
    """Return an order in which the first few beams look into all directions: they tell most poses apart."""
    return np.argsort(np.arange(beams) * _GOLDEN % 1.0, kind="stable")


def count_cells(
    bitmaps: CellBitmaps, lattice: Lattice, beams: Beams, occupied: CellIndex, domain: CellIndex
) -> tuple[WordArray, npt.NDArray[np.int16]]:
    """Return which cells may hold a pose of the domain from which not too many beams are bad, and how many are at least.

    Parameters
    ----------
    bitmaps
        Cells of the finest level.
    lattice
        The lattice, whose parts are as wide as the cells of the map.
    beams
        The evidence of the scan, and how many of its beams may be bad.
    occupied, domain
        Which cells beams may end at, and in which the robot may be.

    Returns
    -------
    words
        The cells that are left, in the form of `CellBitmaps.words`.
    least
        For each cell that is left, a number that does not exceed the number of bad beams at any pose in it; int16 of shape (n, 16, 64).
    """
    kept, least = np.empty_like(bitmaps.words), np.empty((len(bitmaps.words), BITMAP_ROWS, BITMAP_COLUMNS), dtype=np.int16)
    # A part is a little wider than a cell, since its width has 24 bits: so much further right, at most, do the last columns of the map lie.
    # It is that of the whole map for all of its parts, so that they give the same answers. `MARGIN` covers what is rounded here.
    farthest = max(occupied.whole) + BITMAP_COLUMNS * lattice.parts
    drift = farthest * max(lattice.part_m / occupied.cells.resolution - 1.0, 0.0)
    order = _spread_order(len(beams.ends))
    evidence = beams.evidence._replace(ends=beams.ends[order], directions=beams.directions[order], errors=beams.errors[order])
    levels = min(_LEVELS, lattice.layers.bit_length() - 1)
    headings = _Headings(levels, layer_edges(2 * lattice.layers))
    ground = _Ground(occupied.cells, domain.cells, lattice.parts, drift)
    places = bitmaps.keys >> np.array([levels, 0, 0])
    order = np.lexsort((bitmaps.keys[:, 0], *places.T[::-1]))
    runs = np.flatnonzero(np.append(True, (np.diff(places[order], axis=0) != 0).any(axis=1))[: len(order)])
    in_runs = _Bitmaps(np.append(runs, len(order)), order, bitmaps.keys, bitmaps.words)
    run(_count, len(runs), in_runs, headings, evidence, ground, kept, least, minimum=2)
    return kept, least
