"""Which side of a box matters most to a function."""

from collections.abc import Callable

import numpy as np

from ial.contractors.boxes import Boxes, FloatArray

Jacobian = Callable[[Boxes], tuple[FloatArray, FloatArray]]


def smear(jacobian: Jacobian) -> Callable[[Boxes], FloatArray]:
    """Return a bisection rule for `ial.contractors.paving.paver.pave`: the side along which some function may vary most.

    The weight of a side is its width times the largest size of ∂f_j/∂x_i in the box, for the function f_j where that is largest.

    Parameters
    ----------
    jacobian
        For n boxes of d dimensions, lower and upper bounds of the derivatives of m functions: two arrays of shape (n, m, d). They decide
        only what is bisected: no bound of the result depends on them.

    Returns
    -------
    Callable
        A function of `Boxes` that gives weights of shape (n, d).

    References
    ----------
    Kearfott, Novoa: INTBIS, a portable interval Newton/bisection package, ACM Transactions on Mathematical Software 16 (1990).
    """

    def rule(boxes: Boxes) -> FloatArray:
        lower, upper = (np.asarray(bound, dtype=np.float64) for bound in jacobian(boxes))
        if lower.ndim != 3 or lower.shape != upper.shape or (lower.shape[0], lower.shape[2]) != boxes.lower.shape:
            raise ValueError(
                f"the Jacobian has bounds of shape {lower.shape} and {upper.shape} for {len(boxes)} boxes of {boxes.dimension} dimensions; "
                "both must be (boxes, functions, dimensions)"
            )
        steepest = np.maximum(np.abs(lower), np.abs(upper)).max(axis=1, initial=0.0)
        with np.errstate(invalid="ignore", over="ignore"):
            weights = steepest * boxes.width()
        return np.where(np.isnan(weights), 0.0, weights)  # 0·∞: a function that does not depend on an unbounded side

    return rule
