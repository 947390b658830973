"""The lazy intersection: contractors that have emptied most boxes come first."""

from collections.abc import Iterable
from typing import overload

from ial.contractors.boxes import Boxes
from ial.contractors.combinators.combination import Intersection, union
from ial.contractors.combinators.family import Member, Members, members_of, several
from ial.contractors.contractor import Contractor
from ial.contractors.separator import Separator, are_separators


class LazyIntersection(Intersection):
    """All of several constraints, tried in the order of past success, on the rows that are not yet empty. See `lazy`.

    Parameters
    ----------
    contractors
        At least one contractor or family, all of one dimension.

    Raises
    ------
    TypeError
        If something is not a contractor.
    ValueError
        If the dimensions differ.
    """

    def __init__(self, *contractors: Member) -> None:
        super().__init__(*contractors)
        self._passed = [0] * len(self.contractors)
        self._left = [0] * len(self.contractors)

    def order(self) -> list[int]:
        """Return the numbers of the contractors in the order in which the next batch meets them."""
        # A contractor counts as if it had emptied one more row, so that an untried one comes early; ties keep their order.
        return sorted(range(len(self.contractors)), key=lambda at: self._left[at] / (self._passed[at] + 1))

    def _narrow(self, boxes: Boxes) -> Boxes:
        return self._narrow_in_turn(boxes, self.order(), pays=1.0)

    def _learn(self, at: int, passed: int, left: int) -> None:
        self._passed[at] += passed
        self._left[at] += left


@overload
def lazy(contractors: Iterable[Separator]) -> Separator: ...
@overload
def lazy(contractors: Members) -> Contractor: ...
def lazy(contractors: Iterable[Separator] | Members) -> Contractor | Separator:
    """Return the intersection of several constraints, which learns their order: those that emptied the largest share of rows come first.

    The set of solutions is that of `intersection`. The boxes on the way may differ, since contractors that are applied in another
    order narrow differently; they depend on the batches that this object has seen before, and on nothing else: rows are counted, no
    time is measured. A new object starts anew, in the order given.

    Parameters
    ----------
    contractors
        Contractors and families, or separators (whose outer contractors are ordered); all of one dimension.

    Raises
    ------
    TypeError
        If contractors and separators are mixed.
    ValueError
        If there is none, or the dimensions differ.
    """
    members = several(contractors)
    if are_separators(members):
        outer = LazyIntersection(*(member.outer for member in members))
        return Separator(inner=union(member.inner for member in members), outer=outer)
    return LazyIntersection(*members_of(members))
