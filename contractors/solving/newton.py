"""The interval Newton method: boxes narrowed around the zeros of a square system, and proofs that a box holds exactly one."""

import numpy as np
import numpy.typing as npt

from ial.contractors.boxes import Boxes
from ial.contractors.checked_contractor import CheckedContractor
from ial.contractors.contractor import require_dimension
from ial.contractors.expressions.function import Function
from ial.contractors.intervals.arithmetic import add, mul, sub
from ial.contractors.intervals.reverse import mul_reverse
from ial.contractors.intervals.sets import intersect, midpoint
from ial.contractors.kernels import kernel
from ial.contractors.rounding import check_rounding
from ial.contractors.threads import run


class Newton(CheckedContractor):
    """The zeros of a function from n to n dimensions: points x at which f is defined and f(x) = 0.

    A box is narrowed by forward and backward evaluation of f(x) = 0, and then by its mean-value form C·f(m) + C·J·(x − m) = 0, with m the
    middle of the box, J bounds of the derivatives on it and C about the inverse of the middle of J. One step solves it for all sides, by
    Krawczyk's operator, and for one side after the other (Gauss–Seidel), with division into two pieces. Near a zero at which the derivative
    is regular, repeated steps converge quadratically. Boxes on which f is not defined and continuous everywhere are only evaluated.

    Any matrix C of numbers is sound. Where no inverse is found, it is the identity.

    Parameters
    ----------
    function
        The function f.

    Raises
    ------
    TypeError
        If a formula holds an operation without a known derivative.
    ValueError
        If the function has not as many values as variables.

    References
    ----------
    Krawczyk: Newton-Algorithmen zur Bestimmung von Nullstellen mit Fehlerschranken, Computing 4 (1969). Hansen, Sengupta: Bounding
    solutions of systems of equations using interval analysis, BIT 21 (1981). Neumaier: Interval Methods for Systems of Equations,
    Cambridge 1990, chapter 5. Moore, Kearfott, Cloud: Introduction to Interval Analysis, SIAM 2009, chapter 8.
    """

    def __init__(self, function: Function) -> None:
        if function.values != function.dimension:
            raise ValueError(
                f"the function has {function.values} values and {function.dimension} variables; Newton's method needs as many of both"
            )
        self.dimension = function.dimension
        self.function = function
        function.jacobian(Boxes.none(self.dimension))  # raises where no derivative is known

    def __repr__(self) -> str:
        return f"Newton({self.function!r})"

    @property
    def axes(self) -> tuple[int, ...]:
        """The sides of a box that the function depends on."""
        return tuple(sorted(self.function.tape.axes.tolist()))

    def step(self, boxes: Boxes) -> tuple[Boxes, npt.NDArray[np.bool_]]:
        """Return the narrowed boxes, and which of the given boxes are proved to hold exactly one zero, shape (n,).

        Proved: f is defined and continuous on the box, and Krawczyk's operator maps it into its interior; an unbounded box into a bounded
        part of it, of which the same is then true. If the formulas hold intervals as constants, this is so for every choice of numbers
        from them.

        Raises
        ------
        ValueError
            If the boxes are of another dimension.
        """
        require_dimension(self, boxes)
        check_rounding()
        lower, upper = boxes.lower.copy(), boxes.upper.copy()
        proved = np.zeros(len(boxes), dtype=np.bool_)
        rows = np.flatnonzero(self.function.holds("continuous", boxes)) if len(boxes) else np.empty(0, dtype=np.int64)
        if len(rows):
            chosen = boxes[rows]
            middle = chosen.midpoint()
            values, slopes = self.function.image(Boxes(middle, middle)), self.function.jacobian(chosen)
            run(_solve, len(rows), rows, middle, values.lower, values.upper, *slopes, lower, upper, proved, minimum=64)
        # A proof is about the box as it was given, so backward evaluation comes last.
        return self._evaluated(Boxes(lower, upper)), proved

    def _narrow(self, boxes: Boxes) -> Boxes:
        return self.step(self._evaluated(boxes))[0]

    def _evaluated(self, boxes: Boxes) -> Boxes:
        return self.function.tape.narrow(boxes, np.zeros((2, 1, self.dimension)))


@kernel
def _write_identity(matrix):  # type: ignore[no-untyped-def]
    for i in range(len(matrix)):
        for j in range(len(matrix)):
            matrix[i, j] = 1.0 if i == j else 0.0


