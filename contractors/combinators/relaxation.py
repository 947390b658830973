"""Relaxed intersection: the points that satisfy all of several constraints but at most q."""

import operator

import numpy as np

from ial.contractors.boxes import Boxes, FloatArray
from ial.contractors.checked_contractor import CheckedContractor
from ial.contractors.combinators.exact_relaxation import intersect_exactly, require_affordable
from ial.contractors.combinators.family import Family, Member, count_of, members_of
from ial.contractors.combinators.rows import PAYS
from ial.contractors.combinators.trivial_sets import EmptySet
from ial.contractors.contractor import Contractor, common_dimension, complement
from ial.contractors.kernels import kernel
from ial.contractors.space import common_space
from ial.contractors.threads import run

_NUMBERS = 1 << 22  # how many bounds of parts are held at once: 32 MB for each of lower and upper


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
def _hull_of_covered(openings, closings, needed):  # type: ignore[no-untyped-def]
    """Return the same for bounds in any order, which are sorted in place. All intervals, or any one of them, take no sorting."""
    if needed == len(openings):
        lower, upper = openings.max(), closings.min()
        return (lower, upper) if lower <= upper else (np.inf, -np.inf)
    if needed == 1:
        return openings.min(), closings.max()
    openings.sort()
    closings.sort()
    return covered(openings, closings, needed)


@kernel
def _intersect_relaxed(start, stop, lower, upper, needed, out_lower, out_upper):  # type: ignore[no-untyped-def]
    """Write the relaxed intersection, axis by axis, of the m boxes of each row. A box that is empty in one axis counts in none."""
    count, dimension = lower.shape[1:]
    openings, closings = np.empty((dimension, count)), np.empty((dimension, count))
    for i in range(start, stop):
        kept = 0
        for j in range(count):
            here = True
            for axis in range(dimension):
                openings[axis, kept], closings[axis, kept] = lower[i, j, axis], upper[i, j, axis]
                here &= lower[i, j, axis] <= upper[i, j, axis]
            kept += here
        empty = kept < needed
        for axis in range(dimension):
            if not empty:
                out_lower[i, axis], out_upper[i, axis] = _hull_of_covered(openings[axis, :kept], closings[axis, :kept], needed)
                empty = out_lower[i, axis] > out_upper[i, axis]
        if empty:
            out_lower[i] = np.inf
            out_upper[i] = -np.inf


@kernel
def _store(rows, part_lower, part_upper, first, lower, upper, failed):  # type: ignore[no-untyped-def]
    """Copy the parts of box i to row ``rows[i]``, from part `first` on, and count those that are empty."""
    for i in range(len(rows)):
        for j in range(part_lower.shape[1]):
            empty = False
            for axis in range(part_lower.shape[2]):
                lower[rows[i], first + j, axis] = part_lower[i, j, axis]
                upper[rows[i], first + j, axis] = part_upper[i, j, axis]
                empty |= not part_lower[i, j, axis] <= part_upper[i, j, axis]
            failed[i] += empty


def relaxed_intersection(lower: FloatArray, upper: FloatArray, outliers: int, *, exact: bool = False) -> Boxes:
    """Return boxes that contain every point of at least m − `outliers` of the m boxes of a row.

    By default each axis is handled by itself, by sorting the bounds: a row becomes the box of the hulls, per axis, of the numbers that at
    least m − `outliers` of the intervals cover, and empty if there is no such number in some axis. In one dimension, and for `outliers` = 0
    or m − 1, that is the hull of the points in question; otherwise it may be larger, since other boxes may cover on each axis.

    `exact` gives that hull in d dimensions. It looks for a point of enough boxes on each side, axis by axis, and may take up to
    2·d·m^(d+1) comparisons a row, although far fewer are needed where few boxes overlap or few may fail.

    An empty box counts as one that failed. With `outliers` >= m nothing is required and each row is the whole space.

    Parameters
    ----------
    lower, upper
        Bounds of m boxes of d dimensions in each of n rows, float64 of shape (n, m, d).
    outliers
        The number of boxes that a point may lie outside of, q >= 0.
    exact
        Whether to return the hull of the points, rather than a box around it.

    Raises
    ------
    ValueError
        If the shapes do not fit, `outliers` is negative, or the exact hull could take too long.

    References
    ----------
    Jaulin: Robust set-membership state estimation; application to underwater robotics, Automatica 45 (2009).
    """
    if lower.ndim != 3 or lower.shape != upper.shape:
        raise ValueError(f"bounds have shapes {lower.shape} and {upper.shape}; both must be (n, m, d)")
    outliers = _checked(outliers)
    rows, count, dimension = lower.shape
    enclosure = Boxes(np.full((rows, dimension), -np.inf), np.full((rows, dimension), np.inf))
    if outliers < count:
        run(_intersect_relaxed, rows, lower, upper, count - outliers, enclosure.lower, enclosure.upper)
        if exact and _differs(count, dimension, outliers):
            require_affordable(count, dimension)
            run(intersect_exactly, rows, lower, upper, count - outliers, enclosure.lower, enclosure.upper, minimum=8)
    return enclosure


