"""The mean-value form: a constraint made linear on each box, which narrows small boxes more than forward–backward contraction can."""

import numpy as np

from ial.contractors.boxes import Boxes
from ial.contractors.checked_contractor import CheckedContractor
from ial.contractors.contractor import Contractor
from ial.contractors.expressions.constraint import Constraint, ConstraintFamily
from ial.contractors.expressions.function import Function
from ial.contractors.expressions.tape import Node, ordered
from ial.contractors.intervals.arithmetic import add, mul, sub
from ial.contractors.intervals.reverse import mul_reverse
from ial.contractors.intervals.sets import intersect
from ial.contractors.kernels import kernel
from ial.contractors.threads import run


class MeanValue(CheckedContractor):
    """A constraint f(x) ∈ Y narrowed by f(m) + J·(x − m) ∈ Y, with m the middle of the box and J the derivatives on it. See `mean_value`.

    Parameters
    ----------
    constraint
        The constraint.

    Raises
    ------
    TypeError
        If an expression holds an operation without a known derivative.
    """

    def __init__(self, constraint: Constraint) -> None:
        self.dimension = constraint.dimension
        self.space = constraint.space
        self.constraint = constraint
        self.function = Function(*(expression for expression, _ in constraint.relations))  # type: ignore[arg-type]
        self.function.jacobian(Boxes.none(self.dimension))
        bounds = np.array([(lower[0], upper[0]) for _, (lower, upper) in constraint.relations])
        self._lower, self._upper = np.ascontiguousarray(bounds[:, 0]), np.ascontiguousarray(bounds[:, 1])

    def complement(self) -> Contractor:
        """Return the complement of the constraint."""
        return self.constraint.complement()

    def _narrow(self, boxes: Boxes) -> Boxes:
        boxes = self.constraint.contract(boxes)
        rows = np.flatnonzero(~boxes.empty)
        rows = rows[self.function.holds("continuous", boxes[rows])]
        if not len(rows):
            return boxes
        chosen = boxes[rows]
        middle = chosen.midpoint()
        values = self.function.image(Boxes(middle, middle))
        slopes = self.function.jacobian(chosen)
        lower, upper = boxes.lower.copy(), boxes.upper.copy()
        run(_linear, len(rows), rows, middle, values.lower, values.upper, *slopes, self._lower, self._upper, lower, upper)
        return Boxes(lower, upper)


def mean_value(constraint: Constraint) -> Contractor:
    """Return a constraint with a second way of contraction, the mean-value form, after forward–backward contraction.

    It helps where a variable occurs several times, on boxes so small that the derivatives hardly vary: forward–backward contraction is then
    off by an amount in proportion to the width of the box, the mean-value form by its square. It costs several evaluations. A constraint
    in which every variable occurs once is returned as it is, since forward–backward contraction is then as good.

    Boxes on which an expression is not defined and continuous everywhere are left to forward–backward contraction.

    Parameters
    ----------
    constraint
        A constraint whose constants do not differ from row to row.

    Raises
    ------
    TypeError
        If the constants differ from row to row, or an operation has no known derivative.

    References
    ----------
    Moore, Kearfott, Cloud: Introduction to Interval Analysis, SIAM 2009, section 6.3; Trombettoni, Araya, Neveu, Chabert: Inner regions
    and interval linearizations for global optimization, AAAI 2011.
    """
    if isinstance(constraint, ConstraintFamily):
        raise TypeError("the mean-value form needs one value of each constant; the constants of this constraint differ from row to row")
    return MeanValue(constraint) if repeats([expression for expression, _ in constraint.relations]) else constraint


def repeats(expressions: list[Node]) -> bool:
    """Return whether some variable, or a subexpression that holds one, is used more than once."""
    used = [id(operand) for node in ordered(expressions) for operand in node.operands if operand.bounds is None]
    return len(used) > len(set(used)) or len(expressions) > 1


@kernel
def _linear(start, stop, rows, middle, fl, fu, jl, ju, yl, yu, lower, upper):  # type: ignore[no-untyped-def]
    """Narrow the box of row ``rows[i]`` by y = f(m) + Σ J·(x − m), in place."""
    dimension = middle.shape[1]
    # Of the terms J·(x − m): sums of those before each axis, and the offsets x − m.
    before_lower, before_upper = np.empty(dimension + 1), np.empty(dimension + 1)
    offset_lower, offset_upper = np.empty(dimension), np.empty(dimension)
    for i in range(start, stop):
        low, high = lower[rows[i]], upper[rows[i]]
        for k in range(len(yl)):
            if not fl[i, k] <= fu[i, k]:
                continue  # f has no value at m
            # What the sum of all terms must be, and then the same without the terms after the axis in hand.
            restl, restu = sub(yl[k], yu[k], fl[i, k], fu[i, k])
            before_lower[0] = before_upper[0] = 0.0
            known = True
            for axis in range(dimension):
                known &= jl[i, k, axis] <= ju[i, k, axis]
                m = middle[i, axis]
                offset_lower[axis], offset_upper[axis] = sub(low[axis], high[axis], m, m)
                term = mul(jl[i, k, axis], ju[i, k, axis], offset_lower[axis], offset_upper[axis])
                before_lower[axis + 1], before_upper[axis + 1] = add(before_lower[axis], before_upper[axis], *term)
            if not known:
                continue
            for axis in range(dimension - 1, -1, -1):
                m = middle[i, axis]
                left = sub(restl, restu, before_lower[axis], before_upper[axis])
                xl, xu = mul_reverse(jl[i, k, axis], ju[i, k, axis], *left, offset_lower[axis], offset_upper[axis])
                restl, restu = sub(restl, restu, *mul(jl[i, k, axis], ju[i, k, axis], xl, xu))
                low[axis], high[axis] = intersect(low[axis], high[axis], *add(xl, xu, m, m))
            empty = False
            for axis in range(dimension):
                empty |= low[axis] > high[axis]
            if empty:
                low[:] = np.inf
                high[:] = -np.inf
                break
