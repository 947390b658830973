"""`Boxes`: n boxes of d dimensions as two arrays."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Union

import numpy as np
import numpy.typing as npt

from ial.contractors.elementwise import Elementwise, common_shape, doubles, is_operand, sides
from ial.contractors.expressions.operation import Operation
from ial.contractors.intervals import sets
from ial.contractors.intervals.double import Number
from ial.contractors.intervals.interval import Interval
from ial.contractors.kernels import kernel
from ial.contractors.threads import run

FloatArray = npt.NDArray[np.float64]

Operand = Union["Boxes", Interval, Number, npt.NDArray[Any]]

_SHOWN = 3  # rows, and sides of a row, that repr prints


@dataclass(frozen=True, eq=False, repr=False)
class Boxes(Elementwise):
    """A batch of closed axis-parallel boxes.

    An empty row is ``lower = +inf, upper = -inf`` in every dimension. The arrays are not copied; treat them as read-only.

    ``+ - * /``, ``** n`` and ``abs`` work on every side of every box, as those of `Interval` do, and so do the functions of
    `ial.contractors`; ``&`` intersects and ``|`` encloses two batches row by row. The other operand may be boxes, an `Interval`, a number,
    or an array of points, of a shape that NumPy broadcasts to (n, d). A row of which one side becomes empty becomes empty as a whole.

    Parameters
    ----------
    lower, upper
        Bounds, float64 of shape (n, d).
    """

    lower: FloatArray
    upper: FloatArray

    def __post_init__(self) -> None:
        for name in ("lower", "upper"):
            object.__setattr__(self, name, np.ascontiguousarray(getattr(self, name), dtype=np.float64))
        if self.lower.ndim != 2 or self.lower.shape != self.upper.shape:
            raise ValueError(f"bounds have shapes {self.lower.shape} and {self.upper.shape}; both must be (n, d)")

    @classmethod
    def of(cls, *rows: Sequence[tuple[Number, Number] | Interval]) -> "Boxes":
        """Return boxes from rows of (lower, upper) pairs or `Interval`: ``Boxes.of([(0, 1), (2, 3)])`` is one box in the plane.

        A number that is not a double is rounded outward. The pair (inf, -inf) is an empty side.

        Raises
        ------
        ValueError
            If there is no row, rows differ in length, or a pair makes no interval.
        """
        if len({len(row) for row in rows}) != 1 or not rows[0]:
            raise ValueError("boxes need one row or more of the same number of sides; no boxes at all are Boxes.none(dimension)")
        empty = Interval.empty()
        pairs = [
            [empty if side == (np.inf, -np.inf) else side if isinstance(side, Interval) else Interval(*side) for side in row]
            for row in rows
        ]
        return cls(*(np.array([[getattr(side, bound) for side in row] for row in pairs]) for bound in ("lower", "upper")))

    @classmethod
    def column(cls, lower: npt.ArrayLike, upper: npt.ArrayLike) -> "Boxes":
        """Return m intervals as boxes of one dimension, from their bounds, shape (m,); (inf, -inf) is an empty one.

        Raises
        ------
        ValueError
            If the shapes differ or are not (m,), or a pair of bounds makes no interval: it has a NaN, or lower > upper.
        """
        (low, _), (_, high) = doubles(lower), doubles(upper)
        if low.ndim != 1 or low.shape != high.shape:
            raise ValueError(f"the bounds of a column have shapes {low.shape} and {high.shape}; both must be (m,)")
        empty = (low == np.inf) & (high == -np.inf)
        wrong = np.flatnonzero(~(((low <= high) & (low < np.inf) & (high > -np.inf)) | empty))
        if len(wrong):
            raise ValueError(f"interval {wrong[0]} of a column has the bounds {low[wrong[0]]} and {high[wrong[0]]}, which make no interval")
        return cls(low[:, None], high[:, None])

    @classmethod
    def around(cls, points: npt.ArrayLike, radius: npt.ArrayLike | Number) -> "Boxes":
        """Return the boxes of all numbers within a radius of each coordinate, rounded outward.

        Parameters
        ----------
        points
            Finite coordinates of shape (n, d); m numbers, shape (m,), give boxes of one dimension.
        radius
            At least 0, for all coordinates, or an array that broadcasts to the shape of `points`.

        Raises
        ------
        ValueError
            If a coordinate is not finite, a radius is NaN or negative, or the shapes do not fit.
        """
        from ial.contractors.expressions.functions import add

        lower, upper = doubles(points)
        _, far = doubles(radius)
        if lower.ndim not in (1, 2) or not (np.isfinite(lower) & np.isfinite(upper)).all():
            raise ValueError(f"points of shape {lower.shape} do not make boxes; give finite coordinates of shape (n, d) or (m,)")
        if not (far >= 0.0).all():
            raise ValueError("a radius is negative or NaN; it must be at least 0")
        if common_shape(lower, far) != lower.shape:
            raise ValueError(f"radii of shape {far.shape} do not fit points of shape {lower.shape}")
        low, high = add.bounds((lower, upper), (-far, far))
        return cls(low[:, None], high[:, None]) if low.ndim == 1 else cls(low, high)

    @classmethod
    def none(cls, dimension: int) -> "Boxes":
        """Return a batch of no boxes."""
        return cls(np.empty((0, dimension)), np.empty((0, dimension)))

    @classmethod
    def concatenate(cls, batches: Sequence["Boxes"]) -> "Boxes":
        """Return all rows of several batches, in order."""
        return cls(np.concatenate([batch.lower for batch in batches]), np.concatenate([batch.upper for batch in batches]))

    def __len__(self) -> int:
        return len(self.lower)

    def __getitem__(self, rows: Any) -> "Boxes":
        """Return the rows chosen by a number, a slice, a mask or indices."""
        if isinstance(rows, int | np.integer):
            rows = [rows]
        return Boxes(self.lower[rows], self.upper[rows])

    def __iter__(self) -> Iterator[tuple[Interval, ...]]:
        """Yield each box as a tuple of d intervals."""
        return (tuple(self.interval(row, axis) for axis in range(self.dimension)) for row in range(len(self)))

    def interval(self, row: int, axis: int) -> Interval:
        """Return one side of one box."""
        return Interval.of_bounds(self.lower[row, axis], self.upper[row, axis])

    def __repr__(self) -> str:
        boxes = [" × ".join([*map(str, box[:_SHOWN]), *["…"] * (self.dimension > _SHOWN)]) for box in self[:_SHOWN]]
        shown = "; ".join([*boxes, *["…"] * (len(self) > _SHOWN)])
        return f"<{len(self)} {'box' if len(self) == 1 else 'boxes'} of dimension {self.dimension}{': ' if boxes else ''}{shown}>"

    def where(self, keep: npt.NDArray[np.bool_]) -> "Boxes":
        """Return all rows, those emptied that a mask of shape (n,) does not keep."""
        return Boxes(np.where(keep[:, None], self.lower, np.inf), np.where(keep[:, None], self.upper, -np.inf))

    @property
    def dimension(self) -> int:
        """The number of dimensions d."""
        return int(self.lower.shape[1])

    @property
    def empty(self) -> npt.NDArray[np.bool_]:
        """Which rows are empty, shape (n,)."""
        return np.asarray(~(self.lower <= self.upper).all(axis=1))

    def width(self) -> FloatArray:
        """Return upper − lower, rounded to nearest, shape (n, d); -inf in an empty row."""
        return self.upper - self.lower

    def volume(self) -> float:
        """Return the sum of the volumes (a measure, not a bound); rows are counted as if they did not overlap."""
        return float(np.maximum(self.width(), 0.0).prod(axis=1).sum())

    def hull(self) -> "Boxes":
        """Return the one smallest box around all rows; an empty row if there is none."""
        if not len(self):
            return Boxes(np.full((1, self.dimension), np.inf), np.full((1, self.dimension), -np.inf))
        return Boxes(self.lower.min(axis=0, keepdims=True), self.upper.max(axis=0, keepdims=True))

    def midpoint(self) -> FloatArray:
        """Return the doubles nearest to the middles, shape (n, d), as `Interval.midpoint`; NaN in an empty row."""
        middles = np.empty_like(self.lower)
        run(_midpoints, len(self), self.lower, self.upper, middles)
        return middles

    def contain(self, point: Sequence[float]) -> npt.NDArray[np.bool_]:
        """Return which rows contain a point, shape (n,)."""
        at = np.asarray(point, dtype=np.float64)
        return np.asarray(((self.lower <= at) & (at <= self.upper)).all(axis=1))

    def subset(self, other: Operand) -> npt.NDArray[np.bool_]:
        """Return which rows lie inside the same row of other boxes, shape (n,); an empty row does."""
        (low, high), (outer_low, outer_high) = sides(self, other)
        return np.asarray(((outer_low <= low) & (high <= outer_high)).all(axis=1) | ~(low <= high).all(axis=1))

    def bisect(self, axis: npt.NDArray[np.intp]) -> "Boxes":
        """Return each row cut in two at its midpoint along its own axis: both halves of the first row, both of the second, and so on.

        Halves stay side by side, so repeated bisection leaves neighbours in space close together in memory.

        Parameters
        ----------
        axis
            The dimension to cut, one for each row, shape (n,).
        """
        rows = np.arange(len(self))
        middle = self.midpoint()[rows, axis]
        lower, upper = np.repeat(self.lower, 2, axis=0), np.repeat(self.upper, 2, axis=0)
        upper[2 * rows, axis] = middle
        lower[2 * rows + 1, axis] = middle
        return Boxes(lower, upper)

    @staticmethod
    def operate(operation: Operation, operands: Sequence[Operand]) -> "Boxes":
        """Return the result of an operation on boxes, intervals, numbers and points, side by side."""
        boxes = Boxes(*operation.bounds(*sides(*operands)))
        return boxes.where(~boxes.empty)

    def __and__(self, other: Operand) -> "Boxes":
        """Return the intersection, row by row."""
        if not is_operand(other):
            return NotImplemented
        (low, high), (other_low, other_high) = sides(self, other)
        both = Boxes(np.maximum(low, other_low), np.minimum(high, other_high))
        return both.where(~both.empty)

    def __or__(self, other: Operand) -> "Boxes":
        """Return the hull, row by row."""
        if not is_operand(other):
            return NotImplemented
        (low, high), (other_low, other_high) = sides(self, other)
        return Boxes(np.minimum(low, other_low), np.maximum(high, other_high))

    __rand__, __ror__ = __and__, __or__


@kernel
def _midpoints(start, stop, lower, upper, middles):  # type: ignore[no-untyped-def]
    for i in range(start, stop):
        for axis in range(lower.shape[1]):
            middles[i, axis] = sets.midpoint(lower[i, axis], upper[i, axis])
