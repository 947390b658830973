"""`Lattice`: space and heading divided into equal cells, so that overlapping boxes can be replaced by cells that do not overlap."""

import math

import numpy as np
import numpy.typing as npt

from ial.contractors.boxes import Boxes, FloatArray
from ial.contractors.intervals.trigonometric import PI_UPPER
from ial.contractors.kernels import kernel

_TILE_ROWS = 16
_TILE_COLUMNS = 64  # a row of a tile is one 64-bit word
_LARGEST_WORK = 1 << 22  # pairs of a box and a tile; beyond, a coarser lattice is taken

IntArray = npt.NDArray[np.int64]


class Lattice:
    """Cells of equal size over (x, y, θ); a coarser level doubles them along every axis.

    Parameters
    ----------
    position_m
        Width of a cell of the finest level along x and y; rounded up to 24 bits, so that cells and their halves have exact bounds.
    heading_rad
        The circle is divided into the smallest power of two of equal parts that are at most this wide.
    """

    def __init__(self, position_m: float, heading_rad: float) -> None:
        self.position_m = _rounded_up(position_m)
        self.layers = 1 << max(1, math.ceil(math.log2(2.0 * math.pi / heading_rad)))

    @property
    def widths(self) -> FloatArray:
        """Widths of a cell of the finest level, rounded up; float64 of shape (3,)."""
        return np.array([self.position_m, self.position_m, 2.0 * math.pi / self.layers]) * (1.0 + 2.0**-20)

    def root(self, width_m: float, height_m: float) -> Boxes:
        """Return one box around ``[0, width] × [0, height]`` and all headings, whose repeated bisection meets the cells."""
        side = self.position_m * 2.0 ** max(0, math.ceil(math.log2(max(width_m, height_m) / self.position_m)))
        while side < max(width_m, height_m):
            side *= 2.0
        return Boxes.of([(0.0, side), (0.0, side), (-PI_UPPER, PI_UPPER)])

    def cover(self, boxes: Boxes, max_cells: int) -> Boxes:
        """Return different cells of one level that together cover all boxes: the finest level on which they are at most `max_cells`."""
        boxes = boxes[~boxes.empty]
        if not len(boxes):
            return boxes
        for level in range(64):
            step, layers = self.position_m * 2.0**level, max(1, self.layers >> level)
            edges = _edges(layers)
            ranges = np.empty((len(boxes), 6), dtype=np.int64)
            _cell_ranges(boxes.lower, boxes.upper, step, edges, ranges)
            largest = (ranges[:, 1::2] - ranges[:, ::2] + 1).prod(axis=1).max()
            if level < 63 and (largest > max(max_cells, 8) or _tiles_met(ranges, layers) > _LARGEST_WORK):
                continue
            keys, words = _filled_tiles(ranges, layers)
            cells = int(np.bitwise_count(words).sum())
            if cells <= max_cells:
                break
        lower, upper = np.empty((cells, 3)), np.empty((cells, 3))
        _cells_of(keys, words, edges, step, lower, upper)
        return Boxes(lower, upper)


def _rounded_up(width: float) -> float:
    """Return a width of 24 significant bits. Its multiples are exact up to 2^29, and bisecting a multiple of a power of two meets them.

    With a width such as 0.1, bisection misses every third multiple by a bit, and a box that sticks out so far takes a whole cell more.
    """
    mantissa, exponent = math.frexp(width)
    return math.ldexp(math.ceil(math.ldexp(mantissa, 24)), exponent - 24)


def _edges(layers: int) -> FloatArray:
    """Return the boundaries of the headings' cells, those that `Boxes.bisect` makes of the circle, bit for bit."""
    edges = np.array([-PI_UPPER, PI_UPPER])
    while len(edges) <= layers:
        finer = np.empty(2 * len(edges) - 1)
        finer[::2] = edges
        finer[1::2] = edges[:-1] + 0.5 * (edges[1:] - edges[:-1])
        edges = finer
    return edges


