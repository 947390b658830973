"""A family: many constraints of one kind, which are contracted together."""

from collections.abc import Iterable
from typing import Protocol, cast, runtime_checkable

from ial.contractors.boxes import Boxes, FloatArray
from ial.contractors.contractor import ContractorLike, Dimensioned


@runtime_checkable
class Family(Dimensioned, Protocol):
    """Many contractors as one object, which narrows each box by each of them in one call.

    The intersection, the union and a relaxed intersection take a family wherever they take a contractor; it counts as `count`
    of them. One constraint with m values of its constants (m beams, m beacons) is a family of m.
    """

    @property
    def count(self) -> int:
        """The number of contractors m."""
        ...

    def contract_each(self, boxes: Boxes) -> tuple[FloatArray, FloatArray]:
        """Return the bounds of each of n boxes after each of m contractors, two arrays of shape (n, m, d).

        An emptied box is as in `Contractor`: ``lower = +inf, upper = -inf`` in every dimension.
        """
        ...


SEPARATORS_APART = "Separators combine with separators only: Separator.of(contractor) makes one where the complement is known"
"""What to do about a mixture, at the end of a message."""

Member = ContractorLike | Family
Members = Iterable[Member] | Family


def several(contractors: Iterable[object] | Family) -> tuple[object, ...]:
    """Return what a combinator is given as a tuple: a family alone stands for itself.

    Raises
    ------
    TypeError
        If a single contractor is given where several are combined.
    """
    if isinstance(contractors, Family):
        return (contractors,)
    if not isinstance(contractors, Iterable):
        raise TypeError(f"a single {type(contractors).__name__} is given where several contractors are combined; put them into a list")
    return tuple(contractors)


def members_of(contractors: Iterable[object]) -> tuple[Member, ...]:
    """Return the same objects, known to be contractors and families.

    Raises
    ------
    TypeError
        If something is neither.
    ValueError
        If a family is of no constraints.
    """
    members = tuple(contractors)
    for member in members:
        if isinstance(member, Family):
            if member.count < 1:
                raise ValueError(f"the family {type(member).__name__} holds {member.count} constraints; give at least one")
        elif not (hasattr(member, "dimension") and callable(getattr(member, "contract", None))):
            raise TypeError(
                f"{type(member).__name__} is not a contractor, which has a dimension and a method contract(boxes). {SEPARATORS_APART}"
            )
    return cast(tuple[Member, ...], members)


def count_of(member: Member) -> int:
    """Return how many constraints a member stands for."""
    return member.count if isinstance(member, Family) else 1
