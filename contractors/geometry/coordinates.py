"""Sets given in polar coordinates as sets of points of the plane, and back."""

import math
from typing import overload

import numpy as np

from ial.contractors.boxes import Boxes
from ial.contractors.checked_contractor import CheckedContractor
from ial.contractors.combinators.cylinder import columns
from ial.contractors.combinators.rows import emptied, occupied, widen
from ial.contractors.contractor import Contractor, ContractorLike, complement
from ial.contractors.geometry.polar import Polar
from ial.contractors.intervals.arithmetic import add
from ial.contractors.intervals.trigonometric import TWO_PI_LOWER, TWO_PI_UPPER
from ial.contractors.rounding import check_rounding
from ial.contractors.separator import Separator

_POLAR = Polar()
_POINT, _COORDINATES = (0, 1), (2, 3)  # where Polar has x, y and r, θ
_FARTHEST_START_RAD = 1000.0


class FromPolar(CheckedContractor):
    """Points (x, y) some of whose polar coordinates, within one turn, satisfy a constraint. See `from_polar`.

    Parameters
    ----------
    contractor
        The constraint on (r, θ).
    start_rad
        Where the turn begins.

    Raises
    ------
    ValueError
        If the contractor is not of two variables or the start is not within ±1000 rad.
    """

    dimension = 2

    def __init__(self, contractor: ContractorLike, start_rad: float = -math.pi) -> None:
        check_rounding()
        _require_two_variables(contractor)
        if not abs(start_rad) <= _FARTHEST_START_RAD:
            raise ValueError(f"the turn of θ begins at {start_rad} rad; give a number from {-_FARTHEST_START_RAD} to {_FARTHEST_START_RAD}")
        self.contractor = contractor
        self.start_rad = start_rad
        middle, (_, stop) = start_rad + math.pi, add(start_rad, start_rad, TWO_PI_LOWER, TWO_PI_UPPER)
        # Both ends of the turn have the same direction: in halves, a box across it has two short ranges of θ instead of all of them.
        self._halves = (start_rad, middle), (middle, stop)

    def complement(self) -> "FromPolar":
        """Return the points some of whose polar coordinates satisfy the complement.

        Raises
        ------
        TypeError
            If it is not known.
        """
        return FromPolar(complement(self.contractor), self.start_rad)

    def _narrow(self, boxes: Boxes) -> Boxes:
        hull = emptied(len(boxes), 2)
        for start, stop in self._halves:
            turn = Boxes(np.tile([0.0, start], (len(boxes), 1)), np.tile([np.inf, stop], (len(boxes), 1)))
            rows, relation = _narrowed(_beside(boxes, turn))
            relation = _beside(columns(relation, _POINT), self.contractor.contract(columns(relation, _COORDINATES)))
            point = columns(_POLAR.contract(relation), _POINT)
            widen(rows, point.lower, point.upper, hull.lower, hull.upper)
        return hull


class ToPolar(CheckedContractor):
    """Pairs (r, θ) whose point (r·cos θ, r·sin θ) satisfies a constraint. See `to_polar`.

    Parameters
    ----------
    contractor
        The constraint on (x, y).

    Raises
    ------
    ValueError
        If the contractor is not of two variables.
    """

    dimension = 2

    def __init__(self, contractor: ContractorLike) -> None:
        _require_two_variables(contractor)
        self.contractor = contractor

    def complement(self) -> "ToPolar":
        """Return the pairs whose point satisfies the complement.

        Raises
        ------
        TypeError
            If it is not known.
        """
        return ToPolar(complement(self.contractor))

    def _narrow(self, boxes: Boxes) -> Boxes:
        hull = emptied(len(boxes), 2)
        self._widen(hull, boxes, opposite=False)
        if (boxes.lower[:, 0] < 0.0).any():
            self._widen(hull, boxes, opposite=True)
        return hull

    def _widen(self, hull: Boxes, boxes: Boxes, opposite: bool) -> None:
        """Add what is left of r >= 0; or, with r and the point turned to the opposite side, of r <= 0."""
        plane = Boxes(np.full(boxes.lower.shape, -np.inf), np.full(boxes.upper.shape, np.inf))
        rows, relation = _narrowed(_beside(plane, _with_opposite_radius(boxes) if opposite else boxes))
        point = columns(relation, _POINT)
        point = _opposite(self.contractor.contract(_opposite(point))) if opposite else self.contractor.contract(point)
        pair = columns(_POLAR.contract(_beside(point, columns(relation, _COORDINATES))), _COORDINATES)
        pair = _with_opposite_radius(pair) if opposite else pair
        widen(rows, pair.lower, pair.upper, hull.lower, hull.upper)


