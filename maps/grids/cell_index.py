"""`CellIndex`: which rectangles meet a set of cells, answered in constant time.

A summed-area table holds, for every corner of the grid, how many cells of the set lie to the left of it and below. Four look-ups give the
number in any rectangle (Crow 1984). Rectangles are closed and in the grid frame, in metres; cells are closed squares, so a rectangle
that only touches one meets it.
"""

import numpy as np
import numpy.typing as npt

from ial.contractors import threads
from ial.contractors.boxes import Boxes
from ial.contractors.intervals.arithmetic import mul
from ial.contractors.kernels import kernel
from ial.contractors.margins import ABOVE, BELOW
from ial.errors import MapError
from ial.maps.grids.cell_table import BORDER, CellTable, Counts
from ial.maps.grids.occupancy_grid import check_resolution, check_size


@kernel
def count(table, row0, row1, column0, column1):  # type: ignore[no-untyped-def]
    """Return how many cells of the set lie in rows row0 … row1 − 1 and columns column0 … column1 − 1.

    In a table of 16 bits numbers are known up to a multiple of 2¹⁶: of so many cells or more, at least one is taken to be in the set.
    """
    if table.itemsize == 2:
        cells = np.int64(table[row1, column1]) - table[row0, column1] - table[row1, column0] + table[row0, column0]
        known = cells & 0xFFFF
        return max(known, 1) if (row1 - row0) * (column1 - column0) > 0xFFFF else known
    return np.int64(table[row1, column1] - table[row0, column1] - table[row1, column0] + table[row0, column0])


@kernel
def _accumulate(mask, table):  # type: ignore[no-untyped-def]
    """Fill a summed-area table, modulo the size of its numbers; `mask` has a row and `BORDER` columns on either side less."""
    rows, columns = mask.shape
    table[0, :] = 0
    for row in range(rows):
        total = np.int64(0)
        table[row + 1, : BORDER + 1] = 0
        for column in range(columns):
            total += mask[row, column]
            table[row + 1, BORDER + 1 + column] = table[row, BORDER + 1 + column] + total
        for column in range(BORDER + 1 + columns, table.shape[1]):
            table[row + 1, column] = table[row + 1, BORDER + columns]


@kernel
def cells_met(inverse_resolution, lower, upper, origin, cells):  # type: ignore[no-untyped-def]
    """Return (first, stop): the closed interval meets the closed cells first … stop − 1 of those along one axis, and perhaps no others.

    They are counted from the cell `origin` on and clamped to 0 … cells; first >= stop where the interval lies outside. Bounds may be
    infinite, not NaN. Cells as near to the interval as `margins.ROUNDINGS` of its distance from the corner of the grid may count as met.
    """
    # Left and below of the grid there is no cell, so numbers are positive where they count. They are rounded three times, or four where
    # the width of a cell is itself a rounded part of a wider one. At an edge the factor reaches the cell to the left of it, too.
    first = np.floor(lower * inverse_resolution * BELOW) - origin
    stop = np.floor(upper * inverse_resolution * ABOVE) + 1.0 - origin
    return int(min(max(first, 0.0), cells)), int(max(min(stop, cells), 0.0))


@kernel
def meets(cells, xl, xu, yl, yu):  # type: ignore[no-untyped-def]
    """Return whether a rectangle meets a cell of a `CellTable`; never False where it does. An empty rectangle meets nothing."""
    if not (xl <= xu and yl <= yu):
        return False
    table = cells.table
    column0, column1 = cells_met(cells.inverse_resolution, xl, xu, cells.origin[1], table.shape[1] - 1)
    row0, row1 = cells_met(cells.inverse_resolution, yl, yu, cells.origin[0], table.shape[0] - 1)
    return column0 < column1 and row0 < row1 and count(table, row0, row1, column0, column1) > 0


@kernel
def edge_below(index, resolution):  # type: ignore[no-untyped-def]
    """Return the largest double that is not above index·resolution."""
    return mul(float(index), float(index), resolution, resolution)[0]


@kernel
def edge_above(index, resolution):  # type: ignore[no-untyped-def]
    """Return the smallest double that is not below index·resolution."""
    return mul(float(index), float(index), resolution, resolution)[1]


@kernel
def _cells_exactly_met(inverse_resolution, resolution, lower, upper, cells):  # type: ignore[no-untyped-def]
    """Return `cells_met` without the outermost cells that the margin alone let in: exactly the cells that are met."""
    first, stop = cells_met(inverse_resolution, lower, upper, 0, cells)
    # A number lies below a double exactly if the largest double that is not above it does.
    if first < stop and edge_below(first + 1, resolution) < lower:
        first += 1
    if first < stop and edge_above(stop - 1, resolution) > upper:
        stop -= 1
    return first, stop


