"""Projection: the values of some variables for which values of the others exist."""

from abc import abstractmethod
from collections.abc import Sequence
from typing import overload

import numpy as np
import numpy.typing as npt

from ial.contractors.boxes import Boxes, FloatArray
from ial.contractors.checked_contractor import CheckedContractor
from ial.contractors.combinators.cylinder import checked_axes, columns
from ial.contractors.combinators.rows import emptied, occupied, outside, widen
from ial.contractors.contractor import Contractor, ContractorLike
from ial.contractors.separator import Separator

IntArray = npt.NDArray[np.int64]

_BATCH = 1 << 14


class _Projection(CheckedContractor):
    """What the two contractors of a projection share: for each row, a search through the values of the hidden variables.

    A subclass says what the search knows of a row, as boxes `hull` that it changes in place.
    """

    def __init__(
        self, outer: ContractorLike, onto: Sequence[int], domain: Sequence[tuple[float, float]], precision: float, max_boxes: int
    ) -> None:
        self.outer = outer
        self.onto = checked_axes(onto, outer.dimension)
        self.dimension = len(self.onto)
        self.hidden = [axis for axis in range(outer.dimension) if axis not in self.onto]
        if not self.onto or not self.hidden:
            raise ValueError(
                f"the projection is onto {len(self.onto)} of {outer.dimension} variables; keep at least one and hide at least one"
            )
        bounds = np.array(domain, dtype=np.float64)
        if bounds.shape != (len(self.hidden), 2) or not np.isfinite(bounds).all() or (bounds[:, 0] > bounds[:, 1]).any():
            raise ValueError(f"the domain is {domain}; give finite bounds (lower, upper) for each of the hidden variables {self.hidden}")
        if not precision > 0.0:
            raise ValueError(f"the precision is {precision}; give a positive number")
        if max_boxes < 1:
            raise ValueError(f"the number of boxes is {max_boxes}; give at least 1")
        self.domain, self.precision, self.max_boxes = bounds, precision, max_boxes

    def _narrow(self, boxes: Boxes) -> Boxes:
        hull = self._start(boxes)
        rows = occupied(boxes.lower, boxes.upper)
        waiting = [(rows, self._with_hidden(boxes[rows], self.domain[:, 0], self.domain[:, 1]))]
        looked_at = np.zeros(len(boxes), dtype=np.int64)
        while waiting:
            rows, parts = waiting.pop()
            if len(rows) > _BATCH:
                half = len(rows) // 2
                waiting += [(rows[half:], parts[half:]), (rows[:half], parts[:half])]
                continue
            rows, parts = self._look(hull, rows, parts)
            width = parts.upper[:, self.hidden] - parts.lower[:, self.hidden]
            axis = np.asarray(self.hidden)[width.argmax(axis=1)] if len(rows) else np.empty(0, dtype=np.int64)
            np.add.at(looked_at, rows, 1)
            wide = (width.max(axis=1, initial=0.0) > self.precision) & (looked_at[rows] < self.max_boxes)
            self._finish(hull, rows[~wide], parts[~wide])
            if wide.any():
                waiting.append((np.repeat(rows[wide], 2), parts[wide].bisect(axis[wide])))
        return hull

    def _with_hidden(self, boxes: Boxes, lower: FloatArray, upper: FloatArray) -> Boxes:
        """Return boxes of all variables: on the kept axes as given, on the hidden ones between some bounds."""
        all_lower, all_upper = np.empty((len(boxes), self.outer.dimension)), np.empty((len(boxes), self.outer.dimension))
        all_lower[:, self.onto], all_upper[:, self.onto] = boxes.lower, boxes.upper
        all_lower[:, self.hidden], all_upper[:, self.hidden] = lower, upper
        return Boxes(all_lower, all_upper)

    @abstractmethod
    def _start(self, boxes: Boxes) -> Boxes:
        """Return what is known of each row before the search."""

    @abstractmethod
    def _look(self, hull: Boxes, rows: IntArray, parts: Boxes) -> tuple[IntArray, Boxes]:
        """Look at boxes of all variables that belong to some rows; return those that deserve to be divided further."""

    @abstractmethod
    def _finish(self, hull: Boxes, rows: IntArray, parts: Boxes) -> None:
        """Account for boxes that are not divided further."""


class Projection(_Projection):
    """The values of some variables for which values of the others exist. See `projection`.

    Parameters
    ----------
    contractor, onto, domain, precision, max_boxes
        As for `projection`.

    Raises
    ------
    ValueError
        If the arguments do not fit.
    """

    def __init__(
        self,
        contractor: ContractorLike,
        onto: Sequence[int],
        domain: Sequence[tuple[float, float]],
        precision: float,
        max_boxes: int = 1024,
    ) -> None:
        super().__init__(contractor, onto, domain, precision, max_boxes)

    def _start(self, boxes: Boxes) -> Boxes:
        return emptied(len(boxes), self.dimension)  # the hull of what is left of the boxes that were finished

    def _look(self, hull: Boxes, rows: IntArray, parts: Boxes) -> tuple[IntArray, Boxes]:
        for contract in (False, True):
            if contract:
                parts = self.outer.contract(parts)
            kept = columns(parts, self.onto)
            useful = outside(rows, kept.lower, kept.upper, hull.lower, hull.upper)  # others would not change the hull
            rows, parts = rows[useful], parts[useful]
        return rows, parts

    def _finish(self, hull: Boxes, rows: IntArray, parts: Boxes) -> None:
        kept = columns(parts, self.onto)
        widen(rows, kept.lower, kept.upper, hull.lower, hull.upper)