@kernel
def _cell_ranges(lower, upper, step, edges, ranges):  # type: ignore[no-untyped-def]
    """Fill `ranges` with the first and last cell of each box along x, y and θ; the θ cells are counted on beyond a turn.

    Bounds are compared exactly with those of the cells. Only the part of an arc beyond π takes a margin, which covers the turn of 2π.
    """
    layers = len(edges) - 1
    width = 2.0 * math.pi / layers
    for row in range(len(lower)):
        for axis in range(2):
            first = int(math.floor(lower[row, axis] / step))
            last = max(first, int(math.ceil(upper[row, axis] / step)) - 1)
            while first * step > lower[row, axis]:
                first -= 1
            while (last + 1) * step < upper[row, axis]:
                last += 1
            ranges[row, 2 * axis] = first
            ranges[row, 2 * axis + 1] = last
        start, stop = lower[row, 2], upper[row, 2]
        first = min(max(int(math.floor((start + math.pi) / width)), 0), layers - 1)
        while first > 0 and edges[first] > start:
            first -= 1
        while first < layers - 1 and edges[first + 1] <= start:
            first += 1
        if stop > edges[layers]:
            last = max(int(math.floor((stop + math.pi) / width + 1e-9)), layers)
        else:
            last = min(max(int(math.floor((stop + math.pi) / width)), first), layers - 1)
            while edges[last + 1] < stop:
                last += 1
            while last > first and edges[last] >= stop:
                last -= 1
        ranges[row, 4] = first
        ranges[row, 5] = min(last, first + layers - 1)


@kernel
def _tiles_met(ranges, layers):  # type: ignore[no-untyped-def]
    total = 0
    for row in range(len(ranges)):
        across = ranges[row, 1] // _TILE_COLUMNS - ranges[row, 0] // _TILE_COLUMNS + 1
        along = ranges[row, 3] // _TILE_ROWS - ranges[row, 2] // _TILE_ROWS + 1
        total += across * along * (ranges[row, 5] - ranges[row, 4] + 1)
    return total


@kernel
def _list_tiles(ranges, layers, keys, rows):  # type: ignore[no-untyped-def]
    at = 0
    for row in range(len(ranges)):
        for turn in range(ranges[row, 4], ranges[row, 5] + 1):
            layer = turn % layers
            for tile_y in range(ranges[row, 2] // _TILE_ROWS, ranges[row, 3] // _TILE_ROWS + 1):
                for tile_x in range(ranges[row, 0] // _TILE_COLUMNS, ranges[row, 1] // _TILE_COLUMNS + 1):
                    keys[at, 0] = layer
                    keys[at, 1] = tile_y
                    keys[at, 2] = tile_x
                    rows[at] = row
                    at += 1


@kernel
def _fill(ranges, keys, rows, groups, words):  # type: ignore[no-untyped-def]
    for at in range(len(keys)):
        row = rows[at]
        below = keys[at, 1] * _TILE_ROWS
        left = keys[at, 2] * _TILE_COLUMNS
        first = max(ranges[row, 0] - left, 0)
        last = min(ranges[row, 1] - left, _TILE_COLUMNS - 1)
        bits = (~np.uint64(0) >> np.uint64(_TILE_COLUMNS - 1 - (last - first))) << np.uint64(first)
        for y in range(max(ranges[row, 2] - below, 0), min(ranges[row, 3] - below, _TILE_ROWS - 1) + 1):
            words[groups[at], y] |= bits


def _filled_tiles(ranges: IntArray, layers: int) -> tuple[IntArray, npt.NDArray[np.uint64]]:
    """Return the tiles that boxes meet, sorted, as rows (layer, tile row, tile column), and the cells met in each as bits."""
    pairs = _tiles_met(ranges, layers)
    listed, rows = np.empty((pairs, 3), dtype=np.int64), np.empty(pairs, dtype=np.int64)
    _list_tiles(ranges, layers, listed, rows)
    low = listed.min(axis=0)
    size = listed.max(axis=0) - low + 1
    flat = ((listed[:, 0] - low[0]) * size[1] + (listed[:, 1] - low[1])) * size[2] + (listed[:, 2] - low[2])
    _, firsts, groups = np.unique(flat, return_index=True, return_inverse=True)
    words = np.zeros((len(firsts), _TILE_ROWS), dtype=np.uint64)
    _fill(ranges, listed, rows, groups, words)
    return listed[firsts], words


@kernel
def _cells_of(keys, words, edges, step, lower, upper):  # type: ignore[no-untyped-def]
    at = 0
    for tile in range(len(keys)):
        for y in range(_TILE_ROWS):
            word = words[tile, y]
            if word == np.uint64(0):
                continue
            row = keys[tile, 1] * _TILE_ROWS + y
            for x in range(_TILE_COLUMNS):
                if (word >> np.uint64(x)) & np.uint64(1):
                    column = keys[tile, 2] * _TILE_COLUMNS + x
                    lower[at, 0] = column * step
                    upper[at, 0] = (column + 1) * step
                    lower[at, 1] = row * step
                    upper[at, 1] = (row + 1) * step
                    lower[at, 2] = edges[keys[tile, 0]]
                    upper[at, 2] = edges[keys[tile, 0] + 1]
                    at += 1
