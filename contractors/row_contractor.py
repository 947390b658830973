"""`RowContractor`: a contractor whose work is done by a kernel, row by row."""

from abc import abstractmethod

from ial.contractors.boxes import Boxes, FloatArray
from ial.contractors.checked_contractor import CheckedContractor


class RowContractor(CheckedContractor):
    """A contractor that copies the boxes and has a kernel narrow each row of the copy. A subclass defines `_narrow_rows`."""

    def _narrow(self, boxes: Boxes) -> Boxes:
        lower, upper = boxes.lower.copy(), boxes.upper.copy()
        self._narrow_rows(lower, upper)
        return Boxes(lower, upper)

    @abstractmethod
    def _narrow_rows(self, lower: FloatArray, upper: FloatArray) -> None:
        """Narrow boxes in place, lower and upper bounds of shape (n, d); most often by `threads.run` of a kernel."""
