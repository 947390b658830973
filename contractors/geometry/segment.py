"""Straight segments: the contractors `Segment` and `Segments`, of any dimension."""

import numpy as np
import numpy.typing as npt

from ial.contractors.boxes import FloatArray
from ial.contractors.geometry.box_tree import BoxTree, following
from ial.contractors.intervals.arithmetic import add, mul, sub
from ial.contractors.intervals.reverse import mul_reverse
from ial.contractors.intervals.sets import hull, intersect
from ial.contractors.kernels import kernel
from ial.contractors.row_contractor import RowContractor
from ial.contractors.threads import run

_LARGEST_DIMENSION = 31


@kernel
def _contract_segment(start, end, low, high, part_low, part_high):  # type: ignore[no-untyped-def]
    """Write the hull of the part of a segment in a box, and return whether there is one.

    Points of the segment are start + t·(end − start) with t in [0, 1]. Each axis allows an interval of t; what all allow gives, exactly
    but for rounding, what is left of each axis.
    """
    tl, tu = 0.0, 1.0
    for axis in range(len(low)):
        p, q = start[axis], end[axis]
        tl, tu = mul_reverse(*sub(q, q, p, p), *sub(low[axis], high[axis], p, p), tl, tu)
    possible = tl <= tu
    for axis in range(len(low)):
        p, q = start[axis], end[axis]
        xl, xu = intersect(low[axis], high[axis], min(p, q), max(p, q))
        xl, xu = intersect(xl, xu, *add(p, p, *mul(tl, tu, *sub(q, q, p, p))))
        part_low[axis], part_high[axis] = xl, xu
        possible = possible and xl <= xu
    return possible


@kernel
def widen(hull_low, hull_high, low, high):  # type: ignore[no-untyped-def]
    """Widen a box by another one, in place."""
    for axis in range(len(low)):
        hull_low[axis], hull_high[axis] = hull(hull_low[axis], hull_high[axis], low[axis], high[axis])


@kernel
def contract_segments(low, high, tree_lower, tree_upper, starts, ends, hull_low, hull_high, part_low, part_high):  # type: ignore[no-untyped-def]
    """Write the hull of the parts of segments in a box. The last two arguments are room to work in."""
    leaves = len(tree_lower) >> 1
    hull_low[:] = np.inf
    hull_high[:] = -np.inf
    node = 1
    while True:
        apart, inside, known = False, True, True
        for axis in range(len(low)):
            below, above = tree_lower[node, axis], tree_upper[node, axis]
            xl, xu = max(low[axis], below), min(high[axis], above)
            apart |= not xl <= xu
            inside &= (low[axis] <= below) & (above <= high[axis])
            known &= (hull_low[axis] <= xl) & (xu <= hull_high[axis])
        descend = False
        if not (apart or known):
            if inside:
                widen(hull_low, hull_high, tree_lower[node], tree_upper[node])
            elif node < leaves:
                descend = True
            elif _contract_segment(starts[node - leaves], ends[node - leaves], low, high, part_low, part_high):
                widen(hull_low, hull_high, part_low, part_high)
        node = 2 * node if descend else following(node)
        if node == 1:
            break


@kernel
def _contract_rows(start, stop, tree_lower, tree_upper, starts, ends, lower, upper):  # type: ignore[no-untyped-def]
    """Narrow rows in place."""
    low, high = np.empty(lower.shape[1]), np.empty(lower.shape[1])
    part_low, part_high = np.empty(lower.shape[1]), np.empty(lower.shape[1])
    for i in range(start, stop):
        low[:] = lower[i]
        high[:] = upper[i]
        contract_segments(low, high, tree_lower, tree_upper, starts, ends, lower[i], upper[i], part_low, part_high)


def checked_points(points: npt.ArrayLike, name: str) -> FloatArray:
    """Return points as an array of shape (m, d), m >= 1.

    Raises
    ------
    ValueError
        If they are not finite numbers in such an array.
    """
    array = np.array(points, dtype=np.float64, ndmin=2)
    if array.ndim != 2 or not len(array) or not 1 <= array.shape[1] <= _LARGEST_DIMENSION:
        raise ValueError(
            f"the {name} are an array of shape {array.shape}; give (m, d): m >= 1 points of 1 to {_LARGEST_DIMENSION} coordinates each"
        )
    if not np.isfinite(array).all():
        first = int(np.flatnonzero(~np.isfinite(array).all(axis=1))[0])
        raise ValueError(f"row {first} of the {name} is {array[first].tolist()}; give finite coordinates")
    return array


class Segments(RowContractor):
    """The contractor of "this point lies on one of m closed segments": boxes shrink to the hull of their part of the segments.

    Coordinates are taken as the exact numbers they are. The hull is the smallest but for the rounding of a few operations; a point of a
    slanting segment is in general no double, and a box is kept where it might hold one. A segment may be a single point. Segments far from
    a box cost nothing: they are kept in a tree of boxes.

    Parameters
    ----------
    starts, ends
        The end points of each segment, shape (m, d).

    Raises
    ------
    ValueError
        If the points are not finite numbers in two such arrays of the same shape.
    """

    def __init__(self, starts: npt.ArrayLike, ends: npt.ArrayLike) -> None:
        begin, end = checked_points(starts, "starts of the segments"), checked_points(ends, "ends of the segments")
        if begin.shape != end.shape:
            raise ValueError(f"the starts and ends of the segments have shapes {begin.shape} and {end.shape}; give one end for each start")
        self.dimension = begin.shape[1]
        self.tree = BoxTree(np.minimum(begin, end), np.maximum(begin, end))
        self.starts, self.ends = begin[self.tree.order], end[self.tree.order]

    def __repr__(self) -> str:
        return f"<{type(self).__name__}: {len(self.starts)} in {self.dimension} dimensions>"

    def _narrow_rows(self, lower: FloatArray, upper: FloatArray) -> None:
        run(_contract_rows, len(lower), self.tree.lower, self.tree.upper, self.starts, self.ends, lower, upper)


class Segment(Segments):
    """The contractor of "this point lies on the closed segment from start to end".

    Parameters
    ----------
    start, end
        The end points, d coordinates each.

    Raises
    ------
    ValueError
        If they are not two points of the same dimension with finite coordinates.
    """

    def __init__(self, start: npt.ArrayLike, end: npt.ArrayLike) -> None:
        super().__init__(start, end)
        if len(self.starts) != 1:
            raise ValueError(f"{len(self.starts)} points are given as one end of a segment; use Segments for several segments")
