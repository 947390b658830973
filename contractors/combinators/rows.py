"""Choosing rows of a batch, and gathering what is left of them: bounds are compared and copied, never computed."""

import numpy as np

from ial.contractors.boxes import Boxes
from ial.contractors.kernels import kernel

PAYS = 0.75  # rows that are decided are left out of a batch where at most this share of it is not


@kernel
def occupied(lower, upper):  # type: ignore[no-untyped-def]
    """Return the numbers of the rows that are not empty, int64 of shape (at most n,)."""
    rows, dimension = lower.shape
    indices = np.empty(rows, dtype=np.int64)
    count = 0
    for i in range(rows):
        here = True
        for axis in range(dimension):
            here &= lower[i, axis] <= upper[i, axis]
        indices[count] = i
        count += here
    return indices[:count]


@kernel
def scatter(rows, lower, upper, out_lower, out_upper):  # type: ignore[no-untyped-def]
    """Copy box i to row ``rows[i]``, unless it is empty."""
    for i in occupied(lower, upper):
        out_lower[rows[i]] = lower[i]
        out_upper[rows[i]] = upper[i]


@kernel
def widen(rows, lower, upper, hull_lower, hull_upper):  # type: ignore[no-untyped-def]
    """Let the hull of row ``rows[i]`` contain box i, for every box that is not empty; several boxes may share a row."""
    for i in occupied(lower, upper):
        row = rows[i]
        for axis in range(lower.shape[1]):
            hull_lower[row, axis] = min(hull_lower[row, axis], lower[i, axis])
            hull_upper[row, axis] = max(hull_upper[row, axis], upper[i, axis])


@kernel
def outside(rows, lower, upper, hull_lower, hull_upper):  # type: ignore[no-untyped-def]
    """Return which boxes, not empty, are not inside the hull of row ``rows[i]``: their numbers, int64 of shape (at most n,)."""
    indices = occupied(lower, upper)
    count = 0
    for i in indices:
        row = rows[i]
        beyond = False
        for axis in range(lower.shape[1]):
            beyond |= (lower[i, axis] < hull_lower[row, axis]) | (upper[i, axis] > hull_upper[row, axis])
        indices[count] = i
        count += beyond
    return indices[:count]


def emptied(rows: int, dimension: int) -> Boxes:
    """Return a batch of empty boxes, of arrays that may be written to."""
    return Boxes(np.full((rows, dimension), np.inf), np.full((rows, dimension), -np.inf))


def spread(rows: np.ndarray[tuple[int], np.dtype[np.int64]], boxes: Boxes, count: int) -> Boxes:
    """Return `count` boxes, of which row ``rows[i]`` is box i and every other one is empty."""
    whole = emptied(count, boxes.dimension)
    scatter(rows, boxes.lower, boxes.upper, whole.lower, whole.upper)
    return whole
