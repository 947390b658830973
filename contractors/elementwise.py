"""Operators that work side by side on boxes, and the operands that they understand."""

from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
import numpy.typing as npt

from ial.contractors.intervals.double import above, below, is_number, whole

if TYPE_CHECKING:
    from typing_extensions import Self  # in typing since Python 3.11

FloatArray = npt.NDArray[np.float64]


class Elementwise:
    """The arithmetic of a class that holds arrays of intervals: every operator calls the operation of that name."""

    operand_rank: ClassVar[int] = 1  # of a number, intervals, boxes and expressions, the highest decides what an operation gives
    __array_ufunc__: ClassVar[None] = None  # an array on the left leaves the operation to the boxes on the right

    def _apply(self, name: str, *operands: Any) -> "Self":
        from ial.contractors.expressions import functions  # many kernels, needed only by who computes with boxes

        return getattr(functions, name)(*operands) if all(map(is_operand, operands)) else NotImplemented

    def __add__(self, other: Any) -> "Self":
        return self._apply("add", self, other)

    def __radd__(self, other: Any) -> "Self":
        return self._apply("add", other, self)

    def __sub__(self, other: Any) -> "Self":
        return self._apply("sub", self, other)

    def __rsub__(self, other: Any) -> "Self":
        return self._apply("sub", other, self)

    def __mul__(self, other: Any) -> "Self":
        return self._apply("mul", self, other)

    def __rmul__(self, other: Any) -> "Self":
        return self._apply("mul", other, self)

    def __truediv__(self, other: Any) -> "Self":
        return self._apply("div", self, other)

    def __rtruediv__(self, other: Any) -> "Self":
        return self._apply("div", other, self)

    def __pow__(self, exponent: Any) -> "Self":
        """Return the powers, as `Interval` does: a whole number n multiplies, every other exponent needs a base >= 0."""
        n = whole(exponent)
        if n is None:
            return self._apply("sqrt", self) if is_number(exponent) and exponent == 0.5 else self._apply("pow", self, exponent)
        if abs(n) > 2**53:
            raise ValueError(f"the exponent is {exponent}; a whole exponent of boxes must lie between -2**53 and 2**53")
        return self._apply("sqr", self) if n == 2 else self._apply("pown", self, n)

    def __rpow__(self, base: Any) -> "Self":
        return self._apply("pow", base, self)

    def __neg__(self) -> "Self":
        return self._apply("neg", self)

    def __pos__(self) -> "Self":
        return self

    def __abs__(self) -> "Self":
        return self._apply("absolute", self)


def is_operand(operand: Any) -> bool:
    """Return whether boxes can be combined with a value: a number, an interval, boxes, or an array of points."""
    points = isinstance(operand, np.ndarray) and operand.dtype != object
    return points or is_number(operand) or (hasattr(operand, "operand_rank") and operand.operand_rank <= 1)


def sides(*operands: Any) -> list[tuple[FloatArray, FloatArray]]:
    """Return the bounds of operands as arrays whose shapes broadcast.

    Raises
    ------
    ValueError
        If an array of points holds what is not finite, a number is not finite, or the shapes do not fit together.
    """
    bounds = []
    for operand in operands:
        if hasattr(operand, "operand_rank"):
            lower, upper = np.asarray(operand.lower), np.asarray(operand.upper)
        else:
            lower, upper = doubles(operand)
            if not (np.isfinite(lower) | np.isfinite(upper)).all():
                raise ValueError(f"{operand!r} holds an infinity or NaN; give finite numbers, intervals or boxes")
        bounds.append((lower, upper))
    if common_shape(*(lower for lower, _ in bounds)) is None:
        shapes = " and ".join(str(lower.shape) for lower, _ in bounds)
        raise ValueError(f"operands have shapes {shapes}, which do not fit together; give as many boxes, of as many dimensions")
    return bounds


def common_shape(*arrays: FloatArray) -> tuple[int, ...] | None:
    """Return the shape that arrays broadcast to, None if there is none."""
    try:
        return np.broadcast_shapes(*(array.shape for array in arrays))
    except ValueError:
        return None


def doubles(values: Any) -> tuple[FloatArray, FloatArray]:
    """Return the doubles below and above each of an array of numbers of any kind: the same ones twice if they are doubles."""
    array = np.asarray(values)
    small = array.dtype.itemsize <= 8 if array.dtype.kind == "f" else array.dtype.kind in "iu" and bool((np.abs(array) <= 2**53).all())
    if small:
        return array.astype(np.float64), array.astype(np.float64)
    low, high = (np.frompyfunc(side, 1, 1)(array.astype(object)) for side in (below, above))
    return np.asarray(low, dtype=np.float64), np.asarray(high, dtype=np.float64)
