"""The contractors of the two sets that need no description: no point at all, and every point."""

import numpy as np

from ial.contractors.boxes import Boxes
from ial.contractors.checked_contractor import CheckedContractor


class EmptySet(CheckedContractor):
    """No point at all: every box is emptied.

    Parameters
    ----------
    dimension
        The number of variables.
    """

    def __init__(self, dimension: int) -> None:
        self.dimension = dimension

    def _narrow(self, boxes: Boxes) -> Boxes:
        return boxes.where(np.zeros(len(boxes), dtype=np.bool_))

    def complement(self) -> "WholeSpace":
        """Return the contractor of every point."""
        return WholeSpace(self.dimension)


class WholeSpace(CheckedContractor):
    """Every point: boxes stay as they are.

    Parameters
    ----------
    dimension
        The number of variables.
    """

    def __init__(self, dimension: int) -> None:
        self.dimension = dimension

    def _narrow(self, boxes: Boxes) -> Boxes:
        return boxes

    def complement(self) -> EmptySet:
        """Return the contractor of no point at all."""
        return EmptySet(self.dimension)
