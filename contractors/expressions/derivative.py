"""Derivatives of expressions, as expressions, and where a formula is defined or continuous."""

from collections.abc import Sequence
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from ial.contractors.expressions.operation import IntervalArrays
from ial.contractors.expressions.tape import Node, ordered
from ial.contractors.intervals.interval import Interval


def gradient(expression: Node, dimension: int) -> list[Any] | None:
    """Return the partial derivatives by each variable: expressions, or intervals where they are constant.

    The chain rule from the result back to the variables (reverse accumulation), so that all of them together cost about as much as a few
    evaluations of the expression.

    Parameters
    ----------
    expression
        The formula.
    dimension
        The number of variables.

    Returns
    -------
    list or None
        None if the formula holds an operation without a known derivative.

    References
    ----------
    Griewank, Walther: Evaluating derivatives, SIAM 2008, section 3.2.
    """
    by_axis: list[Any] = [Interval(0.0)] * dimension
    adjoints: dict[int, Any] = {id(expression): Interval(1.0)}
    for node in reversed(ordered([expression])):
        adjoint = adjoints.get(id(node))
        if adjoint is None or node.bounds is not None:
            continue
        if node.axis is not None:
            by_axis[node.axis] = _sum(by_axis[node.axis], adjoint)
            continue
        assert node.operation is not None
        if node.operation.derivative is None:
            return None
        slopes = node.operation.derivative(*node.operands, node)
        if len(slopes) != len(node.operands):
            raise ValueError(
                f"the derivative of {node.operation.name} has {len(slopes)} parts for {len(node.operands)} operands; give one for each"
            )
        for operand, slope in zip(node.operands, slopes, strict=True):
            if operand.bounds is None:
                term = adjoint * slope
                adjoints[id(operand)] = _sum(adjoints[id(operand)], term) if id(operand) in adjoints else term
    return by_axis


def _sum(a: Any, b: Any) -> Any:
    return b if isinstance(a, Interval) and a.lower == a.upper == 0.0 else a + b


def conditions(expressions: Sequence[Node], kind: Literal["defined", "continuous"]) -> tuple[list[Node], IntervalArrays]:
    """Return when some expressions are defined, or defined and continuous: expressions, and the bounds that each must keep.

    Parameters
    ----------
    expressions
        The formulas.
    kind
        What is asked.

    Returns
    -------
    list, (numpy.ndarray, numpy.ndarray)
        Guards and their bounds. If every guard's range on a box lies within its bounds, all formulas are defined there.
    """
    guards: list[Node] = []
    bounds: list[Interval] = []
    for node in ordered(expressions):
        rule = getattr(node.operation, kind, None)
        for guard, interval in rule(*node.operands) if rule else ():
            guards.append(guard)
            bounds.append(interval)
    return guards, (np.array([interval.lower for interval in bounds]), np.array([interval.upper for interval in bounds]))


def met(ranges: IntervalArrays, bounds: IntervalArrays) -> npt.NDArray[np.bool_]:
    """Return on which rows all guards keep their bounds; a guard without a value does not."""
    (lower, upper), (least, most) = ranges, bounds
    return np.asarray(((lower <= upper) & (least <= lower) & (upper <= most)).all(axis=1))
