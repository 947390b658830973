"""`CellContractor`: the contractor to a set of cells of a grid or an image, and the one to everything else.

Boxes (x, y) are in the grid frame, in metres; cells are closed squares.
"""

import numpy as np

from ial.contractors import threads
from ial.contractors.boxes import Boxes, FloatArray
from ial.contractors.intervals.sets import hull
from ial.contractors.kernels import kernel
from ial.contractors.row_contractor import RowContractor
from ial.maps.grids.cell_index import CellIndex, contract, edge_above, edge_below


@kernel
def _contract_rows(start, stop, table, inverse_resolution, resolution, lower, upper):  # type: ignore[no-untyped-def]
    """Narrow rows of (x, y) in place, to the hull of their part in cells: the tightest in doubles."""
    for i in range(start, stop):
        xl, xu, yl, yu = contract(table, inverse_resolution, resolution, lower[i, 0], upper[i, 0], lower[i, 1], upper[i, 1])
        lower[i, 0], lower[i, 1] = xl, yl
        upper[i, 0], upper[i, 1] = xu, yu


@kernel
def _widen_beyond(start, stop, axis, cells, resolution, lower, upper, new_lower, new_upper):  # type: ignore[no-untyped-def]
    """Widen rows by the part of each box below 0 or above the last edge of an axis, these edges included."""
    across = 1 - axis
    last_below, last_above = edge_below(cells, resolution), edge_above(cells, resolution)
    for i in range(start, stop):
        low, high = lower[i, axis], upper[i, axis]
        if not (low <= high and lower[i, across] <= upper[i, across]):
            continue
        if low <= 0.0:
            new_lower[i, axis], new_upper[i, axis] = hull(new_lower[i, axis], new_upper[i, axis], low, min(high, 0.0))
        if high >= last_above:
            new_lower[i, axis], new_upper[i, axis] = hull(new_lower[i, axis], new_upper[i, axis], max(low, last_below), high)
        if low <= 0.0 or high >= last_above:
            new_lower[i, across], new_upper[i, across] = lower[i, across], upper[i, across]


class CellContractor(RowContractor):
    """The contractor of "this point lies in a cell of the set": boxes (x, y) shrink to the hull of their part in cells, tight in doubles.

    ``~CellContractor(index)`` is the contractor of the points in other cells or outside the grid, and ``Separator.of`` gives both: for the
    walls of a map, ``Separator.of(CellContractor(CellIndex(grid.mask(OCCUPIED), grid.resolution)))``. An image is such a mask with its
    last row first.

    Parameters
    ----------
    index
        The set of cells.
    """

    dimension = 2

    def __init__(self, index: CellIndex) -> None:
        if index.cells.origin != (0, 0):
            raise ValueError(f"the index is that of a part of a grid, from cell {index.cells.origin} on; give one of the whole grid")
        self._index = index

    def complement(self) -> "OutsideCells":
        """Return the contractor of the points outside of the cells, or on their border."""
        return OutsideCells(self._index)

    def _narrow_rows(self, lower: FloatArray, upper: FloatArray) -> None:
        cells = self._index.cells
        threads.run(_contract_rows, len(lower), cells.table, cells.inverse_resolution, cells.resolution, lower, upper)


class OutsideCells(RowContractor):
    """The contractor of "this point lies outside of the cells of the set, or on their border".

    A box shrinks to the hull, tight in doubles, of its part in cells that do not belong to the set and beyond the edges of the grid.

    Parameters
    ----------
    index
        The set of cells.
    """

    dimension = 2

    def __init__(self, index: CellIndex) -> None:
        self._index = index
        rows, columns = index.cells.table.shape
        areas = np.multiply.outer(np.arange(rows, dtype=np.int32), np.arange(columns, dtype=np.int32))
        self._table = areas - index.cells.table  # the summed-area table of all other cells

    def complement(self) -> CellContractor:
        """Return the contractor of the points in a cell of the set."""
        return CellContractor(self._index)

    def _narrow(self, boxes: Boxes) -> Boxes:
        narrowed, resolution = super()._narrow(boxes), self._index.cells.resolution
        for axis, cells in enumerate((self._table.shape[1] - 1, self._table.shape[0] - 1)):
            threads.run(_widen_beyond, len(boxes), axis, cells, resolution, boxes.lower, boxes.upper, narrowed.lower, narrowed.upper)
        return narrowed

    def _narrow_rows(self, lower: FloatArray, upper: FloatArray) -> None:
        cells = self._index.cells
        threads.run(_contract_rows, len(lower), self._table, cells.inverse_resolution, cells.resolution, lower, upper)
