"""`CheckedContractor`: a contractor that looks before it narrows."""

from abc import abstractmethod

from ial.contractors.boxes import Boxes
from ial.contractors.contractor import Contractor, require_dimension
from ial.contractors.rounding import check_rounding


class CheckedContractor(Contractor):
    """A contractor that checks the dimension of the boxes and the rounding mode, and then narrows.

    A subclass sets `dimension` and defines `_narrow`, which so meets only boxes of this dimension and a processor that can be trusted.
    """

    def contract(self, boxes: Boxes) -> Boxes:
        """Return the narrowed boxes.

        Raises
        ------
        ValueError
            If the boxes are of another dimension.
        """
        require_dimension(self, boxes)
        check_rounding()
        return self._narrow(boxes)

    @abstractmethod
    def _narrow(self, boxes: Boxes) -> Boxes:
        """Return the narrowed boxes."""
