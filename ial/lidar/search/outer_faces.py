"""Which faces of the cells of an answer lie at its surface."""

import numpy as np
import numpy.typing as npt

from ial.contractors.boxes import Boxes
from ial.contractors.kernels import kernel
from ial.lidar.search.lattice import Lattice


@kernel
def _name(cells, position_m, layer, names):  # type: ignore[no-untyped-def]
    """Write a number for each cell; return by how much that of a neighbour along y and around the circle differs, along x by 1."""
    low, high = np.full(2, np.int64(1) << 40), np.full(2, -(np.int64(1) << 40))
    places = np.empty((len(cells), 2), dtype=np.int64)
    for row in range(len(cells)):
        for axis in range(2):
            places[row, axis] = int(np.rint(cells[row, axis] / position_m))
            low[axis] = min(low[axis], places[row, axis])
            high[axis] = max(high[axis], places[row, axis])
    columns = high[0] - low[0] + 3  # one more on either side, so that no two neighbours have one name
    turn = columns * (high[1] - low[1] + 3)
    for row in range(len(cells)):
        names[row] = layer[row] * turn + (places[row, 1] - low[1] + 1) * columns + places[row, 0] - low[0] + 1
    return columns, turn


@kernel
def _mark(names, known, columns, turn, layers, outer):  # type: ignore[no-untyped-def]
    """Mark the faces behind which there is no cell; `known` holds the names in order."""
    for row in range(len(names)):
        for axis in range(3):
            step = 1 if axis == 0 else columns if axis == 1 else turn
            for side in range(2):
                other = names[row] + (step if side else -step)
                if axis == 2:
                    other = (other + turn * layers) % (turn * layers)
                place = np.searchsorted(known, other)
                outer[row, side, axis] = place == len(known) or known[place] != other


def outer_faces(cells: Boxes, lattice: Lattice) -> npt.NDArray[np.bool_]:
    """Return which faces of cells have no neighbour among them: lower and upper along each axis, bool of shape (n, 2, 3).

    Parameters
    ----------
    cells
        Different cells of the finest level of the lattice.
    lattice
        The lattice. The highest layer of headings is a neighbour of the lowest one.
    """
    names, outer = np.empty(len(cells), dtype=np.int64), np.empty((len(cells), 2, 3), dtype=np.bool_)
    columns, turn = _name(cells.lower, lattice.position_m, lattice.layer(cells), names)
    _mark(names, np.sort(names), columns, turn, lattice.layers, outer)
    return outer
