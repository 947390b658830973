"""Connected components of boxes: which of them touch, directly or through others."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ial.contractors.angles import wrapped
from ial.contractors.boxes import Boxes
from ial.contractors.intervals.angle import shift_angle
from ial.contractors.intervals.trigonometric import PI_UPPER
from ial.contractors.kernels import kernel

IntArray = npt.NDArray[np.int64]

_LEAF = 8  # boxes that are compared one with another
_BITS = 16  # along each axis, of a place on the curve
_FAR = 1e300


@dataclass(frozen=True, eq=False)
class Clusters:
    """Boxes, divided into connected components.

    Parameters
    ----------
    labels
        The component of each box, int64 of shape (n,); components are numbered by their first box.
    hulls
        A box around each component; along a circular axis it is the shortest arc that covers the component.
    """

    labels: IntArray
    hulls: Boxes

    def __len__(self) -> int:
        return len(self.hulls)

    def __repr__(self) -> str:
        return f"<Clusters: {len(self)} of {len(self.labels)} boxes>"


def cluster(boxes: Boxes, circular: Sequence[int] = ()) -> Clusters:
    """Return the connected components of boxes.

    Two boxes are connected if their closed sets share a point: sharing a corner is enough.

    Parameters
    ----------
    boxes
        Boxes of d dimensions, none of them empty.
    circular
        The axes that are angles in radians, equal modulo 2π; boxes may have any turn. Hulls have the form that `wrapped` gives.

    Raises
    ------
    ValueError
        If a box is empty or has a bound that is NaN, or if there is no such axis.
    """
    boxes = wrapped(boxes, *circular)
    around = np.zeros(boxes.dimension, dtype=np.bool_)
    around[list(circular)] = True
    empty = boxes.empty
    if empty.any():
        raise ValueError(f"box {empty.argmax()} of {len(boxes)} is empty; leave it out")
    if not len(boxes):
        return Clusters(np.empty(0, dtype=np.int64), boxes)
    order = np.argsort(_along_curve(boxes.lower, boxes.upper), kind="stable")
    parents = np.arange(len(boxes))
    _connect(boxes.lower[order], boxes.upper[order], around, parents)
    labels = np.empty(len(boxes), dtype=np.int64)
    shape = (_number(parents, order, labels), boxes.dimension)
    lower, upper = np.full(shape, np.inf), np.full(shape, -np.inf)
    _hulls(boxes.lower, boxes.upper, labels, lower, upper)
    for axis in sorted(set(circular)):
        by_angle = np.lexsort((boxes.lower[:, axis], labels))
        _shortest_arcs(boxes.lower, boxes.upper, axis, labels, by_angle, lower, upper)
    return Clusters(labels, wrapped(Boxes(lower, upper), *circular))


@kernel
def _clamped(x):  # type: ignore[no-untyped-def]
    return min(max(x, -_FAR), _FAR)


@kernel
def _along_curve(lower, upper):  # type: ignore[no-untyped-def]
    """Return where the middle of each box lies on a Z-order curve, along which neighbours are mostly close together."""
    rows, dimension = lower.shape
    used = min(dimension, 63)
    bits = min(_BITS, 63 // used)
    places = np.zeros(rows, dtype=np.int64)
    for axis in range(used):
        first = np.inf
        last = -np.inf
        for i in range(rows):
            middle = 0.5 * _clamped(lower[i, axis]) + 0.5 * _clamped(upper[i, axis])
            first = min(first, middle)
            last = max(last, middle)
        scale = (2**bits - 1) / (last - first) if last > first else 0.0
        for i in range(rows):
            middle = 0.5 * _clamped(lower[i, axis]) + 0.5 * _clamped(upper[i, axis])
            cell = min(int((middle - first) * scale), 2**bits - 1)
            for bit in range(bits):
                places[i] |= ((cell >> bit) & 1) << (bit * used + axis)
    return places


@kernel
def _root(parents, row):  # type: ignore[no-untyped-def]
    while parents[row] != row:
        parents[row] = parents[parents[row]]
        row = parents[row]
    return row


@kernel
def _touch(lower, upper, a, b, around):  # type: ignore[no-untyped-def]
    """Return whether two boxes share a point; where rounding of a turn leaves that open, they do."""
    for axis in range(lower.shape[1]):
        al, au, bl, bu = lower[a, axis], upper[a, axis], lower[b, axis], upper[b, axis]
        if (al > bu) | (bl > au):
            if not around[axis]:
                return False
            ahead_l, ahead_u = shift_angle(al, au, 1.0)
            behind_l, behind_u = shift_angle(al, au, -1.0)
            if (ahead_l > bu or bl > ahead_u) and (behind_l > bu or bl > behind_u):
                return False
    return True


@kernel
def _compare(lower, upper, around, parents, first, last, start, stop):  # type: ignore[no-untyped-def]
    """Connect the boxes of two runs of rows that touch, ``first … last`` and ``start … stop``."""
    for a in range(first, last):
        for b in range(max(start, a + 1), stop):
            one = _root(parents, a)
            other = _root(parents, b)
            if one != other and _touch(lower, upper, a, b, around):
                parents[max(one, other)] = min(one, other)


@kernel
def _is_one(parents, whole, a, b):  # type: ignore[no-untyped-def]
    """Return whether all boxes of two nodes are known to be of one component. `whole` gives a box of a node that is one, or -1."""
    return whole[a] >= 0 and whole[b] >= 0 and _root(parents, whole[a]) == _root(parents, whole[b])


@kernel
def _connect(lower, upper, around, parents):  # type: ignore[no-untyped-def]
    """Join touching boxes.

    Over the boxes, eight to a leaf, stands a binary tree of their hulls; the children of node k are 2k and 2k + 1. From the leaves up, the
    boxes of each node's two children are joined, descending only where the hulls touch and where not all is connected already.
    """
    rows, dimension = lower.shape
    leaves = 1
    while leaves * _LEAF < rows:
        leaves *= 2
    hull_lower = np.full((2 * leaves, dimension), np.inf)
    hull_upper = np.full((2 * leaves, dimension), -np.inf)
    whole = np.full(2 * leaves, -1, dtype=np.int64)
    pairs = np.empty((4 * 64, 2), dtype=np.int64)
    for node in range(2 * leaves - 1, 0, -1):
        if node >= leaves:
            start = min(rows, (node - leaves) * _LEAF)
            stop = min(rows, start + _LEAF)
            _compare(lower, upper, around, parents, start, stop, start, stop)
            one = start < stop
            for row in range(start, stop):
                one = one and _root(parents, row) == _root(parents, start)
                for axis in range(dimension):
                    hull_lower[node, axis] = min(hull_lower[node, axis], lower[row, axis])
                    hull_upper[node, axis] = max(hull_upper[node, axis], upper[row, axis])
            whole[node] = start if one else -1
            continue
        for axis in range(dimension):
            hull_lower[node, axis] = min(hull_lower[2 * node, axis], hull_lower[2 * node + 1, axis])
            hull_upper[node, axis] = max(hull_upper[2 * node, axis], hull_upper[2 * node + 1, axis])
        pairs[0, 0], pairs[0, 1] = 2 * node, 2 * node + 1
        count = 1
        while count > 0:
            count -= 1
            a, b = pairs[count]
            if _is_one(parents, whole, a, b) or not _touch(hull_lower, hull_upper, a, b, around):
                continue
            if a >= leaves:
                first, start = (a - leaves) * _LEAF, (b - leaves) * _LEAF
                _compare(lower, upper, around, parents, first, min(rows, first + _LEAF), start, min(rows, start + _LEAF))
                continue
            for child in range(4):
                pairs[count, 0], pairs[count, 1] = 2 * a + child // 2, 2 * b + child % 2
                count += 1
        whole[node] = whole[2 * node] if _is_one(parents, whole, 2 * node, 2 * node + 1) else -1


@kernel
def _number(parents, order, labels):  # type: ignore[no-untyped-def]
    """Return how many components there are, and number them by their first box. The boxes were joined in another order."""
    rows = len(order)
    places = np.empty(rows, dtype=np.int64)
    for place in range(rows):
        places[order[place]] = place
    numbers = np.full(rows, -1, dtype=np.int64)
    count = 0
    for row in range(rows):
        root = _root(parents, places[row])
        if numbers[root] < 0:
            numbers[root] = count
            count += 1
        labels[row] = numbers[root]
    return count


@kernel
def _hulls(boxes_lower, boxes_upper, labels, lower, upper):  # type: ignore[no-untyped-def]
    for row in range(len(labels)):
        label = labels[row]
        for axis in range(lower.shape[1]):
            lower[label, axis] = min(lower[label, axis], boxes_lower[row, axis])
            upper[label, axis] = max(upper[label, axis], boxes_upper[row, axis])


@kernel
def _shortest_arcs(boxes_lower, boxes_upper, axis, labels, by_angle, lower, upper):  # type: ignore[no-untyped-def]
    """Write the hulls along a circular axis: the circle without the widest gap that no box of the component covers."""
    rows = len(by_angle)
    start = 0
    while start < rows:
        label = labels[by_angle[start]]
        stop = start
        last = -np.inf
        while stop < rows and labels[by_angle[stop]] == label:
            last = max(last, boxes_upper[by_angle[stop], axis])
            stop += 1
        _, reach = shift_angle(last, last, -1.0)  # what is covered up to here, beginning with boxes that cross the cut of the circle
        gap = 0.0
        opens = -PI_UPPER
        closes = PI_UPPER
        for at in range(start, stop):
            row = by_angle[at]
            if boxes_lower[row, axis] - reach > gap:
                gap = boxes_lower[row, axis] - reach
                opens = boxes_lower[row, axis]
                closes = last if at == start else shift_angle(reach, reach, 1.0)[1]
            reach = max(reach, boxes_upper[row, axis])
        lower[label, axis] = opens
        upper[label, axis] = closes
        start = stop
