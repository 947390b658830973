"""`FunctionFamily`: functions of one form whose constants differ, and the preimages of one set under each of them."""

import numpy as np

from ial.contractors.boxes import Boxes, FloatArray
from ial.contractors.checked_contractor import CheckedContractor
from ial.contractors.combinators.relaxation import Relaxed
from ial.contractors.contractor import ContractorLike, require_dimension
from ial.contractors.expressions.expression import Expression
from ial.contractors.expressions.tape import Tape
from ial.contractors.intervals.interval import Interval
from ial.contractors.rounding import check_rounding
from ial.contractors.space import required_space


class FunctionFamily:
    """Several functions from points of one space to points of k dimensions, which differ only in their constants.

    Parameters
    ----------
    *expressions
        The k formulas, over one space. Arrays of m numbers, and `Boxes` of m intervals, are the constants that differ from function to
        function.

    Raises
    ------
    ValueError
        If no variable occurs, if variables were declared apart, or if constants have different numbers of rows.

    Examples
    --------
    Two beams, of length 1 and 2, that both end in the unit square:

    >>> import numpy as np
    >>> from ial.contractors import Boxes, FunctionFamily, Interval, intersection, variables
    >>> x, y = variables("x y")
    >>> ends = FunctionFamily(x + np.array([1.0, 2.0]), y)
    >>> square = (x == Interval(0, 1)) & (y == Interval(0, 1))
    >>> intersection(ends.preimage(square)).contract(Boxes.of([(-5, 5), (-5, 5)])).lower
    array([[-1.,  0.]])
    """

    def __init__(self, *expressions: Expression | Interval | float) -> None:
        self.space = required_space(expressions)
        self.expressions = tuple(Expression.of(expression) for expression in expressions)
        counts = {expression.count for expression in self.expressions if expression.count > 1}
        if len(counts) > 1:
            raise ValueError(f"the formulas stand for {' and '.join(map(str, sorted(counts)))} functions; there must be as many of each")
        self.dimension: int = self.space.dimension
        self.tape = Tape(self.dimension, self.expressions)

    def __repr__(self) -> str:
        return f"FunctionFamily({', '.join(map(repr, self.expressions))})"

    @property
    def count(self) -> int:
        """The number of functions m."""
        return self.tape.count

    @property
    def values(self) -> int:
        """The number k of formulas."""
        return len(self.expressions)

    def preimage(self, constraint: ContractorLike) -> "InverseFamily":
        """Return the m constraints that f_j(x) satisfies a constraint, for each function f_j.

        Parameters
        ----------
        constraint
            A contractor of dimension k.

        Raises
        ------
        ValueError
            If it is of another dimension.
        """
        return InverseFamily(self, constraint)


class InverseFamily(CheckedContractor):
    """The points x at which f_j is defined and f_j(x) satisfies a constraint, for each of m functions f_j: forward, contract, backward.

    As a contractor it stands for all m; `relaxed`, `union` and `intersection` count it as m members.

    Parameters
    ----------
    function
        The functions.
    contractor
        The constraint on their values.
    """

    def __init__(self, function: FunctionFamily, contractor: ContractorLike) -> None:
        if contractor.dimension != function.values:
            raise ValueError(
                f"the functions have {function.values} values; {type(contractor).__name__} has {contractor.dimension} dimensions"
            )
        self.dimension = function.dimension
        self.space = function.space
        self.function = function
        self.contractor = contractor

    @property
    def axes(self) -> tuple[int, ...]:
        """The sides of a box that the constraints depend on."""
        return tuple(sorted(self.function.tape.axes.tolist()))

    @property
    def count(self) -> int:
        """The number of constraints m."""
        return self.function.count

    def contract_each(self, boxes: Boxes) -> tuple[FloatArray, FloatArray]:
        """Return the bounds of each of n boxes narrowed by each of the m constraints, two arrays of shape (n, m, d).

        Raises
        ------
        ValueError
            If the boxes are of another dimension.
        """
        require_dimension(self, boxes)
        check_rounding()
        shape = (len(boxes), self.count, self.dimension)
        if not len(boxes):
            return np.empty(shape), np.empty(shape)
        values = Boxes(*self.function.tape.evaluate(boxes, self.count))
        values = self.contractor.contract(values.where(~values.empty))
        narrowed = self.function.tape.narrow(boxes, np.stack([values.lower, values.upper]), members=self.count)
        return narrowed.lower.reshape(shape), narrowed.upper.reshape(shape)

    def _narrow(self, boxes: Boxes) -> Boxes:
        return Relaxed(self, outliers=0).contract(boxes)
