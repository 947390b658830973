"""`Function`: several expressions as a function of boxes, with its derivatives and the preimages of sets."""

from typing import Literal, overload

import numpy as np
import numpy.typing as npt

from ial.contractors.boxes import Boxes
from ial.contractors.checked_contractor import CheckedContractor
from ial.contractors.contractor import Contractor, ContractorLike, complement, require_dimension
from ial.contractors.expressions.derivative import conditions, gradient, met
from ial.contractors.expressions.expression import Expression
from ial.contractors.expressions.operation import IntervalArrays
from ial.contractors.expressions.tape import Tape
from ial.contractors.intervals.interval import Interval
from ial.contractors.rounding import check_rounding
from ial.contractors.separator import Separator
from ial.contractors.space import required_space


class Function:
    """A function from points of one space to points of m dimensions, as what it does to boxes.

    Parameters
    ----------
    *expressions
        The m formulas, over one space. At least one must hold a variable.

    Raises
    ------
    ValueError
        If no variable occurs, if variables were declared apart, or if constants differ from row to row.

    Examples
    --------
    >>> from ial.contractors import Boxes, Function, variables
    >>> x, y = variables("x y")
    >>> Function(x + y, x * y).image(Boxes.of([(1, 2), (3, 4)])).upper
    array([[6., 8.]])
    """

    def __init__(self, *expressions: Expression | Interval | float) -> None:
        self.space = required_space(expressions)
        self.expressions = tuple(Expression.of(expression) for expression in expressions)
        self.dimension: int = self.space.dimension
        self.tape = Tape(self.dimension, self.expressions)
        if self.tape.count > 1:
            raise ValueError("the formulas hold constants that differ from row to row, so they are several functions; use a FunctionFamily")
        self._gradients = [gradient(expression, self.dimension) for expression in self.expressions]
        self._jacobian: Tape | None = None
        self._conditions: dict[str, tuple[Tape, IntervalArrays]] = {}

    def __repr__(self) -> str:
        return f"Function({', '.join(map(repr, self.expressions))})"

    @property
    def values(self) -> int:
        """The number m of formulas."""
        return len(self.expressions)

    def image(self, boxes: Boxes) -> Boxes:
        """Return, for each box, a box that contains the value at every point of it where all formulas are defined.

        The natural extension: each operation is applied to intervals, so a variable that occurs once costs nothing but rounding. A row
        without any such point is empty.

        Raises
        ------
        ValueError
            If the boxes are of another dimension.
        """
        require_dimension(self, boxes)
        ranges = Boxes(*self.tape.evaluate(boxes))
        return ranges.where(~(ranges.empty | boxes.empty))

    def jacobian(self, boxes: Boxes) -> IntervalArrays:
        """Return bounds of the partial derivatives on each box, lower and upper, each float64 of shape (n, m, d).

        Raises
        ------
        TypeError
            If a formula holds an operation without a known derivative.
        ValueError
            If the boxes are of another dimension.
        """
        require_dimension(self, boxes)
        if self._jacobian is None:
            for expression, partial in zip(self.expressions, self._gradients, strict=True):
                if partial is None:
                    raise TypeError(f"{expression} holds an operation without a derivative")
            self._jacobian = Tape(self.dimension, [part for partial in self._gradients if partial is not None for part in partial])
        shape = (len(boxes), self.values, self.dimension)
        lower, upper = self._jacobian.evaluate(boxes)
        return lower.reshape(shape), upper.reshape(shape)

    def holds(self, kind: Literal["defined", "continuous"], boxes: Boxes) -> npt.NDArray[np.bool_]:
        """Return on which boxes all formulas are ``"defined"``, or ``"continuous"``, at every point; shape (n,)."""
        require_dimension(self, boxes)
        if kind not in self._conditions:
            guards, bounds = conditions(self.expressions, kind)
            self._conditions[kind] = Tape(self.dimension, guards), bounds
        tape, bounds = self._conditions[kind]
        return met(tape.evaluate(boxes), bounds) & ~boxes.empty

    @overload
    def preimage(self, constraint: Separator) -> Separator: ...
    @overload
    def preimage(self, constraint: ContractorLike) -> Contractor: ...
    def preimage(self, constraint: Separator | ContractorLike) -> Separator | Contractor:
        """Return the constraint that f(x) satisfies a constraint, for this function f.

        Parameters
        ----------
        constraint
            A contractor or a separator of dimension m.

        Raises
        ------
        ValueError
            If it is of another dimension.
        """
        if isinstance(constraint, Separator):
            return Separator(inner=Outside(self, constraint.inner), outer=Inverse(self, constraint.outer))
        return Inverse(self, constraint)


class Inverse(CheckedContractor):
    """The points x at which f is defined and f(x) satisfies a constraint: forward, contract, backward.

    Parameters
    ----------
    function
        The function f.
    contractor
        The constraint on its value.
    """

    def __init__(self, function: Function, contractor: ContractorLike) -> None:
        if contractor.dimension != function.values:
            raise ValueError(
                f"the function has {function.values} values; {type(contractor).__name__} has {contractor.dimension} dimensions"
            )
        self.dimension = function.dimension
        self.space = function.space
        self.function = function
        self.contractor = contractor

    @property
    def axes(self) -> tuple[int, ...]:
        """The sides of a box that the constraint depends on."""
        return tuple(sorted(self.function.tape.axes.tolist()))

    def complement(self) -> Contractor:
        """Return the points at which f(x) does not satisfy the constraint or is not defined.

        Raises
        ------
        TypeError
            If the complement of the constraint is not known.
        """
        return Outside(self.function, complement(self.contractor))

    def _narrow(self, boxes: Boxes) -> Boxes:
        values = self.contractor.contract(self.function.image(boxes))
        return self.function.tape.narrow(boxes, np.stack([values.lower, values.upper])) if len(boxes) else boxes


class Outside(Inverse):
    """The same, and the points at which f is not defined: only boxes on which it is defined everywhere are narrowed."""

    def complement(self) -> Contractor:
        """Return the points at which f is defined and its value satisfies the complement.

        Raises
        ------
        TypeError
            If the complement of the constraint is not known.
        """
        return Inverse(self.function, complement(self.contractor))

    def _narrow(self, boxes: Boxes) -> Boxes:
        check_rounding()
        narrowed = super()._narrow(boxes)
        keep = self.function.holds("defined", boxes)[:, None]
        return Boxes(np.where(keep, narrowed.lower, boxes.lower), np.where(keep, narrowed.upper, boxes.upper))