@kernel
def _invert(matrix, inverse):  # type: ignore[no-untyped-def]
    """Write about the inverse of a square matrix, by elimination with row pivots, or the identity. The matrix is overwritten."""
    n = len(matrix)
    _write_identity(inverse)
    regular = True
    for k in range(n):
        pivot = k
        for i in range(k + 1, n):
            pivot = i if abs(matrix[i, k]) > abs(matrix[pivot, k]) else pivot
        for j in range(n):
            matrix[k, j], matrix[pivot, j] = matrix[pivot, j], matrix[k, j]
            inverse[k, j], inverse[pivot, j] = inverse[pivot, j], inverse[k, j]
        scale = 1.0 / matrix[k, k]
        regular &= abs(scale) < np.inf
        for j in range(n):
            matrix[k, j] *= scale
            inverse[k, j] *= scale
        for i in range(n):
            factor = matrix[i, k] if i != k else 0.0
            for j in range(n):
                matrix[i, j] -= factor * matrix[k, j]
                inverse[i, j] -= factor * inverse[k, j]
    for i in range(n):
        for j in range(n):
            regular &= abs(inverse[i, j]) < np.inf
    if not regular:
        _write_identity(inverse)


@kernel
def _precondition(inverse, fl, fu, jl, ju, bl, bu, al, au):  # type: ignore[no-untyped-def]
    """Write b = C·f and A = C·J."""
    n = len(inverse)
    for i in range(n):
        bl[i] = bu[i] = 0.0
        al[i] = 0.0
        au[i] = 0.0
        for k in range(n):
            c = inverse[i, k]
            bl[i], bu[i] = add(bl[i], bu[i], *mul(c, c, fl[k], fu[k]))
            for j in range(n):
                al[i, j], au[i, j] = add(al[i, j], au[i, j], *mul(c, c, jl[k, j], ju[k, j]))


@kernel
def _sum_beside(i, bl, bu, al, au, dl, du):  # type: ignore[no-untyped-def]
    """Return −(b_i + Σ A_ij·d_j) over all j but i: what A_ii·d_i must be."""
    sl, su = bl[i], bu[i]
    for j in range(len(bl)):
        if j != i:
            sl, su = add(sl, su, *mul(al[i, j], au[i, j], dl[j], du[j]))
    return -su, -sl


@kernel
def _solve(start, stop, rows, middle, fl, fu, jl, ju, lower, upper, proved):  # type: ignore[no-untyped-def]
    """Narrow the box of row ``rows[i]`` by C·f(m) + C·J·(x − m) = 0, in place, and note whether it is proved to hold one zero."""
    n = middle.shape[1]
    centre, inverse = np.empty((n, n)), np.empty((n, n))
    al, au = np.empty((n, n)), np.empty((n, n))  # A = C·J
    bl, bu = np.empty(n), np.empty(n)  # b = C·f(m)
    kl, ku = np.empty(n), np.empty(n)  # Krawczyk's image of the box
    dl, du = np.empty(n), np.empty(n)  # d = x − m
    for i in range(start, stop):
        row, m = rows[i], middle[i]
        low, high = lower[row], upper[row]
        known = True
        for k in range(n):
            known &= fl[i, k] <= fu[i, k]
            dl[k], du[k] = sub(low[k], high[k], m[k], m[k])
            for j in range(n):
                known &= jl[i, k, j] <= ju[i, k, j]
                centre[k, j] = midpoint(jl[i, k, j], ju[i, k, j])
        if not known:
            continue  # f or a derivative has no value
        _invert(centre, inverse)
        _precondition(inverse, fl[i], fu[i], jl[i], ju[i], bl, bu, al, au)
        inside, empty = True, False
        for k in range(n):
            # Krawczyk: x = m − b + (1 − A)·d, on all sides of the box as it was given.
            sl, su = _sum_beside(k, bl, bu, al, au, dl, du)
            sl, su = add(sl, su, *mul(*sub(1.0, 1.0, al[k, k], au[k, k]), dl[k], du[k]))
            kl[k], ku[k] = add(sl, su, m[k], m[k])
            inside &= (low[k] < kl[k]) & (ku[k] < high[k])
        for k in range(n):
            # Gauss–Seidel: with the sides before this one as narrowed by now.
            dl[k], du[k] = mul_reverse(al[k, k], au[k, k], *_sum_beside(k, bl, bu, al, au, dl, du), dl[k], du[k])
            sl, su = intersect(low[k], high[k], *add(dl[k], du[k], m[k], m[k]))
            low[k], high[k] = intersect(sl, su, kl[k], ku[k])
            empty |= low[k] > high[k]
            if empty:
                break
        proved[row] = inside
        if empty:
            low[:] = np.inf
            high[:] = -np.inf
