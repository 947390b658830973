"""`Boxes`: n boxes of d dimensions as two arrays."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]

_LARGEST = float(np.finfo(np.float64).max)


@dataclass(frozen=True, eq=False)
class Boxes:
    """A batch of closed axis-parallel boxes.

    An empty row is ``lower = +inf, upper = -inf`` in every dimension. The arrays are not copied; treat them as read-only.

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
    def of(cls, *rows: Sequence[tuple[float, float]]) -> "Boxes":
        """Return boxes from rows of (lower, upper) pairs: ``Boxes.of([(0, 1), (2, 3)])`` is one box in the plane."""
        bounds = np.array(rows, dtype=np.float64)
        return cls(bounds[:, :, 0], bounds[:, :, 1])

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
        """Return the rows chosen by a slice, a mask or indices."""
        return Boxes(self.lower[rows], self.upper[rows])

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

    def contain(self, point: Sequence[float]) -> npt.NDArray[np.bool_]:
        """Return which rows contain a point, shape (n,)."""
        at = np.asarray(point, dtype=np.float64)
        return np.asarray(((self.lower <= at) & (at <= self.upper)).all(axis=1))

    def bisect(self, axis: npt.NDArray[np.intp]) -> "Boxes":
        """Return each row cut in two at its middle along its own axis: both halves of the first row, both of the second, and so on.

        Halves stay side by side, so repeated bisection leaves neighbours in space close together in memory. An unbounded side is cut as if
        it ended at the largest double.

        Parameters
        ----------
        axis
            The dimension to cut, one for each row, shape (n,).
        """
        rows = np.arange(len(self))
        low, high = self.lower[rows, axis], self.upper[rows, axis]
        with np.errstate(over="ignore", invalid="ignore"):
            middle = low + 0.5 * (high - low)
        far = ~np.isfinite(middle)
        middle[far] = 0.5 * np.maximum(low[far], -_LARGEST) + 0.5 * np.minimum(high[far], _LARGEST)
        lower, upper = np.repeat(self.lower, 2, axis=0), np.repeat(self.upper, 2, axis=0)
        upper[2 * rows, axis] = middle
        lower[2 * rows + 1, axis] = middle
        return Boxes(lower, upper)
