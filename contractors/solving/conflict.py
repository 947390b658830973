"""Why a set is empty: a few constraints that contradict each other."""

from collections.abc import Callable, Sequence
from typing import Any

from ial.contractors.boxes import Boxes
from ial.contractors.combinators.family import Member
from ial.contractors.contractor import ContractorLike
from ial.contractors.paving.paver import Progress, pave

_BATCH = 256  # small enough that a search in depth soon meets a box that cannot be removed


class _NotEmptyError(Exception):
    """A box has reached the wanted precision."""


def conflict(
    constraints: Sequence[Member],
    contractor: Callable[[Sequence[Member]], ContractorLike],
    box: Boxes,
    precision: Any,
    **options: Any,
) -> tuple[Member, ...] | None:
    """Return an irreducible set of conflicting constraints: proved empty together, and not proved so with any one of them left out.

    A deletion filter: constraints are left out one after the other, for good where the rest is still proved empty. Proofs by bisection
    are not monotone (with fewer constraints, other sides are cut), so that one that was needed before may not be needed any more: the
    filter goes on until every remaining constraint was tried on the final set.

    Parameters
    ----------
    constraints
        The constraints.
    contractor
        Makes a contractor of some of them, and of none.
    box
        The domains, one box.
    precision, **options
        For `ial.contractors.paving.paver.pave`.

    Returns
    -------
    tuple or None
        None if not even all constraints together are proved empty.

    References
    ----------
    Chinneck, Dravnieks: Locating minimal infeasible constraint sets in linear programs, ORSA Journal on Computing 3 (1991).
    """

    def proved(numbers: Sequence[int]) -> bool:
        # Always in the order given, in which they narrow a box in every proof.
        return _is_empty(contractor([constraints[at] for at in sorted(numbers)]), box, precision, options)

    kept = list(range(len(constraints)))
    if not proved(kept):
        return None
    needed = 0  # how many were tried in vain on the present set; they stand at its end
    while needed < len(kept):
        first, *others = kept
        if proved(others):
            kept, needed = others, 0
        else:
            kept, needed = [*others, first], needed + 1
    return tuple(constraints[at] for at in sorted(kept))


def _is_empty(contractor: ContractorLike, box: Boxes, precision: Any, options: dict[str, Any]) -> bool:
    """Return whether bisection to a precision leaves nothing; it ends with the first box that is left."""
    report = options.get("progress")

    def progress(state: Progress) -> None:
        if report is not None:
            report(state)
        if state.finished:
            raise _NotEmptyError

    try:
        return not len(pave(contractor, box, precision, **{"batch": _BATCH, **options, "progress": progress}).boxes)
    except _NotEmptyError:
        return False
