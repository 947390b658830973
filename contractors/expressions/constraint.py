"""`Constraint`: expressions that must lie in intervals, as a contractor by forward and backward evaluation."""

import functools
from collections.abc import Sequence
from typing import Any

import numpy as np

from ial.contractors.boxes import Boxes, FloatArray
from ial.contractors.checked_contractor import CheckedContractor
from ial.contractors.combinators.relaxation import Relaxed
from ial.contractors.contractor import Contractor, require_dimension
from ial.contractors.expressions.derivative import conditions, met
from ial.contractors.expressions.operation import IntervalArrays
from ial.contractors.expressions.tape import Node, Tape
from ial.contractors.space import Space

Relation = tuple[Node, IntervalArrays]
"""An expression and the bounds it must lie in, two arrays of one value, or of one for each row of the constants."""


class Constraint(CheckedContractor):
    """Expressions that must lie in intervals: {x : f_j(x) ∈ Y_j for all j}, where f_j is defined.

    Made by comparing an expression, and joined by ``&``; boxes have one side for each variable of the space, in the order of declaration.
    Contraction is HC4-revise on all expressions together: they are evaluated forward on the box, met with their intervals, and every
    operation is followed backward to its operands.

    Parameters
    ----------
    space
        The variables.
    relations
        The expressions and their intervals.
    text
        How the constraint is printed.

    References
    ----------
    Benhamou, Goualard, Granvilliers, Puget: Revising hull and box consistency, ICLP 1999.
    """

    def __init__(self, space: Space, relations: Sequence[Relation], text: str) -> None:
        self.space: Space = space
        self.dimension = space.dimension
        self.relations = tuple(relations)
        self.text = text
        self.tape = Tape(self.dimension, [expression for expression, _ in relations])
        rows = max(len(lower) for _, (lower, _) in relations)
        self._targets = np.empty((2, rows, len(relations)))
        for k, (_, bounds) in enumerate(relations):
            self._targets[:, :, k] = bounds

    @property
    def axes(self) -> tuple[int, ...]:
        """The sides of a box that the constraint depends on."""
        return tuple(sorted(self.tape.axes.tolist()))

    def _narrow(self, boxes: Boxes) -> Boxes:
        return self.tape.narrow(boxes, self._targets)

    def complement(self) -> Contractor:
        """Return the points at which an expression lies outside its interval or is not defined, and the boundary."""
        return Complement(self)

    def __and__(self, other: Any) -> Any:
        if type(other) is Constraint and type(self) is Constraint and other.space == self.space:
            return Constraint(self.space, [*self.relations, *other.relations], f"({self}) & ({other})")
        return super().__and__(other)

    def __bool__(self) -> bool:
        raise TypeError(
            f"the constraint {self} has no truth value; write a & b instead of 'a and b', a | b instead of 'a or b', "
            "and x == Interval(lower, upper) instead of 'lower <= x <= upper'"
        )

    def __repr__(self) -> str:
        return self.text


class ConstraintFamily(Constraint):
    """The same for constants that differ from row to row: m constraints of one form, for example one for each beam of a scan.

    As a contractor it stands for all of them, each applied to the box as it was given; `relaxed`, `union` and `intersection` count it as
    m members.
    """

    @property
    def count(self) -> int:
        """The number of constraints m."""
        return max(self.tape.count, self._targets.shape[1])

    def contract_each(self, boxes: Boxes) -> tuple[FloatArray, FloatArray]:
        """Return the bounds of each of n boxes narrowed by each of the m constraints, two arrays of shape (n, m, d).

        Raises
        ------
        ValueError
            If the boxes are of another dimension.
        """
        require_dimension(self, boxes)
        shape = (len(boxes), self.count, self.dimension)
        narrowed = self.tape.narrow(boxes, self._targets, members=self.count)
        return narrowed.lower.reshape(shape), narrowed.upper.reshape(shape)

    def contract_rows(self, boxes: Boxes) -> Boxes:
        """Return each of m boxes narrowed by the constraint of its own row.

        Raises
        ------
        ValueError
            If there are not as many boxes as constraints, or they are of another dimension.
        """
        require_dimension(self, boxes)
        if len(boxes) != self.count:
            raise ValueError(f"there are {len(boxes)} boxes and {self.count} constraints; give one box for each constraint")
        return self.tape.narrow(boxes, self._targets)

    def _narrow(self, boxes: Boxes) -> Boxes:
        return Relaxed(self, outliers=0).contract(boxes)


class Complement(CheckedContractor):
    """The points that do not satisfy a constraint, because an expression lies outside its interval or is not defined.

    Only boxes on which all expressions are defined everywhere are narrowed: what forward–backward contraction removes of another box might
    be a point without a value, which is no solution.

    Parameters
    ----------
    constraint
        The constraint.
    """

    def __init__(self, constraint: Constraint) -> None:
        self.dimension = constraint.dimension
        self.space: Space = constraint.space
        self.constraint = constraint
        expressions = [expression for expression, _ in constraint.relations]
        self._guards, self._intervals = conditions(expressions, "defined")
        self._guard = Tape(self.dimension, self._guards) if self._guards else None
        # The complement of each interval is at most two half lines.
        self._sides: list[tuple[Tape, FloatArray]] = []
        for expression, (lower, upper) in constraint.relations:
            tape = Tape(self.dimension, [expression])
            for low, high in ((np.full_like(lower, -np.inf), lower), (upper, np.full_like(upper, np.inf))):
                kept = (low < np.inf) & (high > -np.inf)
                outside = np.where(lower > upper, -np.inf, low), np.where(lower > upper, np.inf, high)  # nothing lies in an empty interval
                if kept.any():
                    bounds = [np.where(kept, bound, empty)[:, None] for bound, empty in zip(outside, (np.inf, -np.inf), strict=True)]
                    self._sides.append((tape, np.stack(bounds)))

    def complement(self) -> Constraint:
        """Return the constraint itself."""
        return self.constraint

    def _narrow(self, boxes: Boxes) -> Boxes:
        count = getattr(self.constraint, "count", 1)
        shape = (len(boxes), count, self.dimension)
        parts = [tape.narrow(boxes, targets, members=count) for tape, targets in self._sides]
        if count > 1:
            parts = [Boxes(part.lower.reshape(shape).min(axis=1), part.upper.reshape(shape).max(axis=1)) for part in parts]
        narrowed = functools.reduce(Boxes.__or__, parts) if parts else boxes.where(np.zeros(len(boxes), dtype=np.bool_))
        if self._guard is None:
            return narrowed
        defined = np.asarray(met(self._guard.evaluate(boxes, count), self._intervals).reshape(shape[:2]).all(axis=1))
        keep = defined[:, None]
        return Boxes(np.where(keep, narrowed.lower, boxes.lower), np.where(keep, narrowed.upper, boxes.upper))

    def __repr__(self) -> str:
        return f"~({self.constraint})"
