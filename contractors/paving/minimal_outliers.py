"""The smallest number of constraints that must be given up for a solution to exist."""

from collections.abc import Callable, Iterable, Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ial.contractors.boxes import Boxes, FloatArray
from ial.contractors.combinators.family import Family, Member, Members, count_of, members_of, several
from ial.contractors.combinators.relaxation import relaxed_intersection
from ial.contractors.contractor import common_dimension, complement, require_dimension
from ial.contractors.paving.bisection import Cells, Division
from ial.contractors.paving.limits import Deadline, Limit
from ial.contractors.paving.search import check_boxes, check_limits, checked_precision
from ial.contractors.paving.waiting import Stack
from ial.contractors.rounding import check_rounding
from ial.contractors.separator import Separator, are_separators

_BATCH = 1 << 10

BoolArray = npt.NDArray[np.bool_]
Satisfied = Callable[[FloatArray], BoolArray]


class MinimalOutliers(NamedTuple):
    """Bounds of the smallest number of constraints that fail at some point.

    Parameters
    ----------
    q_low
        At every point of the searched boxes at least this many constraints fail.
    q_high
        At `witness` at most this many constraints fail: all others are proved to hold there.
    witness
        The point, float64 of shape (d,).
    limited
        What stopped the search early: "" (nothing), "boxes" or "time". The two bounds hold all the same.
    nodes
        How many boxes were contracted.
    """

    q_low: int
    q_high: int
    witness: FloatArray
    limited: Limit
    nodes: int


def minimal_outliers(
    constraints: Iterable[Separator] | Members,
    boxes: Boxes,
    precision: npt.ArrayLike,
    *,
    satisfied: Satisfied | None = None,
    max_boxes: int = 1_000_000,
    max_seconds: float | None = None,
) -> MinimalOutliers:
    """Return bounds of the smallest q for which all of several constraints but q hold at some point of `boxes`.

    The search branches and bounds on the number of outliers. The number of outer contractors that empty a box is a lower bound of how many
    constraints fail at any of its points; boxes with the smallest bound come first. The middle of each box is tried: the number of
    constraints that are not proved to hold there is an upper bound. Boxes are narrowed to what could do better than the best point so far,
    by the relaxed intersection, and bisected. The two bounds are equal if the search finds a point as good as proved possible before boxes
    become smaller than the precision.

    Parameters
    ----------
    constraints
        m constraints of dimension d, m >= 1: separators; or contractors that know their complement; or, with `satisfied`, any contractors
        and families. That a constraint holds at a point is proved by the inner part of a separator, which empties the point.
    boxes
        Where to search; at least one is not empty.
    precision
        Boxes no wider than this are not bisected: one number, or shape (d,).
    satisfied
        For n points, float64 of shape (n, d), which constraints hold there, bool of shape (n, m). It must be true only where it is certain,
        rounding included.
    max_boxes
        Boxes are given up, undecided, where more than this many would wait.
    max_seconds
        A limit on time; None for none. A search that reaches it is not reproducible.

    Returns
    -------
    MinimalOutliers
        q_low, q_high, a witness of q_high, what limited the search, and the number of nodes.

    Raises
    ------
    TypeError
        If a constraint is neither a separator nor a contractor that knows its complement, and `satisfied` is not given.
    ValueError
        If all boxes are empty, or if an argument cannot be used.

    References
    ----------
    Jaulin, Kieffer, Walter, Meizel: Guaranteed robust nonlinear estimation with application to robot localization, IEEE Transactions on
    Systems, Man, and Cybernetics C 32 (2002), which raises q from 0 until the relaxed problem has a solution. Jaulin: Robust set-membership
    state estimation, Automatica 45 (2009).
    """
    check_rounding()
    outer, proved = _outer_and_proof(several(constraints), satisfied)
    dimension = common_dimension(outer)
    require_dimension(outer[0], boxes)
    check_boxes(boxes)
    check_limits(max_boxes=max_boxes, max_seconds=max_seconds)
    widths = checked_precision(precision, dimension)
    boxes = boxes[~boxes.empty]
    if not len(boxes):
        raise ValueError("all boxes to search are empty, so there is no point at which to count; give at least one that is not")
    witness = boxes[:1].midpoint()[0]
    q_high = sum(map(count_of, outer))
    undecided = q_high  # the smallest bound of a box that is not bisected any more
    waiting = [Stack(_BATCH) for _ in range(q_high)]  # boxes at whose points at least 0, 1, 2, … constraints fail
    waiting[0].push(Cells.uncut(boxes))
    deadline = Deadline(max_seconds)
    limited: Limit = ""
    nodes = 0
    while (q := _lowest(waiting)) < q_high:
        cells = waiting[q].pop()
        rows = deadline.portion(len(cells.boxes))
        waiting[q].push(cells.part(rows, len(cells.boxes)))
        if not rows:
            limited = "time"
            break
        nodes += rows
        cells = cells.part(0, rows)
        lower, upper = _contracted(outer, cells.boxes)
        fails = np.maximum(np.count_nonzero((lower > upper).any(axis=2), axis=1), q)
        narrowed = relaxed_intersection(lower, upper, q_high - 1)
        left = np.flatnonzero(~narrowed.empty)
        if len(left):
            points = narrowed[left].midpoint()
            counts = len(waiting) - np.count_nonzero(_checked(proved(points), len(points), len(waiting)), axis=1)
            if counts.min() < q_high:
                q_high, witness = int(counts.min()), points[counts.argmin()]
        left = left[fails[left] < q_high]
        # A box that is small only now has been counted while it was larger: it is counted once more.
        settled = Division(cells, widths, "largest").axes < 0
        for fewest in np.unique(fails[left]):
            chosen = left[fails[left] == fewest]
            division = Division(Cells(narrowed[chosen], cells.last[chosen]), widths, "largest")
            again = ~settled[chosen][division.axes < 0]
            if sum(map(len, waiting)) + 2 * division.cut + np.count_nonzero(again) > max_boxes:
                limited = "boxes"
                undecided = min(undecided, int(fewest))
                continue
            if not again.all():
                undecided = min(undecided, int(fewest))
            finished, halves = division.carry_out()
            waiting[fewest].push(halves)
            waiting[fewest].push(Cells.uncut(finished[again]))
        deadline.worked(rows)
    return MinimalOutliers(min(q_high, undecided, _lowest(waiting)), q_high, witness, limited, nodes)


