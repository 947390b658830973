"""`Tiles`: cells of a lattice, 16 rows of 64 columns at a time, each cell one bit."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ial.contractors.boxes import Boxes, FloatArray
from ial.contractors.kernels import kernel

TILE_ROWS = 16
TILE_COLUMNS = 64  # a row of a tile is one 64-bit word

IntArray = npt.NDArray[np.int64]
WordArray = npt.NDArray[np.uint64]


@dataclass(frozen=True, eq=False)
class Tiles:
    """A set of cells of one level of a lattice.

    Parameters
    ----------
    keys
        (layer, tile row, tile column) of each tile, sorted, int64 of shape (n, 3).
    words
        Which cells belong to the set: bit c of ``words[i, r]`` stands for row r and column c of tile i; uint64 of shape (n, 16).
    """

    keys: IntArray
    words: WordArray

    def __len__(self) -> int:
        """Return the number of cells, not of tiles."""
        return int(np.bitwise_count(self.words).sum())

    def boxes(self, step: float, edges: FloatArray) -> Boxes:
        """Return the cells as boxes, tile by tile, row by row.

        Parameters
        ----------
        step
            Width of a cell along x and y.
        edges
            Boundaries of the layers, float64.
        """
        tile, y, x = self._places()
        layer, row, column = self.keys[tile, 0], self.keys[tile, 1] * TILE_ROWS + y, self.keys[tile, 2] * TILE_COLUMNS + x
        lower = np.stack([column * step, row * step, edges[layer]], axis=1)
        return Boxes(lower, np.stack([(column + 1) * step, (row + 1) * step, edges[layer + 1]], axis=1))

    def values(self, cells: npt.NDArray[np.int16]) -> npt.NDArray[np.int16]:
        """Return the numbers of the cells of the set, in the order of `boxes`, from an array of shape (n, 16, 64)."""
        return cells[self._places()]

    def _places(self) -> tuple[IntArray, IntArray, IntArray]:
        """Return tile, row and column of each cell of the set, those counted within the tile."""
        places = np.empty((3, len(self)), dtype=np.int64)
        _list_places(self.words, places)
        tile, row, column = places
        return tile, row, column


@kernel
def _list_places(words, places):  # type: ignore[no-untyped-def]
    at = 0
    for tile in range(len(words)):
        for y in range(TILE_ROWS):
            word = words[tile, y]
            if word == np.uint64(0):
                continue
            for x in range(TILE_COLUMNS):
                if (word >> np.uint64(x)) & np.uint64(1):
                    places[0, at], places[1, at], places[2, at] = tile, y, x
                    at += 1


@kernel
def _tiles_met(ranges):  # type: ignore[no-untyped-def]
    total = 0
    for row in range(len(ranges)):
        across = ranges[row, 1] // TILE_COLUMNS - ranges[row, 0] // TILE_COLUMNS + 1
        along = ranges[row, 3] // TILE_ROWS - ranges[row, 2] // TILE_ROWS + 1
        total += across * along * (ranges[row, 5] - ranges[row, 4] + 1)
    return total


@kernel
def _spread(ranges):  # type: ignore[no-untyped-def]
    """Return the first tile row and tile column met, and how many tile rows and tile columns there are from it to the last one met."""
    top = np.int64(1) << 62
    low_y, high_y, low_x, high_x = top, -top, top, -top
    for row in range(len(ranges)):
        low_y = min(low_y, ranges[row, 2] // TILE_ROWS)
        high_y = max(high_y, ranges[row, 3] // TILE_ROWS)
        low_x = min(low_x, ranges[row, 0] // TILE_COLUMNS)
        high_x = max(high_x, ranges[row, 1] // TILE_COLUMNS)
    return low_y, low_x, high_y - low_y + 1, high_x - low_x + 1


@kernel
def _number(ranges, layers, low_y, low_x, numbers):  # type: ignore[no-untyped-def]
    """Give the tiles that are met their numbers, in the order of their keys; `numbers` is -1 elsewhere. Return how many they are."""
    for row in range(len(ranges)):
        for turn in range(ranges[row, 4], ranges[row, 5] + 1):
            for y in range(ranges[row, 2] // TILE_ROWS - low_y, ranges[row, 3] // TILE_ROWS - low_y + 1):
                for x in range(ranges[row, 0] // TILE_COLUMNS - low_x, ranges[row, 1] // TILE_COLUMNS - low_x + 1):
                    numbers[turn % layers, y, x] = 0
    found = 0
    for layer in range(layers):
        for y in range(numbers.shape[1]):
            for x in range(numbers.shape[2]):
                if numbers[layer, y, x] == 0:
                    numbers[layer, y, x] = found
                    found += 1
    return found


@kernel
def _fill(ranges, low_y, low_x, numbers, keys, words):  # type: ignore[no-untyped-def]
    layers = len(numbers)
    for row in range(len(ranges)):
        for turn in range(ranges[row, 4], ranges[row, 5] + 1):
            layer = turn % layers
            for tile_y in range(ranges[row, 2] // TILE_ROWS, ranges[row, 3] // TILE_ROWS + 1):
                for tile_x in range(ranges[row, 0] // TILE_COLUMNS, ranges[row, 1] // TILE_COLUMNS + 1):
                    tile = numbers[layer, tile_y - low_y, tile_x - low_x]
                    keys[tile, 0], keys[tile, 1], keys[tile, 2] = layer, tile_y, tile_x
                    first = max(ranges[row, 0] - tile_x * TILE_COLUMNS, 0)
                    last = min(ranges[row, 1] - tile_x * TILE_COLUMNS, TILE_COLUMNS - 1)
                    bits = (~np.uint64(0) >> np.uint64(TILE_COLUMNS - 1 - (last - first))) << np.uint64(first)
                    below = tile_y * TILE_ROWS
                    for y in range(max(ranges[row, 2] - below, 0), min(ranges[row, 3] - below, TILE_ROWS - 1) + 1):
                        words[tile, y] |= bits


def tiles_met(ranges: IntArray, layers: int) -> int:
    """Return a measure of the work of `filled_tiles`: pairs of a range and a tile that it meets, or a share of all tiles around."""
    if not len(ranges):
        return 0
    _, _, rows, columns = _spread(ranges)
    return int(max(_tiles_met(ranges), rows * columns * layers >> 4))


def filled_tiles(ranges: IntArray, layers: int) -> Tiles:
    """Return the cells in ranges.

    Parameters
    ----------
    ranges
        First and last cell along x, y and θ, both included, int64 of shape (n, 6). Those along θ are counted on beyond a turn.
    layers
        The number of cells around the circle.
    """
    if not len(ranges):
        return Tiles(np.empty((0, 3), dtype=np.int64), np.empty((0, TILE_ROWS), dtype=np.uint64))
    low_y, low_x, rows, columns = _spread(ranges)
    numbers = np.full((layers, rows, columns), -1, dtype=np.int32)
    found = _number(ranges, layers, low_y, low_x, numbers)
    keys, words = np.empty((found, 3), dtype=np.int64), np.zeros((found, TILE_ROWS), dtype=np.uint64)
    _fill(ranges, low_y, low_x, numbers, keys, words)
    return Tiles(keys, words)
