"""Grouping the rows of a batch by one of their intervals: bisection produces few distinct ones, and what depends on them is shared."""

import numpy as np
import numpy.typing as npt

from ial.contractors.kernels import kernel


def group_rows(lower: npt.NDArray[np.float64], upper: npt.NDArray[np.float64]) -> npt.NDArray[np.int64]:
    """Return the row numbers, rows of equal interval side by side, groups by first appearance, rows of a group in their own order.

    Parameters
    ----------
    lower, upper
        One interval a row, float64 of shape (n,).

    Returns
    -------
    numpy.ndarray
        int64 of shape (n,).
    """
    # Columns of one row are contiguous, others are not: of each kind the kernel would be compiled once.
    order: npt.NDArray[np.int64] = _group(np.ascontiguousarray(lower), np.ascontiguousarray(upper))
    return order


@kernel
def _group(lower, upper):  # type: ignore[no-untyped-def]
    rows = len(lower)
    order = np.empty(rows, dtype=np.int64)
    labels = np.empty(rows, dtype=np.int64)
    firsts = np.empty(rows, dtype=np.int64)  # the first row of each group
    sizes = np.zeros(rows + 1, dtype=np.int64)
    table = np.full(4096, -1, dtype=np.int64)
    groups = 0
    for row in range(rows):
        slot = _slot(lower[row], upper[row], len(table))
        while table[slot] >= 0 and (lower[firsts[table[slot]]] != lower[row] or upper[firsts[table[slot]]] != upper[row]):
            slot = (slot + 1) & (len(table) - 1)
        if table[slot] < 0:
            table[slot] = groups
            firsts[groups] = row
            groups += 1
        labels[row] = table[slot]
        sizes[table[slot] + 1] += 1
        if 2 * groups > len(table):
            table = np.full(2 * len(table), -1, dtype=np.int64)
            for group in range(groups):
                first = firsts[group]
                slot = _slot(lower[first], upper[first], len(table))
                while table[slot] >= 0:
                    slot = (slot + 1) & (len(table) - 1)
                table[slot] = group
    for group in range(groups):
        sizes[group + 1] += sizes[group]
    for row in range(rows):
        order[sizes[labels[row]]] = row
        sizes[labels[row]] += 1
    return order


@kernel
def _slot(lower, upper, slots):  # type: ignore[no-untyped-def]
    """Return where the table is searched first. Any value is right; a well mixed one is fast."""
    mixed = lower * 0.6180339887498949 + upper * 0.7548776662466927
    part = mixed * 1048576.0
    part -= np.floor(part)
    return int(part * slots) & (slots - 1) if part == part else 0
