"""What contraction cuts off a box, as boxes."""

import numpy as np

from ial.contractors.boxes import Boxes
from ial.contractors.kernels import kernel
from ial.contractors.threads import run

_BLOCK = 1 << 10  # rows are counted and written block by block, so that blocks can be shared among threads and keep their order
_SHARED_BLOCKS = 16


@kernel
def _is_empty(lower, upper, i):  # type: ignore[no-untyped-def]
    empty = False
    for axis in range(lower.shape[1]):
        empty |= not lower[i, axis] <= upper[i, axis]
    return empty


@kernel
def _misses(lower, upper, part_lower, part_upper, i):  # type: ignore[no-untyped-def]
    """Return whether a row of parts has no point in the box of the row."""
    empty = False
    for axis in range(lower.shape[1]):
        empty |= not max(lower[i, axis], part_lower[i, axis]) <= min(upper[i, axis], part_upper[i, axis])
    return empty


@kernel
def _count(start, stop, lower, upper, part_lower, part_upper, counts):  # type: ignore[no-untyped-def]
    rows, dimension = lower.shape
    for block in range(start, stop):
        pieces = 0
        for i in range(block * _BLOCK, min(rows, (block + 1) * _BLOCK)):
            if _is_empty(lower, upper, i):
                continue
            if _misses(lower, upper, part_lower, part_upper, i):
                pieces += 1
                continue
            for axis in range(dimension):
                pieces += int(part_lower[i, axis] > lower[i, axis]) + int(part_upper[i, axis] < upper[i, axis])
        counts[block] = pieces


@kernel
def _write(start, stop, lower, upper, part_lower, part_upper, firsts, out_lower, out_upper):  # type: ignore[no-untyped-def]
    rows, dimension = lower.shape
    for block in range(start, stop):
        at = firsts[block]
        for i in range(block * _BLOCK, min(rows, (block + 1) * _BLOCK)):
            if _is_empty(lower, upper, i):
                continue
            if _misses(lower, upper, part_lower, part_upper, i):
                for axis in range(dimension):
                    out_lower[at, axis] = lower[i, axis]
                    out_upper[at, axis] = upper[i, axis]
                at += 1
                continue
            for axis in range(dimension):
                for side in range(2):
                    low = lower[i, axis] if side == 0 else max(lower[i, axis], part_upper[i, axis])
                    high = min(upper[i, axis], part_lower[i, axis]) if side == 0 else upper[i, axis]
                    if not low < high:
                        continue
                    # Along the axes before this one the box has already been cut down to the part.
                    for other in range(dimension):
                        out_lower[at, other] = max(lower[i, other], part_lower[i, other]) if other < axis else lower[i, other]
                        out_upper[at, other] = min(upper[i, other], part_upper[i, other]) if other < axis else upper[i, other]
                    out_lower[at, axis] = low
                    out_upper[at, axis] = high
                    at += 1


def difference(boxes: Boxes, parts: Boxes) -> Boxes:
    """Return closed boxes that cover all of each box but a part of it, and meet the part at most in its faces.

    Parameters
    ----------
    boxes
        n boxes of d dimensions.
    parts
        The part of each box that is left out: an empty one leaves out nothing.

    Returns
    -------
    Boxes
        Up to 2·d boxes a row, in the order of the rows; the interiors of the boxes of one row do not meet. Bounds are those of `boxes` and
        `parts`, so nothing is rounded.

    Raises
    ------
    ValueError
        If the two have different shapes.
    """
    if boxes.lower.shape != parts.lower.shape:
        raise ValueError(f"there are boxes of shape {boxes.lower.shape} and parts of shape {parts.lower.shape}; give one part for each box")
    bounds = (boxes.lower, boxes.upper, parts.lower, parts.upper)
    counts = np.zeros(-(-len(boxes) // _BLOCK), dtype=np.int64)
    run(_count, len(counts), *bounds, counts, minimum=_SHARED_BLOCKS)
    shape = (int(counts.sum()), boxes.dimension)
    pieces = Boxes(np.empty(shape), np.empty(shape))
    run(_write, len(counts), *bounds, counts.cumsum() - counts, pieces.lower, pieces.upper, minimum=_SHARED_BLOCKS)
    return pieces
