"""Intersection, union and negation: all of several constraints, at least one of them, or not a constraint."""

from collections.abc import Iterable, Sequence
from typing import overload

import numpy as np

from ial.contractors.boxes import Boxes
from ial.contractors.combinators.family import Family, Member, Members, members_of, several
from ial.contractors.combinators.relaxation import Relaxed
from ial.contractors.combinators.rows import PAYS, emptied, occupied, outside, spread, widen
from ial.contractors.contractor import Combinator, Contractor, ContractorLike, common_dimension, complement
from ial.contractors.separator import Separator, are_separators
from ial.contractors.space import common_space


class Intersection(Combinator):
    """All of several constraints: the contractors are applied one after the other, to the rows that are not yet empty.

    Parameters
    ----------
    contractors
        At least one contractor or family, all of one dimension. The members of an intersection become members of this one. A family is
        applied at once, as one member: its contractors all narrow the same box, and the results are intersected.

    Raises
    ------
    TypeError
        If something is not a contractor.
    ValueError
        If the dimensions differ.
    """

    def __init__(self, *contractors: Member) -> None:
        members = members_of(contractors)
        self.dimension = common_dimension(members)
        self.space = common_space(members)
        flat: list[ContractorLike] = []
        for member in members:
            if isinstance(member, Family):
                flat.append(Relaxed(member, outliers=0))
            else:
                flat.extend(member.contractors if type(member) is Intersection else [member])
        self.contractors: tuple[ContractorLike, ...] = tuple(flat)

    def __repr__(self) -> str:
        return " & ".join(f"({contractor!r})" for contractor in self.contractors)

    def complement(self) -> Contractor:
        """Return the points at which at least one constraint fails.

        Raises
        ------
        TypeError
            If the complement of a member is not known.
        """
        return Union(*map(complement, self.contractors))

    def _narrow(self, boxes: Boxes) -> Boxes:
        return self._narrow_in_turn(boxes, range(len(self.contractors)), PAYS)

    def _narrow_in_turn(self, boxes: Boxes, order: Iterable[int], pays: float) -> Boxes:
        rows, rest = np.arange(len(boxes)), boxes
        for at in order:
            passed = len(rest)
            rest = self.contractors[at].contract(rest)
            left = occupied(rest.lower, rest.upper)
            self._learn(at, passed, len(left))
            if len(left) <= pays * passed:
                rows, rest = rows[left], rest[left]
            if not len(left):
                break
        return rest if len(left) == len(boxes) else spread(rows, rest, len(boxes))

    def _learn(self, at: int, passed: int, left: int) -> None:
        """Note how many rows a contractor was given, and how many it left."""


class Union(Combinator):
    """At least one of several constraints: the hull of what the contractors leave of each box.

    A row whose hull is as large as the row itself is not passed on to further contractors.

    Parameters
    ----------
    contractors
        At least one contractor or family, all of one dimension. The members of a union become members of this one.

    Raises
    ------
    TypeError
        If something is not a contractor.
    ValueError
        If the dimensions differ.
    """

    def __init__(self, *contractors: Member) -> None:
        members = members_of(contractors)
        self.dimension = common_dimension(members)
        self.space = common_space(members)
        flat: list[ContractorLike] = []
        for member in members:
            if isinstance(member, Family):
                flat.append(Relaxed(member, outliers=member.count - 1))
            else:
                flat.extend(member.contractors if type(member) is Union else [member])
        self.contractors: tuple[ContractorLike, ...] = tuple(flat)

    def __repr__(self) -> str:
        return " | ".join(f"({contractor!r})" for contractor in self.contractors)

    def complement(self) -> Contractor:
        """Return the points at which every constraint fails.

        Raises
        ------
        TypeError
            If the complement of a member is not known.
        """
        return Intersection(*map(complement, self.contractors))

    def _narrow(self, boxes: Boxes) -> Boxes:
        hull = emptied(len(boxes), self.dimension)
        rows = np.arange(len(boxes))
        for contractor in self.contractors:
            part = contractor.contract(boxes)
            widen(rows, part.lower, part.upper, hull.lower, hull.upper)
            left = outside(rows, boxes.lower, boxes.upper, hull.lower, hull.upper)
            if not len(left):
                break
            if len(left) <= PAYS * len(rows):
                rows, boxes = rows[left], boxes[left]
        return hull


@overload
def intersection(contractors: Iterable[Separator]) -> Separator: ...
@overload
def intersection(contractors: Members) -> Contractor: ...
def intersection(contractors: Iterable[Separator] | Members) -> Contractor | Separator:
    """Return the constraint that all of several constraints hold: ``a & b`` of many.

    Parameters
    ----------
    contractors
        Contractors and families, or separators; all of one dimension. A family alone need not be put into a list.

    Returns
    -------
    Contractor or Separator
        The contractors are applied one after the other. For separators, the outer contractors are, and the hull of what each inner
        contractor leaves is taken.

    Raises
    ------
    TypeError
        If contractors and separators are mixed.
    ValueError
        If there is none, or the dimensions differ.

    References
    ----------
    Chabert, Jaulin: Contractor programming, Artificial Intelligence 173 (2009), section 3.
    """
    members = several(contractors)
    if are_separators(members):
        return Separator(inner=Union(*_inner(members)), outer=Intersection(*_outer(members)))
    return Intersection(*members_of(members))


@overload
def union(contractors: Iterable[Separator]) -> Separator: ...
@overload
def union(contractors: Members) -> Contractor: ...
def union(contractors: Iterable[Separator] | Members) -> Contractor | Separator:
    """Return the constraint that at least one of several constraints holds: ``a | b`` of many.

    Parameters
    ----------
    contractors
        Contractors and families, or separators; all of one dimension. A family alone need not be put into a list.

    Returns
    -------
    Contractor or Separator
        Of each box, the hull of what the contractors leave. For separators, the hull of what the outer contractors leave, and the inner
        contractors one after the other.

    Raises
    ------
    TypeError
        If contractors and separators are mixed.
    ValueError
        If there is none, or the dimensions differ.

    References
    ----------
    Chabert, Jaulin: Contractor programming, Artificial Intelligence 173 (2009), section 3.
    """
    members = several(contractors)
    if are_separators(members):
        return Separator(inner=Intersection(*_inner(members)), outer=Union(*_outer(members)))
    return Union(*members_of(members))


@overload
def negation(contractor: Separator) -> Separator: ...
@overload
def negation(contractor: ContractorLike) -> ContractorLike: ...
def negation(contractor: Separator | ContractorLike) -> ContractorLike | Separator:
    """Return the constraint that a constraint does not hold, its boundary included: ``~a``.

    For a separator the two contractors change places. For a contractor its complement is returned where its class knows one; combinators
    know theirs if their members do: an intersection becomes a union of complements, a relaxed intersection of n constraints of which q may
    fail becomes one of n complements of which n − q − 1 may fail.

    Raises
    ------
    TypeError
        If the complement is not known.
    """
    return ~contractor if isinstance(contractor, Separator) else complement(contractor)


def _inner(separators: Sequence[Separator]) -> Iterable[ContractorLike]:
    return (separator.inner for separator in separators)


def _outer(separators: Sequence[Separator]) -> Iterable[ContractorLike]:
    return (separator.outer for separator in separators)
