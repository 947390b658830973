"""Affine bijections of boxes: shifts, rotations, scalings, and their inverses, rounded outward."""

import numpy as np
import numpy.typing as npt

from ial.contractors.boxes import Boxes, FloatArray
from ial.contractors.intervals.arithmetic import add, div, mul, sub
from ial.contractors.intervals.trigonometric import cos, sin
from ial.contractors.kernels import kernel
from ial.contractors.rounding import check_rounding
from ial.contractors.threads import run

Pair = tuple[FloatArray, FloatArray]


@kernel
def _map(start, stop, matrix_lower, matrix_upper, origin, offset, lower, upper, out_lower, out_upper):  # type: ignore[no-untyped-def]
    """Write M·(x − origin) + offset. An empty side makes every sum empty."""
    dimension = len(offset)
    for i in range(start, stop):
        for row in range(dimension):
            suml, sumu = offset[row], offset[row]
            for axis in range(dimension):
                xl, xu = sub(lower[i, axis], upper[i, axis], origin[axis], origin[axis])
                suml, sumu = add(suml, sumu, *mul(matrix_lower[row, axis], matrix_upper[row, axis], xl, xu))
            out_lower[i, row], out_upper[i, row] = suml, sumu


@kernel
def _invert(lower, upper, inverse_lower, inverse_upper):  # type: ignore[no-untyped-def]
    """Write an enclosure of the inverse by Gauss–Jordan elimination in intervals; return whether no pivot may be 0."""
    size = len(lower)
    for row in range(size):
        for column in range(size):
            inverse_lower[row, column] = inverse_upper[row, column] = row == column
    for column in range(size):
        pivot, best = column, -1.0
        for row in range(column, size):
            least = max(lower[row, column], -upper[row, column])  # the least absolute value, if positive
            if least > best:
                pivot, best = row, least
        if not best > 0.0:
            return False
        for bound in (lower, upper, inverse_lower, inverse_upper):
            for k in range(size):
                bound[column, k], bound[pivot, k] = bound[pivot, k], bound[column, k]
        pl, pu = lower[column, column], upper[column, column]
        for low, high in ((lower, upper), (inverse_lower, inverse_upper)):
            for k in range(size):
                low[column, k], high[column, k] = div(low[column, k], high[column, k], pl, pu)
        for row in range(size):
            if row != column:
                fl, fu = lower[row, column], upper[row, column]
                for low, high in ((lower, upper), (inverse_lower, inverse_upper)):
                    for k in range(size):
                        low[row, k], high[row, k] = sub(low[row, k], high[row, k], *mul(fl, fu, low[column, k], high[column, k]))
    return True


class Affine:
    """The bijection x ↦ M·x + b of d-dimensional space, for exact doubles M and b, as a `preimage.BoxFunction`.

    Parameters
    ----------
    matrix
        M, finite, of shape (d, d).
    offset
        b, finite, of shape (d,).

    Raises
    ------
    ValueError
        If the shapes do not fit, a number is not finite, or M cannot be proved to be invertible.
    """

    def __init__(self, matrix: npt.ArrayLike, offset: npt.ArrayLike) -> None:
        check_rounding()
        exact, shift = np.array(matrix, dtype=np.float64), np.array(offset, dtype=np.float64)
        if shift.ndim != 1 or not shift.size or exact.shape != (len(shift), len(shift)):
            raise ValueError(f"the matrix has shape {exact.shape} and the offset {shift.shape}; they must be (d, d) and (d,)")
        if not (np.isfinite(exact).all() and np.isfinite(shift).all()):
            raise ValueError("the matrix or the offset holds a number that is not finite")
        inverse = np.empty_like(exact), np.empty_like(exact)
        if not _invert(exact.copy(), exact.copy(), *inverse):
            raise ValueError("the matrix cannot be proved to be invertible: it is singular, or nearly so")
        self._set((exact, exact), inverse, np.zeros_like(shift), shift)

    def __repr__(self) -> str:
        return f"<Affine map of {self.dimension} dimensions>"

    def _set(self, matrix: Pair, inverse: Pair, origin: FloatArray, offset: FloatArray) -> None:
        self._matrix, self._inverse, self._origin, self._offset = matrix, inverse, origin, offset
        self.dimension = len(offset)

    @classmethod
    def rigid(cls, x: float, y: float, heading_rad: float) -> "Affine":
        """Return the motion of the plane that turns by a heading about the origin and then shifts by (x, y).

        It maps coordinates in a frame at this pose to the frame in which the pose is given (T_outer_inner, counter-clockwise); its inverse
        maps them back.

        Raises
        ------
        ValueError
            If a number is not finite.
        """
        check_rounding()
        if not np.isfinite([x, y, heading_rad]).all():
            raise ValueError(f"the pose is ({x}, {y}, {heading_rad}); its numbers must be finite")
        (cl, cu), (sl, su) = cos(heading_rad, heading_rad), sin(heading_rad, heading_rad)
        lower, upper = np.array([[cl, -su], [sl, cl]]), np.array([[cu, -sl], [su, cu]])
        affine = cls.__new__(cls)
        # The inverse of a rotation is its transpose.
        transposed = np.ascontiguousarray(lower.T), np.ascontiguousarray(upper.T)
        affine._set((lower, upper), transposed, np.zeros(2), np.array([x, y], dtype=np.float64))
        return affine

    @property
    def inverse(self) -> "Affine":
        """The inverse: y ↦ M⁻¹·(y − b), with an enclosure of M⁻¹."""
        inverted = Affine.__new__(Affine)
        inverted._set(self._inverse, self._matrix, self._offset, self._origin)
        return inverted

    def image(self, boxes: Boxes) -> Boxes:
        """Return boxes that contain the images of boxes: the tightest, but for rounding.

        Raises
        ------
        ValueError
            If the boxes are of another dimension.
        """
        if boxes.dimension != self.dimension:
            raise ValueError(f"the boxes have {boxes.dimension} dimensions; the map is of {self.dimension}")
        lower, upper = np.empty_like(boxes.lower), np.empty_like(boxes.upper)
        run(_map, len(boxes), *self._matrix, self._origin, self._offset, boxes.lower, boxes.upper, lower, upper)
        return Boxes(lower, upper)
