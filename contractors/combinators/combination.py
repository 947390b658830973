"""Intersection and union: all of several constraints, or at least one of them. Each is the other's complement."""

from collections.abc import Callable, Iterable

import numpy as np

from ial.contractors.boxes import Boxes
from ial.contractors.checked_contractor import CheckedContractor
from ial.contractors.combinators.family import Family, Member, members_of
from ial.contractors.combinators.relaxation import Relaxed
from ial.contractors.combinators.rows import PAYS, emptied, occupied, outside, spread, widen
from ial.contractors.contractor import Contractor, ContractorLike, common_dimension, complement
from ial.contractors.space import common_space


class _Combination(CheckedContractor):
    """What an intersection and a union share: their members.

    Parameters
    ----------
    members
        Contractors and families.
    kind
        Members of this very class give their own members.
    outliers
        Of a family, which counts as one member here, how many constraints may fail.
    """

    def __init__(self, members: Iterable[Member], kind: type["_Combination"], outliers: Callable[[Family], int]) -> None:
        known = members_of(members)
        self.dimension = common_dimension(known)
        self.space = common_space(known)
        flat: list[ContractorLike] = []
        for member in known:
            if isinstance(member, Family):
                flat.append(Relaxed(member, outliers=outliers(member)))
            elif isinstance(member, _Combination) and type(member) is kind:
                flat.extend(member.contractors)
            else:
                flat.append(member)
        self.contractors: tuple[ContractorLike, ...] = tuple(flat)


class Intersection(_Combination):
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
        super().__init__(contractors, Intersection, lambda family: 0)

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


class Union(_Combination):
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
        super().__init__(contractors, Union, lambda family: family.count - 1)

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