def _require_two_variables(contractor: ContractorLike) -> None:
    if contractor.dimension != 2:
        raise ValueError(f"{type(contractor).__name__} has {contractor.dimension} variables; a set of the plane has 2")


def _beside(a: Boxes, b: Boxes) -> Boxes:
    return Boxes(np.hstack([a.lower, b.lower]), np.hstack([a.upper, b.upper]))


def _narrowed(boxes: Boxes) -> tuple[np.ndarray[tuple[int], np.dtype[np.int64]], Boxes]:
    """Return what the polar relation leaves of boxes, and the rows of it that are not empty."""
    relation = _POLAR.contract(boxes)
    rows = occupied(relation.lower, relation.upper)
    return rows, relation[rows]


def _opposite(boxes: Boxes) -> Boxes:
    return Boxes(-boxes.upper, -boxes.lower)


def _with_opposite_radius(boxes: Boxes) -> Boxes:
    radius, angle = columns(boxes, [0]), columns(boxes, [1])
    return _beside(_opposite(radius), angle)


@overload
def from_polar(contractor: Separator, start_rad: float = ...) -> Separator: ...
@overload
def from_polar(contractor: ContractorLike, start_rad: float = ...) -> Contractor: ...
def from_polar(contractor: Separator | ContractorLike, start_rad: float = -math.pi) -> Contractor | Separator:
    """Return a set of polar coordinates (r, θ) as a set of points (x, y) of the plane.

    A point belongs to it if some pair (r, θ) with x = r·cos θ, y = r·sin θ does, with r >= 0 and θ in the closed turn that begins at
    `start_rad`. Only points on the ray where the turn begins have two such pairs, and the origin has all with r = 0: the inner contractor
    of a separator removes such a point if all its pairs are inside. Pairs with θ outside the turn are not looked at: for a set that spans
    several turns, take the union over their starts.

    Parameters
    ----------
    contractor
        A contractor or a separator on (r, θ), θ in radians.
    start_rad
        Where the turn begins, by default −π.

    Raises
    ------
    ValueError
        If the contractor is not of two variables or the start is not within ±1000 rad.
    """
    if isinstance(contractor, Separator):
        return Separator(*(FromPolar(part, start_rad) for part in (contractor.inner, contractor.outer)))
    return FromPolar(contractor, start_rad)


@overload
def to_polar(contractor: Separator) -> Separator: ...
@overload
def to_polar(contractor: ContractorLike) -> Contractor: ...
def to_polar(contractor: Separator | ContractorLike) -> Contractor | Separator:
    """Return a set of points (x, y) of the plane as a set of polar coordinates (r, θ).

    A pair belongs to it if (r·cos θ, r·sin θ) does, for any real r and θ: with a negative r the point lies on the opposite side.

    Parameters
    ----------
    contractor
        A contractor or a separator on (x, y).

    Raises
    ------
    ValueError
        If the contractor is not of two variables.
    """
    if isinstance(contractor, Separator):
        return Separator(*(ToPolar(part) for part in (contractor.inner, contractor.outer)))
    return ToPolar(contractor)
