"""Cylinders: a constraint on some of the variables of a larger space."""

import operator
from collections.abc import Sequence
from typing import overload

import numpy as np

from ial.contractors.boxes import Boxes, FloatArray
from ial.contractors.checked_contractor import CheckedContractor
from ial.contractors.combinators.family import Family
from ial.contractors.contractor import Contractor, ContractorLike, complement
from ial.contractors.separator import Separator


class Cylinder(CheckedContractor):
    """A constraint on some of the variables of a larger space; the others are free. See `where`.

    Parameters
    ----------
    contractor
        The constraint on k variables.
    axes
        Which variables of the larger space these are, in the contractor's own order: k different numbers from 0 to `dimension` − 1.
    dimension
        The number of variables of the larger space.

    Raises
    ------
    ValueError
        If the axes do not fit.
    """

    def __init__(self, contractor: ContractorLike, axes: Sequence[int], dimension: int) -> None:
        self.axes = checked_axes(axes, dimension)
        _require_one_axis_each(contractor, self.axes)
        self.contractor = contractor
        self.dimension = dimension

    def complement(self) -> "Cylinder":
        """Return the cylinder of the complement.

        Raises
        ------
        TypeError
            If it is not known.
        """
        return Cylinder(complement(self.contractor), self.axes, self.dimension)

    def _narrow(self, boxes: Boxes) -> Boxes:
        part = self.contractor.contract(columns(boxes, self.axes))
        lower, upper = boxes.lower.copy(), boxes.upper.copy()
        lower[:, self.axes], upper[:, self.axes] = part.lower, part.upper
        return Boxes(lower, upper).where(~part.empty)


class CylinderFamily:
    """The same for a family: each of its constraints becomes one on the larger space.

    Parameters
    ----------
    family, axes, dimension
        As for `Cylinder`.

    Raises
    ------
    ValueError
        If the axes do not fit.
    """

    def __init__(self, family: Family, axes: Sequence[int], dimension: int) -> None:
        self.axes = checked_axes(axes, dimension)
        _require_one_axis_each(family, self.axes)
        self.family = family
        self.dimension = dimension

    @property
    def count(self) -> int:
        """The number of constraints."""
        return self.family.count

    def contract_each(self, boxes: Boxes) -> tuple[FloatArray, FloatArray]:
        """Return the bounds of each box after each of the constraints, two arrays of shape (n, m, d)."""
        part_lower, part_upper = self.family.contract_each(columns(boxes, self.axes))
        empty = (part_lower > part_upper).any(axis=2, keepdims=True)
        lower, upper = (np.repeat(bound[:, None], self.count, axis=1) for bound in (boxes.lower, boxes.upper))
        lower[:, :, self.axes], upper[:, :, self.axes] = part_lower, part_upper
        return np.where(empty, np.inf, lower), np.where(empty, -np.inf, upper)


@overload
def where(contractor: Separator, axes: Sequence[int], dimension: int) -> Separator: ...
@overload
def where(contractor: Family, axes: Sequence[int], dimension: int) -> CylinderFamily: ...
@overload
def where(contractor: ContractorLike, axes: Sequence[int], dimension: int) -> Contractor: ...
def where(contractor: Separator | Family | ContractorLike, axes: Sequence[int], dimension: int) -> Separator | CylinderFamily | Contractor:
    """Return a constraint on some of the variables of a larger space; the others are free.

    ``where(polar, axes=(3, 0, 1, 5), dimension=7)`` takes variable 3 as the first variable of ``polar``, variable 0 as its second, and so
    on.

    Parameters
    ----------
    contractor
        The constraint on k variables: a contractor, a family or a separator; the result is of the same kind.
    axes
        Which variables of the larger space these are, in the order of the contractor: k different numbers from 0 to `dimension` − 1.
    dimension
        The number of variables of the larger space.

    Raises
    ------
    ValueError
        If the axes do not fit.
    """
    if isinstance(contractor, Separator):
        return Separator(*(Cylinder(part, axes, dimension) for part in (contractor.inner, contractor.outer)))
    if isinstance(contractor, Family):
        return CylinderFamily(contractor, axes, dimension)
    return Cylinder(contractor, axes, dimension)


def checked_axes(axes: Sequence[int], dimension: int) -> list[int]:
    """Return axes as a list.

    Raises
    ------
    ValueError
        Unless they are different numbers from 0 to `dimension` − 1.
    """
    numbers = [operator.index(axis) for axis in axes]
    if len(set(numbers)) != len(numbers) or not all(0 <= axis < dimension for axis in numbers):
        raise ValueError(f"the axes are {numbers}; in {dimension} dimensions give different numbers from 0 to {dimension - 1}")
    return numbers


def columns(boxes: Boxes, axes: Sequence[int]) -> Boxes:
    """Return the sides of boxes on some axes, in the order of these."""
    return Boxes(boxes.lower[:, axes], boxes.upper[:, axes])


def _require_one_axis_each(contractor: ContractorLike | Family, axes: Sequence[int]) -> None:
    if len(axes) != contractor.dimension:
        raise ValueError(f"{len(axes)} axes are given; {type(contractor).__name__} has {contractor.dimension} variables, so give as many")