def _lowest(waiting: Sequence[Stack]) -> int:
    """Return the smallest bound of a box that waits; as many as there are constraints, if none does."""
    return next((q for q, stack in enumerate(waiting) if len(stack)), len(waiting))


def _checked(holds: BoolArray, points: int, count: int) -> BoolArray:
    holds = np.asarray(holds)
    if holds.shape != (points, count) or holds.dtype != np.bool_:
        raise ValueError(f"`satisfied` gave {holds.dtype} of shape {holds.shape} for {points} points; give bool of shape {(points, count)}")
    return holds


def _contracted(members: Sequence[Member], boxes: Boxes) -> tuple[FloatArray, FloatArray]:
    """Return what each of m constraints leaves of n boxes, two arrays of shape (n, m, d)."""
    parts = []
    for member in members:
        if isinstance(member, Family):
            parts.append(member.contract_each(boxes))
        else:
            part = member.contract(boxes)
            parts.append((part.lower[:, None], part.upper[:, None]))
    lower, upper = np.concatenate([lower for lower, _ in parts], axis=1), np.concatenate([upper for _, upper in parts], axis=1)
    if np.isnan(lower).any() or np.isnan(upper).any():
        raise ValueError("a contractor returned a bound that is NaN; it returns numbers, or (inf, -inf) for an empty box")
    return lower, upper


def _outer_and_proof(members: Sequence[object], satisfied: Satisfied | None) -> tuple[tuple[Member, ...], Satisfied]:
    """Return contractors of the constraints, and the test that proves which constraints hold at points."""
    outer: tuple[Member, ...]
    inner: tuple[Member, ...]
    if are_separators(members):
        outer, inner = tuple(each.outer for each in members), tuple(each.inner for each in members)
    else:
        outer = members_of(members)
        inner = () if satisfied else tuple(complement(member) for member in outer)

    def emptied(points: FloatArray) -> BoolArray:
        lower, upper = _contracted(inner, Boxes(points, points))
        return np.asarray((lower > upper).any(axis=2))

    return outer, satisfied or emptied