@kernel
def columns_with_cells(table, row0, row1, column0, column1):  # type: ignore[no-untyped-def]
    """Return the range from the first column with a cell of the set to one past the last; there must be one."""
    low, high = column0, column1 - 1
    while low < high:
        middle = (low + high) // 2
        if count(table, row0, row1, column0, middle + 1) > 0:
            high = middle
        else:
            low = middle + 1
    first = low
    low, high = first, column1 - 1
    while low < high:
        middle = (low + high + 1) // 2
        if count(table, row0, row1, middle, column1) > 0:
            low = middle
        else:
            high = middle - 1
    return first, low + 1


@kernel
def rows_with_cells(table, row0, row1, column0, column1):  # type: ignore[no-untyped-def]
    """Return the range from the first row with a cell of the set to one past the last; there must be one."""
    return columns_with_cells(table.T, column0, column1, row0, row1)


@kernel
def contract(table, inverse_resolution, resolution, xl, xu, yl, yu):  # type: ignore[no-untyped-def]
    """Return the hull (xl, xu, yl, yu) of the points of a rectangle that lie in a cell of the set: the tightest in doubles."""
    if not (xl <= xu and yl <= yu):
        return np.inf, -np.inf, np.inf, -np.inf
    column0, column1 = _cells_exactly_met(inverse_resolution, resolution, xl, xu, table.shape[1] - 1)
    row0, row1 = _cells_exactly_met(inverse_resolution, resolution, yl, yu, table.shape[0] - 1)
    if column0 >= column1 or row0 >= row1 or count(table, row0, row1, column0, column1) <= 0:
        return np.inf, -np.inf, np.inf, -np.inf
    column0, column1 = columns_with_cells(table, row0, row1, column0, column1)
    row0, row1 = rows_with_cells(table, row0, row1, column0, column1)
    xl = max(xl, edge_below(column0, resolution))
    xu = min(xu, edge_above(column1, resolution))
    yl = max(yl, edge_below(row0, resolution))
    yu = min(yu, edge_above(row1, resolution))
    return xl, xu, yl, yu


@kernel
def _meet_rows(start, stop, cells, lower, upper, met):  # type: ignore[no-untyped-def]
    for i in range(start, stop):
        met[i] = meets(cells, lower[i, 0], upper[i, 0], lower[i, 1], upper[i, 1])


class CellIndex:
    """A set of cells of a grid, with its summed-area table.

    Parameters
    ----------
    mask
        Which cells belong to the set, bool of shape (rows, columns), row 0 at the bottom.
    resolution
        The width of a cell in metres.
    compact
        Count in 16 bits, modulo 2¹⁶: half the memory. Rectangles of 2¹⁶ cells or more are then taken to meet the set.
    origin
        Row and column of the mask's first cell in the grid, if the mask is a part of a larger one.
    whole
        Rows and columns of that larger grid.

    Attributes
    ----------
    cells
        The set with its table, which counts in int32, or uint16 if it is compact.
    whole
        How many rows and columns the grid has.

    Raises
    ------
    MapError
        If the mask is empty, too large or no two-dimensional mask, or the resolution cannot be meant.
    """

    def __init__(
        self,
        mask: npt.NDArray[np.bool_],
        resolution: float,
        compact: bool = False,
        origin: tuple[int, int] = (0, 0),
        whole: tuple[int, int] | None = None,
    ) -> None:
        if mask.ndim != 2 or mask.dtype != np.bool_:
            raise MapError(f"the mask is an array of {mask.dtype} with shape {mask.shape}; give bool with shape (rows, columns)")
        check_size(*mask.shape)
        check_resolution(resolution)
        rows, columns = mask.shape
        # Counted in place: for a large map a copy of the table would cost more memory than all else.
        bordered: Counts = np.empty((rows + 1, columns + 1 + 2 * BORDER), dtype=np.uint16 if compact else np.int32)
        _accumulate(mask, bordered)
        self.cells = CellTable.of(bordered, origin, float(resolution))
        self.whole = whole or (origin[0] + rows, origin[1] + columns)

    def __repr__(self) -> str:
        rows, columns = (side - 1 for side in self.cells.table.shape)
        return f"<CellIndex of {columns} × {rows} cells of {self.cells.resolution} m>"

    def meet(self, boxes: Boxes) -> npt.NDArray[np.bool_]:
        """Return which boxes (x, y) meet a cell of the set, shape (n,); never False where one does."""
        _check_plane(boxes)
        met = np.empty(len(boxes), dtype=np.bool_)
        threads.run(_meet_rows, len(boxes), self.cells, boxes.lower, boxes.upper, met)
        return met


def _check_plane(boxes: Boxes) -> None:
    if boxes.dimension != 2:
        raise ValueError(f"boxes have {boxes.dimension} dimensions; boxes in the grid have 2: x, y")
