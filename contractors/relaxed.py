"""Relaxed intersection: the points of all boxes but at most q."""

import numpy as np

from ial.contractors.boxes import Boxes, FloatArray
from ial.contractors.contractor import Contractor, common_dimension, require_dimension
from ial.contractors.kernels import kernel
from ial.contractors.threads import run


@kernel
def covered(openings, closings, needed):  # type: ignore[no-untyped-def]
    """Return the hull of the points that at least `needed` >= 1 intervals cover, given their sorted lower and their sorted upper bounds.

    Such a hull begins where an interval opens and ends where one closes. Intervals are closed: at the same value an opening comes before
    a closing.
    """
    count = len(openings)
    closed = 0
    for opened in range(1, count + 1):
        lower = openings[opened - 1]
        while closings[closed] < lower:
            closed += 1
        if opened - closed >= needed:
            break
    else:
        return np.inf, -np.inf
    opened = 0
    for closed in range(1, count + 1):
        upper = closings[count - closed]
        while openings[count - 1 - opened] > upper:
            opened += 1
        if closed - opened >= needed:
            break
    return lower, upper


@kernel
def _intersect_relaxed(start, stop, lower, upper, outliers, out_lower, out_upper):  # type: ignore[no-untyped-def]
    """Write the relaxed intersection of the m boxes of each row."""
    count, dimension = lower.shape[1:]
    openings, closings = np.empty(count), np.empty(count)
    for i in range(start, stop):
        empty = False
        for axis in range(dimension):
            kept = 0
            for j in range(count):
                # A box that is empty in one dimension counts in none.
                if (lower[i, j] <= upper[i, j]).all():
                    openings[kept] = lower[i, j, axis]
                    closings[kept] = upper[i, j, axis]
                    kept += 1
            low, high = covered(np.sort(openings[:kept]), np.sort(closings[:kept]), count - outliers)
            empty = empty or low > high
            out_lower[i, axis] = low
            out_upper[i, axis] = high
        if empty:
            out_lower[i] = np.inf
            out_upper[i] = -np.inf


def relaxed_intersection(lower: FloatArray, upper: FloatArray, outliers: int) -> Boxes:
    """Return boxes that contain every point of at least m − `outliers` of the m boxes of a row.

    Each axis is handled by itself, by sorting the bounds: a row becomes the box of the hulls, per axis, of the numbers that at least
    m − `outliers` of the intervals cover, and empty if there is no such number in some axis. An empty box counts as one that failed. With
    `outliers` >= m nothing is required and each row is the whole space.

    Parameters
    ----------
    lower, upper
        Bounds of m boxes of d dimensions in each of n rows, float64 of shape (n, m, d).
    outliers
        The number of boxes that a point may lie outside of, q >= 0.

    Raises
    ------
    ValueError
        If the shapes do not fit or `outliers` is negative.
    RoundingModeError
        If the processor does not round to nearest.

    References
    ----------
    Jaulin: Robust set-membership state estimation; application to underwater robotics, Automatica 45 (2009).
    """
    if lower.ndim != 3 or lower.shape != upper.shape:
        raise ValueError(f"bounds have shapes {lower.shape} and {upper.shape}; both must be (n, m, d)")
    if outliers < 0:
        raise ValueError(f"the number of outliers is {outliers}; give at least 0")
    rows, count, dimension = lower.shape
    out_lower, out_upper = np.full((rows, dimension), -np.inf), np.full((rows, dimension), np.inf)
    if outliers < count:
        run(_intersect_relaxed, rows, lower, upper, outliers, out_lower, out_upper)
    return Boxes(out_lower, out_upper)


class Relaxed:
    """All of several constraints but at most q: the relaxed intersection of what the contractors leave of each box.

    Parameters
    ----------
    contractors
        At least one contractor, all of one dimension.
    outliers
        The number of constraints that may fail, q >= 0; with q >= the number of contractors a box is returned unchanged.
    """

    def __init__(self, *contractors: Contractor, outliers: int) -> None:
        if outliers < 0:
            raise ValueError(f"the number of outliers is {outliers}; give at least 0")
        self.dimension = common_dimension(contractors)
        self.contractors = contractors
        self.outliers = outliers

    def contract(self, boxes: Boxes) -> Boxes:
        """Return the boxes narrowed to the points that at most `outliers` contractors reject.

        Raises
        ------
        ValueError
            If the boxes are of another dimension.
        """
        require_dimension(self, boxes)
        if self.outliers >= len(self.contractors):
            return boxes
        parts = [contractor.contract(boxes) for contractor in self.contractors]
        lower = np.stack([part.lower for part in parts], axis=1)
        upper = np.stack([part.upper for part in parts], axis=1)
        return relaxed_intersection(lower, upper, self.outliers)
