"""Constraint propagation: each constraint is applied again as soon as another one has narrowed a variable that it depends on."""

import numpy as np
import numpy.typing as npt

from ial.contractors.boxes import Boxes
from ial.contractors.checked_contractor import CheckedContractor
from ial.contractors.combinators.combination import Intersection, Union
from ial.contractors.combinators.family import Family, Member, members_of
from ial.contractors.combinators.fixed_point import check_rounds
from ial.contractors.combinators.relaxation import Relaxed
from ial.contractors.contractor import common_dimension
from ial.contractors.expressions.constraint import Constraint, ConstraintFamily
from ial.contractors.expressions.mean_value import MeanValue, repeats


class Propagation(CheckedContractor):
    """All of several constraints, applied in turn until none of them narrows a side by much.

    Every box has its own queue. At first all constraints stand in it. Rounds go through the constraints in the order given and apply those
    that stand in the queue; one that narrows a side by more than `ratio` puts those into it that depend on this side, among them itself, if
    applying it twice may pay. The order is fixed, so the result depends on nothing else.

    Parameters
    ----------
    contractors
        At least one contractor or family, all of one dimension. An attribute `axes`, if there is one, says which sides a constraint depends
        on; otherwise it depends on all. It decides only what is tried again.
    ratio
        A side counts as narrowed if it lost more than this share of its width, 0 <= ratio < 1, or became bounded; of a half-bounded one
        the bound must move by more than this share of its absolute value. With 0 every change counts.
    max_rounds
        How many rounds there are at most, at least 1. Slow sequences, such as x = y with x = 0.999·y, and endless ones, such as x = y with
        x = y + 1, end with them or with the ratio.

    Raises
    ------
    TypeError
        If something is not a contractor.
    ValueError
        If the dimensions differ, or `ratio` or `max_rounds` is out of range.

    References
    ----------
    Mackworth: Consistency in networks of relations, Artificial Intelligence 8 (1977), algorithm AC-3. Davis: Constraint propagation with
    interval labels, Artificial Intelligence 32 (1987).
    """

    def __init__(self, *contractors: Member, ratio: float = 0.1, max_rounds: int = 100) -> None:
        check_rounds(ratio, max_rounds)
        members = members_of(contractors)
        self.dimension = common_dimension(members)
        self.ratio = ratio
        self.max_rounds = max_rounds
        self.contractors = tuple(Relaxed(member, outliers=0) if isinstance(member, Family) else member for member in members)
        depends = np.zeros((self.dimension, len(members)), dtype=np.bool_)
        for at, member in enumerate(members):
            depends[list(axes_of(member)), at] = True
        self._affected = []
        for at, member in enumerate(members):
            others = depends.copy()
            others[:, at] &= not _is_idempotent(member)
            self._affected.append(others)

    def _narrow(self, boxes: Boxes) -> Boxes:
        narrowed = Boxes(boxes.lower.copy(), boxes.upper.copy())
        queued = np.repeat(~boxes.empty[:, None], len(self.contractors), axis=1)
        for _ in range(self.max_rounds):
            if not queued.any():
                break
            for at, contractor in enumerate(self.contractors):
                rows = np.flatnonzero(queued[:, at])
                if not len(rows):
                    continue
                before = narrowed[rows]
                after = contractor.contract(before)
                narrowed.lower[rows], narrowed.upper[rows] = after.lower, after.upper
                queued[rows, at] = False
                queued[rows] |= _narrowed(before, after, self.ratio) @ self._affected[at]
                queued[rows[after.empty]] = False
        return narrowed


def axes_of(member: Member) -> set[int]:
    """Return the sides of a box that a constraint depends on, as far as that is known, otherwise all."""
    if isinstance(member, MeanValue):
        return axes_of(member.constraint)
    if isinstance(member, Intersection | Union | Relaxed):
        return set().union(*map(axes_of, member.contractors))
    return set(getattr(member, "axes", range(member.dimension)))


def _is_idempotent(member: Member) -> bool:
    """Return whether applying a constraint twice brings nothing: forward and backward through a formula in which no variable repeats."""
    if not isinstance(member, Constraint) or isinstance(member, ConstraintFamily):
        return False
    return not repeats([expression for expression, _ in member.relations])


def _narrowed(before: Boxes, after: Boxes, ratio: float) -> npt.NDArray[np.bool_]:
    """Return which sides became smaller by more than `ratio`, shape (n, d)."""
    with np.errstate(invalid="ignore", over="ignore"):
        moved_up, moved_down = after.lower - before.lower, before.upper - after.upper  # NaN where a side has stayed unbounded
        width = before.upper - before.lower
        lost = np.nan_to_num(moved_up, nan=0.0, posinf=np.inf) + np.nan_to_num(moved_down, nan=0.0, posinf=np.inf)
        least = np.minimum(np.abs(before.lower), np.abs(before.upper))  # of a half-bounded side, the bound
        return np.asarray(lost > ratio * np.where(np.isfinite(width), width, np.where(np.isfinite(least), least, 0.0))) & (lost > 0.0)
