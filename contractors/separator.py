"""Separators: a set from the inside and from the outside at once."""

from collections.abc import Sequence
from typing import TypeGuard

from ial.contractors.boxes import Boxes
from ial.contractors.combinators.combination import Intersection, Union
from ial.contractors.combinators.family import SEPARATORS_APART, Family, Member
from ial.contractors.contractor import ContractorLike, common_dimension, complement
from ial.contractors.space import common_space


class Separator:
    """A set S as a pair of contractors: `outer` removes only points outside S, `inner` removes only points of S.

    What `outer` leaves of a box covers the box's part in S, and what `inner` leaves covers its part outside S: between them lies, at least,
    the boundary. Sets are closed: a point of the boundary may be kept by both, and one that `inner` keeps is not thereby proved to be
    outside. A separator states no more than its two contractors prove.

    ``a & b`` is the intersection of two sets, ``a | b`` their union, ``~a`` the complement, which only exchanges the two contractors.

    Parameters
    ----------
    inner, outer
        Contractors of one dimension: `outer` for the set, `inner` for its complement. A family counts as one contractor here, for the
        intersection of its constraints: a separator is one set wherever it is combined.

    Raises
    ------
    ValueError
        If the dimensions differ.

    References
    ----------
    Jaulin, Desrochers: Introduction to the algebra of separators with application to path planning, Engineering Applications of
    Artificial Intelligence 33 (2014).
    """

    def __init__(self, inner: ContractorLike, outer: ContractorLike) -> None:
        self.dimension = common_dimension((inner, outer))
        self.space = common_space((inner, outer))
        self.inner = _one(inner)
        self.outer = _one(outer)

    def __repr__(self) -> str:
        return f"Separator(inner={self.inner!r}, outer={self.outer!r})"

    @classmethod
    def of(cls, contractor: ContractorLike) -> "Separator":
        """Return the separator of a contractor that knows its complement.

        Raises
        ------
        TypeError
            If it does not.
        """
        return Separator(inner=complement(contractor), outer=contractor)

    def separate(self, boxes: Boxes) -> tuple[Boxes, Boxes]:
        """Return the boxes narrowed by `inner`, and the same boxes narrowed by `outer`.

        What the first lacks is inside the set, what the second lacks is outside; what both hold is undecided.
        """
        return self.inner.contract(boxes), self.outer.contract(boxes)

    def __and__(self, other: "Separator") -> "Separator":
        return intersect([self, other])

    def __or__(self, other: "Separator") -> "Separator":
        return unite([self, other])

    def __invert__(self) -> "Separator":
        return Separator(inner=self.outer, outer=self.inner)


def intersect(separators: Sequence[Separator]) -> Separator:
    """Return the points of all of several sets.

    Raises
    ------
    TypeError
        If something is no separator.
    ValueError
        If there is none, or the dimensions differ.
    """
    _require_separators(separators)
    return Separator(inner=Union(*(each.inner for each in separators)), outer=Intersection(*(each.outer for each in separators)))


def unite(separators: Sequence[Separator]) -> Separator:
    """Return the points of at least one of several sets.

    Raises
    ------
    TypeError
        If something is no separator.
    ValueError
        If there is none, or the dimensions differ.
    """
    _require_separators(separators)
    return Separator(inner=Intersection(*(each.inner for each in separators)), outer=Union(*(each.outer for each in separators)))


def are_separators(members: Sequence[object]) -> TypeGuard[Sequence[Separator]]:
    """Return whether there are members and all of them are separators."""
    return bool(members) and all(isinstance(member, Separator) for member in members)


def _require_separators(members: Sequence[object]) -> None:
    for member in members:
        if not isinstance(member, Separator):
            raise TypeError(f"{type(member).__name__} is not a separator. {SEPARATORS_APART}")


def _one(contractor: Member) -> ContractorLike:
    """Return a contractor that counts as one: relaxation by q would otherwise mean another number of sets outside than inside."""
    return Intersection(contractor) if isinstance(contractor, Family) else contractor
