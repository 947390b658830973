"""The contractor protocol and the combinators `Intersection` and `Union`."""

from typing import Protocol

import numpy as np

from ial.contractors.boxes import Boxes


class Contractor(Protocol):
    """Narrows boxes without losing a solution: every point of an input box that satisfies the constraint is in its output box.

    Output rows correspond to input rows in the same order; an emptied row is ``lower = +inf, upper = -inf`` in every dimension; the input
    is not modified.
    """

    dimension: int

    def contract(self, boxes: Boxes) -> Boxes:
        """Return the narrowed boxes."""
        ...


def require_dimension(contractor: Contractor, boxes: Boxes) -> None:
    """Raise unless the boxes have the dimension of a contractor.

    Raises
    ------
    ValueError
        If they do not.
    """
    if boxes.dimension != contractor.dimension:
        raise ValueError(f"the boxes have {boxes.dimension} dimensions; {type(contractor).__name__} needs {contractor.dimension}")


def common_dimension(contractors: tuple[Contractor, ...]) -> int:
    """Return the dimension that all of several contractors have.

    Raises
    ------
    ValueError
        If there is no contractor, or if they differ.
    """
    dimensions = {contractor.dimension for contractor in contractors}
    if len(dimensions) != 1:
        raise ValueError(f"the contractors have dimensions {sorted(dimensions)}; give at least one contractor, all of one dimension")
    return dimensions.pop()


class Intersection:
    """All of several constraints: the contractors are applied one after the other.

    Parameters
    ----------
    contractors
        At least one contractor, all of one dimension.
    """

    def __init__(self, *contractors: Contractor) -> None:
        self.dimension = common_dimension(contractors)
        self.contractors = contractors

    def contract(self, boxes: Boxes) -> Boxes:
        """Return the boxes narrowed by every contractor in turn.

        Raises
        ------
        ValueError
            If the boxes are of another dimension.
        """
        require_dimension(self, boxes)
        for contractor in self.contractors:
            boxes = contractor.contract(boxes)
        return boxes


class Union:
    """At least one of several constraints: the hull of what the contractors leave of each box.

    Parameters
    ----------
    contractors
        At least one contractor, all of one dimension.
    """

    def __init__(self, *contractors: Contractor) -> None:
        self.dimension = common_dimension(contractors)
        self.contractors = contractors

    def contract(self, boxes: Boxes) -> Boxes:
        """Return, for each box, the hull of the boxes narrowed by each contractor.

        Raises
        ------
        ValueError
            If the boxes are of another dimension.
        """
        require_dimension(self, boxes)
        parts = [contractor.contract(boxes) for contractor in self.contractors]
        return Boxes(np.min([part.lower for part in parts], axis=0), np.max([part.upper for part in parts], axis=0))
