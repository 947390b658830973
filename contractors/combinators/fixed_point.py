"""The fixed point: a contractor repeated while it pays."""

from typing import overload

from ial.contractors.boxes import Boxes
from ial.contractors.checked_contractor import CheckedContractor
from ial.contractors.combinators.rows import occupied
from ial.contractors.contractor import Contractor, ContractorLike, complement
from ial.contractors.kernels import kernel
from ial.contractors.separator import Separator
from ial.contractors.space import common_space


@kernel
def _shrunk(before_lower, before_upper, lower, upper, ratio):  # type: ignore[no-untyped-def]
    """Return the rows, not empty, of which some side became shorter by more than `ratio`, or bounded where it was not."""
    indices = occupied(lower, upper)
    count = 0
    for i in indices:
        much = False
        for axis in range(lower.shape[1]):
            # Half a width does not overflow.
            before = 0.5 * before_upper[i, axis] - 0.5 * before_lower[i, axis]
            after = 0.5 * upper[i, axis] - 0.5 * lower[i, axis]
            bounded = ((before_lower[i, axis] == -float("inf")) & (lower[i, axis] > -float("inf"))) | (
                (before_upper[i, axis] == float("inf")) & (upper[i, axis] < float("inf"))
            )
            much |= (before < float("inf")) & (after < (1.0 - ratio) * before) | bounded
        indices[count] = i
        count += much
    return indices[:count]


class FixedPoint(CheckedContractor):
    """A contractor, repeated on each row while some side of it shrinks by more than `ratio`. See `fixpoint`.

    Parameters
    ----------
    contractor
        What is repeated.
    ratio
        Below which relative change of every side a row is left alone, 0 <= ratio < 1.
    max_rounds
        How often the contractor is applied at most, at least 1.

    Raises
    ------
    ValueError
        If `ratio` or `max_rounds` is out of range.
    """

    def __init__(self, contractor: ContractorLike, ratio: float = 0.05, max_rounds: int = 100) -> None:
        check_rounds(ratio, max_rounds)
        self.dimension = contractor.dimension
        self.space = common_space([contractor])
        self.contractor = contractor
        self.ratio = ratio
        self.max_rounds = max_rounds

    def complement(self) -> Contractor:
        """Return the complement of the contractor, repeated in the same way.

        Raises
        ------
        TypeError
            If it is not known.
        """
        return FixedPoint(complement(self.contractor), self.ratio, self.max_rounds)

    def _narrow(self, boxes: Boxes) -> Boxes:
        rest = self.contractor.contract(boxes)
        narrowed = Boxes(rest.lower.copy(), rest.upper.copy())
        rows = _shrunk(boxes.lower, boxes.upper, rest.lower, rest.upper, self.ratio)
        for _ in range(1, self.max_rounds):
            if not len(rows):
                break
            before = narrowed[rows]
            rest = self.contractor.contract(before)
            narrowed.lower[rows], narrowed.upper[rows] = rest.lower, rest.upper
            rows = rows[_shrunk(before.lower, before.upper, rest.lower, rest.upper, self.ratio)]
        return narrowed


def check_rounds(ratio: float, max_rounds: int) -> None:
    """Raise unless rounds can end so.

    Raises
    ------
    ValueError
        Unless 0 <= `ratio` < 1 and `max_rounds` is at least 1.
    """
    if not 0.0 <= ratio < 1.0:
        raise ValueError(f"the ratio is {ratio}; give a number from 0 to less than 1")
    if max_rounds < 1:
        raise ValueError(f"the number of rounds is {max_rounds}; give at least 1")


@overload
def fixpoint(contractor: Separator, ratio: float = ..., max_rounds: int = ...) -> Separator: ...
@overload
def fixpoint(contractor: ContractorLike, ratio: float = ..., max_rounds: int = ...) -> Contractor: ...
def fixpoint(contractor: Separator | ContractorLike, ratio: float = 0.05, max_rounds: int = 100) -> Contractor | Separator:
    """Return a contractor that repeats another one while it pays.

    Each row is narrowed again as long as the last round made some side shorter by more than `ratio`, or bounded one that was not. A side
    that stays unbounded does not count: a bound may move for ever on it. The set of solutions is unchanged, and so is the guarantee.

    Parameters
    ----------
    contractor
        A contractor, or a separator: its two contractors are repeated, each by itself.
    ratio
        Below which relative change of every side a row is left alone, 0 <= ratio < 1.
    max_rounds
        How often the contractor is applied at most, at least 1.

    Raises
    ------
    ValueError
        If `ratio` or `max_rounds` is out of range.

    References
    ----------
    Chabert, Jaulin: Contractor programming, Artificial Intelligence 173 (2009), section 3.
    """
    if isinstance(contractor, Separator):
        return Separator(*(FixedPoint(part, ratio, max_rounds) for part in (contractor.inner, contractor.outer)))
    return FixedPoint(contractor, ratio, max_rounds)
