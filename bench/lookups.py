"""`Lookups`: the table indices that the scan contractor reads for a batch of boxes, recorded, and a bare loop that reads them again."""

import numpy as np
import numpy.typing as npt

from ial.contractors.boxes import Boxes
from ial.contractors.groups import group_rows
from ial.contractors.kernels import kernel
from ial.contractors.threads import run
from ial.lidar.evidence.end_points import relative_bounds
from ial.lidar.search.flat_table import flat_table
from ial.lidar.search.rectangle_indices import OFFSET, rectangle_indices
from ial.lidar.search.scan_contractor import ScanContractor
from ial.lidar.search.table_coordinates import in_cells
from ial.maps.grids.cell_table import BORDER


@kernel
def _walk(order, lower, upper, evidence, occupied, firsts, indices):  # type: ignore[no-untyped-def]
    """Go the way of the scan contractor's kernel; count its tests in `firsts`, and record the indices where there is room for them."""
    flat, stride, rows, columns = flat_table(occupied.bordered)
    q, beams = evidence.outliers, len(evidence.ends)
    bounds = np.empty((beams, 4))
    tests = 0
    for at in range(len(order)):
        row = order[at]
        if at == 0 or lower[row, 2] != lower[order[at - 1], 2] or upper[row, 2] != upper[order[at - 1], 2]:
            relative_bounds(lower[row, 2], upper[row, 2], evidence, occupied.resolution, bounds)
        box = lower[row, 0], lower[row, 1], upper[row, 0], upper[row, 1]
        xl, yl, xu, yu, near = in_cells(*box, occupied.resolution, occupied.origin)
        firsts[at] = tests
        if not near:
            continue
        failed = 0
        for i in range(beams):
            left, below, right, above = rectangle_indices(
                bounds, i, xl + OFFSET, yl + OFFSET, xu + (OFFSET + 1.0), yu + (OFFSET + 1.0), columns, rows
            )
            low, high = np.uint64(below) * stride, np.uint64(above) * stride
            near, far = np.uint64(left), np.uint64(right)
            if len(indices):
                indices[tests, 0], indices[tests, 1] = high + far, low + far
                indices[tests, 2], indices[tests, 3] = high + near, low + near
            tests += 1
            failed += flat[high + far] - flat[low + far] - flat[high + near] + flat[low + near] == 0
            if failed > q or i + 1 - failed >= beams - q:
                break
    firsts[len(order)] = tests


@kernel
def _replay(start, stop, firsts, indices, flat, q, keep):  # type: ignore[no-untyped-def]
    for row in range(start, stop):
        failed = 0
        for at in range(firsts[row], firsts[row + 1]):
            failed += flat[indices[at, 0]] - flat[indices[at, 1]] - flat[indices[at, 2]] + flat[indices[at, 3]] == 0
        keep[row] = failed <= q


class Lookups:
    """Everything that a scan contractor reads of its table for a batch of boxes, in its order.

    Parameters
    ----------
    contractor
        The scan contractor.
    boxes
        The batch.

    Attributes
    ----------
    tests
        How many boxes and beams are tested together, four look-ups each.
    """

    def __init__(self, contractor: ScanContractor, boxes: Boxes) -> None:
        self._order = group_rows(boxes.lower[:, 2], boxes.upper[:, 2])
        cells = contractor.occupied.cells
        self._flat = cells.bordered.reshape(-1)[BORDER:]
        self._q = contractor.beams.outliers
        self._firsts = np.empty(len(boxes) + 1, dtype=np.int64)
        self._indices = np.empty((0, 4), dtype=np.uint32)
        for _ in range(2):  # the first pass counts, the second records
            _walk(self._order, boxes.lower, boxes.upper, contractor.beams.evidence, cells, self._firsts, self._indices)
            self.tests = int(self._firsts[-1])
            self._indices = self._indices if len(self._indices) else np.empty((self.tests, 4), dtype=np.uint32)

    def replay(self) -> npt.NDArray[np.bool_]:
        """Read the table again, and do nothing else; return which boxes are kept, in the order of the batch."""
        rows = len(self._order)
        kept, keep = np.empty(rows, dtype=np.bool_), np.empty(rows, dtype=np.bool_)
        run(_replay, rows, self._firsts, self._indices, self._flat, self._q, kept)
        keep[self._order] = kept
        return keep
