"""The scan as a constraint on the pose: at most q of the used beams may fail to end at an occupied cell."""

import numpy as np
import numpy.typing as npt

from ial.contractors.angles import wrapped
from ial.contractors.boxes import Boxes
from ial.contractors.groups import group_rows
from ial.contractors.kernels import kernel
from ial.contractors.threads import run
from ial.lidar.evidence.beams import Beams
from ial.lidar.evidence.end_points import relative_bounds
from ial.lidar.search.flat_table import ends_nowhere, flat_table
from ial.lidar.search.narrowing import narrow
from ial.lidar.search.rectangle_indices import OFFSET
from ial.lidar.search.table_coordinates import in_cells
from ial.maps.grids.cell_index import CellIndex


@kernel
def fits(table, bounds, q, order, xl, yl, xu, yu):  # type: ignore[no-untyped-def]
    """Return whether at most q beams certainly miss every occupied cell of a `FlatTable` from all of a box, whose bounds are in cells.

    Beams are tried in an order, in which those that fail move to the front: from the next box the same will mostly fail.
    """
    xl, yl = xl + OFFSET, yl + OFFSET
    xu, yu = xu + (OFFSET + 1.0), yu + (OFFSET + 1.0)
    beams = len(bounds)
    failed = 0
    for at in range(beams):
        i = order[at]
        if ends_nowhere(table, bounds, i, xl, yl, xu, yu):
            order[at], order[failed] = order[failed], i
            failed += 1
            if failed > q:
                return False
        elif at + 1 - failed >= beams - q:
            return True
    return True


@kernel
def _test(start, stop, order, lower, upper, evidence, occupied, keep):  # type: ignore[no-untyped-def]
    table = flat_table(occupied.bordered)
    resolution, origin, q = occupied.resolution, occupied.origin, evidence.outliers
    bounds = np.empty((len(evidence.ends), 4))
    beams = np.arange(len(evidence.ends))
    theta_lower = np.nan
    theta_upper = np.nan
    for at in range(start, stop):
        row = order[at]
        if lower[row, 0] > upper[row, 0] or lower[row, 1] > upper[row, 1] or lower[row, 2] > upper[row, 2]:
            keep[row] = False
            continue
        if lower[row, 2] != theta_lower or upper[row, 2] != theta_upper:
            theta_lower = lower[row, 2]
            theta_upper = upper[row, 2]
            relative_bounds(theta_lower, theta_upper, evidence, resolution, bounds)
        xl, yl, xu, yu, near = in_cells(lower[row, 0], lower[row, 1], upper[row, 0], upper[row, 1], resolution, origin)
        keep[row] = not near or fits(table, bounds, q, beams, xl, yl, xu, yu)  # kept where nothing is known


@kernel
def _narrow(start, stop, order, lower, upper, evidence, occupied):  # type: ignore[no-untyped-def]
    table, resolution, origin, q = occupied.table, occupied.resolution, occupied.origin, evidence.outliers
    bounds = np.empty((len(evidence.ends), 4))
    low = np.empty((2, len(evidence.ends)))
    high = np.empty((2, len(evidence.ends)))
    for at in range(start, stop):
        row = order[at]
        relative_bounds(lower[row, 2], upper[row, 2], evidence, resolution, bounds)
        xl, yl, xu, yu, near = in_cells(lower[row, 0], lower[row, 1], upper[row, 0], upper[row, 1], resolution, origin)
        if not near:
            continue
        x0, y0, x1, y1 = narrow(xl, yl, xu, yu, bounds, q, table, low, high)
        # The margin in `bounds` covers the rounding of a bound that has moved; one that has not keeps its bits.
        if x0 > xl:
            lower[row, 0] = max(lower[row, 0], (x0 + origin[1]) * resolution)
        if y0 > yl:
            lower[row, 1] = max(lower[row, 1], (y0 + origin[0]) * resolution)
        if x1 < xu:
            upper[row, 0] = min(upper[row, 0], (x1 + origin[1]) * resolution)
        if y1 < yu:
            upper[row, 1] = min(upper[row, 1], (y1 + origin[0]) * resolution)


class ScanContractor:
    """Poses (x, y, θ) of the robot, in the grid's frame, from which at most q of the used beams are bad.

    A beam is good at a pose if some point of its error region lies within `Beams.map_error_m` of a closed occupied cell. Beams without
    return are among those that may be bad, and are taken to be good: with as many bad ones allowed as there are hits, a box is returned as
    it is.

    Parameters
    ----------
    beams
        The evidence of the scan.
    occupied
        The occupied cells.

    Source: Guyonneau et al. 2014, section 3.2, eq. 6, as a test with relaxed intersection over all beams.
    """

    dimension = 3

    def __init__(self, beams: Beams, occupied: CellIndex) -> None:
        self.beams = beams
        self.occupied = occupied
        self._most = min(beams.outliers, len(beams.ends))  # of the beams that end somewhere; those without return say nothing here
        self._evidence = beams.evidence._replace(outliers=self._most)

    def __repr__(self) -> str:
        return f"<ScanContractor of {len(self.beams.ends)} beams, {self._most} of which may be bad>"

    def fits(self, boxes: Boxes) -> npt.NDArray[np.bool_]:
        """Return in which boxes a consistent pose cannot be excluded, shape (n,); headings may have any turn.

        Raises
        ------
        ValueError
            If a bound is NaN.
        """
        return self._fit(wrapped(boxes, 2))

    def contract(self, boxes: Boxes) -> Boxes:
        """Return the boxes, positions narrowed by relaxed intersection over the beams; those without a consistent pose are emptied.

        Headings may have any turn, and keep theirs.

        Raises
        ------
        ValueError
            If a bound is NaN.
        """
        turned = wrapped(boxes, 2)
        keep = self._fit(turned)
        lower, upper = turned.lower.copy(), turned.upper.copy()
        if self._most < len(self.beams.ends):
            order = np.flatnonzero(keep)
            run(_narrow, len(order), order, lower, upper, self._evidence, self.occupied.cells, minimum=8)
        lower[:, 2], upper[:, 2] = boxes.lower[:, 2], boxes.upper[:, 2]
        return Boxes(lower, upper).where(keep & (lower <= upper).all(axis=1))

    def _fit(self, boxes: Boxes) -> npt.NDArray[np.bool_]:
        keep = np.empty(len(boxes), dtype=np.bool_)
        order = group_rows(boxes.lower[:, 2], boxes.upper[:, 2])
        run(_test, len(boxes), order, boxes.lower, boxes.upper, self._evidence, self.occupied.cells, keep)
        return keep
