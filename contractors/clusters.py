"""Connected components of boxes: which of them touch, directly or through others."""

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ial.contractors.boxes import Boxes
from ial.contractors.elementary import PI_UPPER, TWO_PI_LOWER, TWO_PI_UPPER
from ial.contractors.kernels import kernel
from ial.contractors.rounding import check_rounding, down, up

IntArray = npt.NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Clusters:
    """Poses (x, y, θ) in boxes, divided into connected components.

    Parameters
    ----------
    labels
        The component of each box, int64 of shape (n,); components are numbered by their first box.
    hulls
        A box around each component; its heading is the shortest arc that covers the component.
    """

    labels: IntArray
    hulls: Boxes

    def __len__(self) -> int:
        return len(self.hulls)


def cluster(boxes: Boxes) -> Clusters:
    """Return the connected components of boxes of poses.

    Two boxes are connected if their closed sets share a point, with headings on the circle: sharing a corner is enough.

    Parameters
    ----------
    boxes
        Boxes (x, y, θ), none of them empty, with headings as `wrap_angle` writes them.
    """
    check_rounding()
    if not len(boxes):
        return Clusters(np.empty(0, dtype=np.int64), boxes)
    widest = boxes.width().max(axis=0) * (1.0 + 1e-9) + 1e-12
    turns = max(1, math.floor(2.0 * math.pi / widest[2]))
    cells = np.floor((boxes.lower - boxes.lower.min(axis=0)) / widest).astype(np.int64)
    cells[:, 2] = np.floor((boxes.lower[:, 2] + math.pi) * (turns / (2.0 * math.pi))).astype(np.int64) % turns
    order = np.lexsort((cells[:, 2], cells[:, 1], cells[:, 0]))
    parents = np.arange(len(boxes))
    _connect(boxes.lower, boxes.upper, cells, order, turns, parents)
    labels = np.empty(len(boxes), dtype=np.int64)
    count = _number(parents, labels)
    lower, upper = np.full((count, 3), np.inf), np.full((count, 3), -np.inf)
    by_heading = np.lexsort((boxes.lower[:, 2], labels))
    _hulls(boxes.lower, boxes.upper, labels, by_heading, lower, upper)
    return Clusters(labels, Boxes(lower, upper))


@kernel
def _root(parents, row):  # type: ignore[no-untyped-def]
    while parents[row] != row:
        parents[row] = parents[parents[row]]
        row = parents[row]
    return row


@kernel
def _touch(lower, upper, a, b):  # type: ignore[no-untyped-def]
    """Return whether two boxes share a point; where rounding of a turn leaves that open, they do."""
    for axis in range(2):
        if lower[a, axis] > upper[b, axis] or lower[b, axis] > upper[a, axis]:
            return False
    if lower[a, 2] <= upper[b, 2] and lower[b, 2] <= upper[a, 2]:
        return True
    if down(lower[a, 2] + TWO_PI_LOWER) <= upper[b, 2] and lower[b, 2] <= up(upper[a, 2] + TWO_PI_UPPER):
        return True
    return down(lower[b, 2] + TWO_PI_LOWER) <= upper[a, 2] and lower[a, 2] <= up(upper[b, 2] + TWO_PI_UPPER)


@kernel
def _first(cells, order, x, y, turn):  # type: ignore[no-untyped-def]
    """Return the first place in `order` whose cell is not before (x, y, turn)."""
    low, high = 0, len(order)
    while low < high:
        middle = (low + high) // 2
        row = order[middle]
        before = cells[row, 0] < x or (cells[row, 0] == x and (cells[row, 1] < y or (cells[row, 1] == y and cells[row, 2] < turn)))
        if before:
            low = middle + 1
        else:
            high = middle
    return low


@kernel
def _connect(lower, upper, cells, order, turns, parents):  # type: ignore[no-untyped-def]
    """Join touching boxes. A box is at most as wide as a cell, so those that touch start in the same cell or in neighbours."""
    rows = len(order)
    start = 0
    while start < rows:
        here = order[start]
        stop = start
        while stop < rows and (cells[order[stop]] == cells[here]).all():
            stop += 1
        for dx in range(-1, 2):
            for dy in range(-1, 2):
                for dturn in range(-1, 2):
                    x = cells[here, 0] + dx
                    y = cells[here, 1] + dy
                    turn = (cells[here, 2] + dturn) % turns
                    at = _first(cells, order, x, y, turn)
                    while at < rows:
                        other = order[at]
                        if cells[other, 0] != x or cells[other, 1] != y or cells[other, 2] != turn:
                            break
                        for k in range(start, stop):
                            row = order[k]
                            if row < other:
                                a = _root(parents, row)
                                b = _root(parents, other)
                                if a != b and _touch(lower, upper, row, other):
                                    parents[max(a, b)] = min(a, b)
                        at += 1
        start = stop


@kernel
def _number(parents, labels):  # type: ignore[no-untyped-def]
    count = 0
    for row in range(len(parents)):
        root = _root(parents, row)
        if root == row:
            labels[row] = count
            count += 1
        else:
            labels[row] = labels[root]
    return count


@kernel
def _hulls(boxes_lower, boxes_upper, labels, by_heading, lower, upper):  # type: ignore[no-untyped-def]
    """Fill the hulls. The heading of a hull is the circle without the widest gap that no box of the component covers."""
    rows = len(by_heading)
    start = 0
    while start < rows:
        label = labels[by_heading[start]]
        stop = start
        last = -np.inf
        while stop < rows and labels[by_heading[stop]] == label:
            row = by_heading[stop]
            for axis in range(2):
                lower[label, axis] = min(lower[label, axis], boxes_lower[row, axis])
                upper[label, axis] = max(upper[label, axis], boxes_upper[row, axis])
            last = max(last, boxes_upper[row, 2])
            stop += 1
        reach = up(last - TWO_PI_LOWER)  # what is covered up to here, beginning with boxes that cross the cut of the circle
        gap = 0.0
        opens = -PI_UPPER
        closes = PI_UPPER
        for at in range(start, stop):
            row = by_heading[at]
            if boxes_lower[row, 2] - reach > gap:
                gap = boxes_lower[row, 2] - reach
                opens = boxes_lower[row, 2]
                closes = last if at == start else up(reach + TWO_PI_UPPER)
            reach = max(reach, boxes_upper[row, 2])
        lower[label, 2] = opens
        upper[label, 2] = closes
        start = stop