class _InnerProjection(_Projection):
    """The values of some variables for which no values of the others are proved to exist.

    A point is removed if it belongs to the set together with *one* value of the hidden variables. So the inner contractor is applied to the
    row and single values: the middles of the boxes in which the outer contractor left some.
    """

    def __init__(
        self, separator: Separator, onto: Sequence[int], domain: Sequence[tuple[float, float]], precision: float, max_boxes: int
    ) -> None:
        super().__init__(separator.outer, onto, domain, precision, max_boxes)
        self.inner = separator.inner

    def _start(self, boxes: Boxes) -> Boxes:
        return Boxes(boxes.lower.copy(), boxes.upper.copy())  # what is left of the rows

    def _look(self, hull: Boxes, rows: IntArray, parts: Boxes) -> tuple[IntArray, Boxes]:
        parts = self.outer.contract(self._again(hull, rows, parts))
        left = occupied(parts.lower, parts.upper)
        rows, parts = rows[left], parts[left]
        values = columns(parts, self.hidden).midpoint()
        slices = self._again(hull, rows, parts, values)
        undecided = columns(self.inner.contract(slices), self.onto) & columns(slices, self.onto)
        np.maximum.at(hull.lower, rows, undecided.lower)
        np.minimum.at(hull.upper, rows, undecided.upper)
        done = hull.empty
        hull.lower[done], hull.upper[done] = np.inf, -np.inf
        going = ~done[rows]
        return rows[going], parts[going]

    def _again(self, hull: Boxes, rows: IntArray, parts: Boxes, values: FloatArray | None = None) -> Boxes:
        """Return what is now left of the rows, together with hidden variables as in `parts` or of single values."""
        lower, upper = (values, values) if values is not None else (parts.lower[:, self.hidden], parts.upper[:, self.hidden])
        return self._with_hidden(hull[rows], lower, upper)

    def _finish(self, hull: Boxes, rows: IntArray, parts: Boxes) -> None:
        """Leave the rows as they are: boxes were looked at before."""


@overload
def projection(
    contractor: Separator, onto: Sequence[int], domain: Sequence[tuple[float, float]], precision: float, max_boxes: int = ...
) -> Separator: ...
@overload
def projection(
    contractor: ContractorLike, onto: Sequence[int], domain: Sequence[tuple[float, float]], precision: float, max_boxes: int = ...
) -> Contractor: ...
def projection(
    contractor: Separator | ContractorLike,
    onto: Sequence[int],
    domain: Sequence[tuple[float, float]],
    precision: float,
    max_boxes: int = 1024,
) -> Contractor | Separator:
    """Return the constraint on some variables that values of the others exist: x such that (x, y) satisfies a constraint for some y.

    For each box the values of y are searched: the box is narrowed together with a box of values, which is bisected until it is at most
    `precision` wide; the hull over all values is what is left. Boxes of values that cannot change the hull are left out. The hull covers
    every x of the projection, whatever the precision; it comes closer to the projection as precision and box shrink, as far as
    the contractor does.

    The inner contractor of a separator removes x that belong to the set together with one of the values that were tried. It finds
    nothing if the set is thin in the hidden variables, as one given by equations is.

    Parameters
    ----------
    contractor
        A contractor or a separator on d variables.
    onto
        The variables to keep, in the order of the result: different numbers from 0 to d − 1.
    domain
        Where to search the other variables, in increasing order: finite bounds (lower, upper) for each.
    precision
        The width, in the units of the hidden variables, down to which their values are divided.
    max_boxes
        About how many boxes of values are looked at for one row; those not yet divided then are taken as they are.

    Raises
    ------
    ValueError
        If `onto` or `domain` do not fit, or `precision` or `max_boxes` is not positive.

    References
    ----------
    Jaulin, Desrochers: Introduction to the algebra of separators with application to path planning, Engineering Applications of
    Artificial Intelligence 33 (2014), section 3; Chabert, Jaulin: Contractor programming, Artificial Intelligence 173 (2009).
    """
    if isinstance(contractor, Separator):
        inner = _InnerProjection(contractor, onto, domain, precision, max_boxes)
        return Separator(inner=inner, outer=Projection(contractor.outer, onto, domain, precision, max_boxes))
    return Projection(contractor, onto, domain, precision, max_boxes)
