"""`CellBitmaps`: cells of a lattice, 16 rows of 64 columns at a time, each cell one bit."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ial.contractors.boxes import Boxes, FloatArray
from ial.contractors.kernels import kernel

BITMAP_ROWS = 16
BITMAP_COLUMNS = 64  # a row of a bitmap is one 64-bit word

IntArray = npt.NDArray[np.int64]
WordArray = npt.NDArray[np.uint64]


@dataclass(frozen=True, eq=False)
class CellBitmaps:
    """A set of cells of one level of a lattice.

    Parameters
    ----------
    keys
        (layer, bitmap row, bitmap column) of each bitmap, sorted, int64 of shape (n, 3).
    words
        Which cells belong to the set: bit c of ``words[i, r]`` stands for row r and column c of bitmap i; uint64 of shape (n, 16).
    """

    keys: IntArray
    words: WordArray

    def __len__(self) -> int:
        """Return the number of cells, not of bitmaps."""
        return int(np.bitwise_count(self.words).sum())

    def boxes(self, step: float, edges: FloatArray) -> Boxes:
        """Return the cells as boxes, bitmap by bitmap, row by row.

        Parameters
        ----------
        step
            Width of a cell along x and y.
        edges
            Boundaries of the layers, float64.
        """
        bitmap, y, x = self._places()
        layer, row, column = self.keys[bitmap, 0], self.keys[bitmap, 1] * BITMAP_ROWS + y, self.keys[bitmap, 2] * BITMAP_COLUMNS + x
        lower = np.stack([column * step, row * step, edges[layer]], axis=1)
        return Boxes(lower, np.stack([(column + 1) * step, (row + 1) * step, edges[layer + 1]], axis=1))

    def values(self, cells: npt.NDArray[np.int16]) -> npt.NDArray[np.int16]:
        """Return the numbers of the cells of the set, in the order of `boxes`, from an array of shape (n, 16, 64)."""
        return cells[self._places()]

    def _places(self) -> tuple[IntArray, IntArray, IntArray]:
        """Return bitmap, row and column of each cell of the set, those counted within the bitmap."""
        places = np.empty((3, len(self)), dtype=np.int64)
        _list_places(self.words, places)
        bitmap, row, column = places
        return bitmap, row, column


@kernel
def _list_places(words, places):  # type: ignore[no-untyped-def]
    at = 0
    for bitmap in range(len(words)):
        for y in range(BITMAP_ROWS):
            word = words[bitmap, y]
            if word == np.uint64(0):
                continue
            for x in range(BITMAP_COLUMNS):
                if (word >> np.uint64(x)) & np.uint64(1):
                    places[0, at], places[1, at], places[2, at] = bitmap, y, x
                    at += 1


@kernel
def _bitmaps_met(ranges):  # type: ignore[no-untyped-def]
    total = 0
    for row in range(len(ranges)):
        across = ranges[row, 1] // BITMAP_COLUMNS - ranges[row, 0] // BITMAP_COLUMNS + 1
        along = ranges[row, 3] // BITMAP_ROWS - ranges[row, 2] // BITMAP_ROWS + 1
        total += across * along * (ranges[row, 5] - ranges[row, 4] + 1)
    return total


@kernel
def _spread(ranges):  # type: ignore[no-untyped-def]
    """Return the first row and column of bitmaps met, and how many there are of each from there to the last one met."""
    top = np.int64(1) << 62
    low_y, high_y, low_x, high_x = top, -top, top, -top
    for row in range(len(ranges)):
        low_y = min(low_y, ranges[row, 2] // BITMAP_ROWS)
        high_y = max(high_y, ranges[row, 3] // BITMAP_ROWS)
        low_x = min(low_x, ranges[row, 0] // BITMAP_COLUMNS)
        high_x = max(high_x, ranges[row, 1] // BITMAP_COLUMNS)
    return low_y, low_x, high_y - low_y + 1, high_x - low_x + 1


@kernel
def _number(ranges, layers, low_y, low_x, numbers):  # type: ignore[no-untyped-def]
    """Give the bitmaps that are met their numbers, in the order of their keys; `numbers` is -1 elsewhere. Return how many they are."""
    for row in range(len(ranges)):
        for turn in range(ranges[row, 4], ranges[row, 5] + 1):
            for y in range(ranges[row, 2] // BITMAP_ROWS - low_y, ranges[row, 3] // BITMAP_ROWS - low_y + 1):
                for x in range(ranges[row, 0] // BITMAP_COLUMNS - low_x, ranges[row, 1] // BITMAP_COLUMNS - low_x + 1):
                    numbers[turn % layers, y, x] = 0
    count = 0
    for layer in range(layers):
        for y in range(numbers.shape[1]):
            for x in range(numbers.shape[2]):
                if numbers[layer, y, x] == 0:
                    numbers[layer, y, x] = count
                    count += 1
    return count


@kernel
def _fill(ranges, low_y, low_x, numbers, keys, words):  # type: ignore[no-untyped-def]
    layers = len(numbers)
    for row in range(len(ranges)):
        for turn in range(ranges[row, 4], ranges[row, 5] + 1):
            layer = turn % layers
            for bitmap_y in range(ranges[row, 2] // BITMAP_ROWS, ranges[row, 3] // BITMAP_ROWS + 1):
                for bitmap_x in range(ranges[row, 0] // BITMAP_COLUMNS, ranges[row, 1] // BITMAP_COLUMNS + 1):
                    bitmap = numbers[layer, bitmap_y - low_y, bitmap_x - low_x]
                    keys[bitmap, 0], keys[bitmap, 1], keys[bitmap, 2] = layer, bitmap_y, bitmap_x
                    first = max(ranges[row, 0] - bitmap_x * BITMAP_COLUMNS, 0)
                    last = min(ranges[row, 1] - bitmap_x * BITMAP_COLUMNS, BITMAP_COLUMNS - 1)
                    bits = (~np.uint64(0) >> np.uint64(BITMAP_COLUMNS - 1 - (last - first))) << np.uint64(first)
                    below = bitmap_y * BITMAP_ROWS
                    for y in range(max(ranges[row, 2] - below, 0), min(ranges[row, 3] - below, BITMAP_ROWS - 1) + 1):
                        words[bitmap, y] |= bits


def bitmaps_met(ranges: IntArray, layers: int) -> int:
    """Return a measure of the work of `filled_bitmaps`: pairs of a range and a bitmap that it meets, or a share of all bitmaps around."""
    if not len(ranges):
        return 0
    _, _, rows, columns = _spread(ranges)
    return int(max(_bitmaps_met(ranges), rows * columns * layers >> 4))


def filled_bitmaps(ranges: IntArray, layers: int) -> CellBitmaps:
    """Return the cells in ranges.

    Parameters
    ----------
    ranges
        First and last cell along x, y and θ, both included, int64 of shape (n, 6). Those along θ are counted on beyond a turn.
    layers
        The number of cells around the circle.
    """
    if not len(ranges):
        return CellBitmaps(np.empty((0, 3), dtype=np.int64), np.empty((0, BITMAP_ROWS), dtype=np.uint64))
    low_y, low_x, rows, columns = _spread(ranges)
    numbers = np.full((layers, rows, columns), -1, dtype=np.int32)
    count = _number(ranges, layers, low_y, low_x, numbers)
    keys, words = np.empty((count, 3), dtype=np.int64), np.zeros((count, BITMAP_ROWS), dtype=np.uint64)
    _fill(ranges, low_y, low_x, numbers, keys, words)
    return CellBitmaps(keys, words)