def _checked(outliers: int) -> int:
    if operator.index(outliers) < 0:
        raise ValueError(f"the number of outliers is {outliers}; give at least 0")
    return operator.index(outliers)


def _differs(count: int, dimension: int, outliers: int) -> bool:
    """Return whether the exact hull may differ from that of each axis by itself."""
    return dimension > 1 and 0 < outliers < count - 1


class Relaxed(CheckedContractor):
    """All of several constraints but at most q: the relaxed intersection of what the contractors leave of each box. See `relaxed`.

    Parameters
    ----------
    contractors
        At least one contractor or family, all of one dimension.
    outliers
        The number of constraints that may fail, q >= 0; with q >= the number of constraints a box is returned unchanged.
    exact
        Whether to take the exact hull in d dimensions; see `relaxed_intersection`.

    Raises
    ------
    ValueError
        If the dimensions differ, `outliers` is negative, or the exact hull could take too long.
    """

    def __init__(self, *contractors: Member, outliers: int, exact: bool = False) -> None:
        self.contractors = members_of(contractors)
        self.dimension = common_dimension(self.contractors)
        self.space = common_space(self.contractors)
        self.count = sum(count_of(member) for member in self.contractors)
        self.outliers = _checked(outliers)
        self.exact = exact
        if exact and _differs(self.count, self.dimension, outliers):
            require_affordable(self.count, self.dimension)

    def __repr__(self) -> str:
        return f"relaxed([{', '.join(map(repr, self.contractors))}], outliers={self.outliers})"

    def complement(self) -> Contractor:
        """Return the points at which more than `outliers` of the constraints fail.

        Raises
        ------
        TypeError
            If the complement of a member is not known.
        """
        if self.outliers >= self.count:
            return EmptySet(self.dimension)
        return Relaxed(*map(complement, self.contractors), outliers=self.count - self.outliers - 1, exact=self.exact)

    def _narrow(self, boxes: Boxes) -> Boxes:
        if self.outliers >= self.count:
            return boxes
        rows = max(1, _NUMBERS // (self.count * self.dimension))
        parts = [self._narrow_part(boxes[start : start + rows]) for start in range(0, len(boxes), rows)]
        return parts[0] if len(parts) == 1 else Boxes.concatenate([Boxes.none(self.dimension), *parts])

    def _narrow_part(self, boxes: Boxes) -> Boxes:
        lower = np.full((len(boxes), self.count, self.dimension), np.inf)
        upper = np.full(lower.shape, -np.inf)
        rows = np.arange(len(boxes))  # those at which at most `outliers` constraints have failed; for the others nothing more is asked
        failed = np.zeros(len(boxes), dtype=np.int64)
        first = 0
        for member in self.contractors:
            if not len(rows):
                break
            _store(rows, *_each(member, boxes), first, lower, upper, failed)
            going = np.flatnonzero(failed <= self.outliers)
            if len(going) <= PAYS * len(rows):
                rows, boxes, failed = rows[going], boxes[going], failed[going]
            first += count_of(member)
        return relaxed_intersection(lower, upper, self.outliers, exact=self.exact)


def _each(member: Member, boxes: Boxes) -> tuple[FloatArray, FloatArray]:
    """Return what the contractors of a member leave, two arrays of shape (n, count, d)."""
    if isinstance(member, Family):
        lower, upper = member.contract_each(boxes)
        shape = len(boxes), member.count, boxes.dimension
        if lower.shape != shape or upper.shape != shape:
            raise ValueError(f"{type(member).__name__}.contract_each returned shapes {lower.shape} and {upper.shape}; both must be {shape}")
        return lower, upper
    part = member.contract(boxes)
    return part.lower[:, None], part.upper[:, None]
