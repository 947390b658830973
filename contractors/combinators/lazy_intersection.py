"""The lazy intersection: contractors that have emptied most boxes come first."""

from ial.contractors.boxes import Boxes
from ial.contractors.combinators.combination import Intersection
from ial.contractors.combinators.family import Member


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
