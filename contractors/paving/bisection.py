"""Cutting boxes in two: which ones, and across which side."""

from collections.abc import Callable
from typing import Literal, NamedTuple

import numpy as np
import numpy.typing as npt

from ial.contractors.boxes import Boxes, FloatArray
from ial.contractors.intervals.sets import midpoint
from ial.contractors.kernels import kernel
from ial.contractors.threads import run

AxisArray = npt.NDArray[np.int16]
Rule = Literal["largest", "round_robin"] | Callable[[Boxes], npt.ArrayLike]

_BLOCK = 1 << 10  # rows are counted and written block by block, so that blocks can be shared among threads and keep their order
_SHARED_BLOCKS = 16  # a thread of its own pays from here on
_EMPTY, _FINISHED = -2, -1  # what stands in the place of an axis
_LARGEST, _ROUND_ROBIN, _WEIGHTS = 0, 1, 2


@kernel
def _preferred(rule, lower, upper, i, last, precision, weights):  # type: ignore[no-untyped-def]
    """Return the axis across which a rule wants row i to be cut, or that the row is finished."""
    chosen = _FINISHED
    best = 0.0
    for axis in range(lower.shape[1]):
        low = lower[i, axis]
        high = upper[i, axis]
        excess = (high - low) / precision[axis]
        if rule == _LARGEST:
            score = excess
        elif rule == _ROUND_ROBIN:
            score = -float((axis - last[i] - 1) % lower.shape[1])
        else:
            score = weights[i, axis]
        # Between neighbouring doubles there is nothing to cut: such a side is as narrow as it gets.
        if excess > 1.0 and (chosen < 0 or score > best) and _divisible(low, high):
            best = score
            chosen = axis
    return chosen


@kernel
def _divisible(low, high):  # type: ignore[no-untyped-def]
    """Return whether there is a double between two bounds."""
    return low < midpoint(low, high) < high


@kernel
def _choose(start, stop, lower, upper, last, precision, rule, weights, axes, counts):  # type: ignore[no-untyped-def]
    """Write what happens to each row, and for each block how many rows are finished, are cut, hold a NaN."""
    rows, dimension = lower.shape
    for block in range(start, stop):
        finished = 0
        cut = 0
        broken = 0
        for i in range(block * _BLOCK, min(rows, (block + 1) * _BLOCK)):
            empty = False
            widest = 1.0
            chosen = _FINISHED
            for axis in range(dimension):
                low = lower[i, axis]
                high = upper[i, axis]
                empty |= low > high
                broken += (low != low) | (high != high)
                excess = (high - low) / precision[axis]
                chosen = axis if excess > widest else chosen
                widest = excess if excess > widest else widest
            # That was the rule `largest`, without a branch. Other rules choose anew among the sides that are too wide.
            if chosen >= 0 and (rule != _LARGEST or not _divisible(lower[i, chosen], upper[i, chosen])):
                chosen = _preferred(rule, lower, upper, i, last, precision, weights)
            chosen = _EMPTY if empty else chosen
            axes[i] = chosen
            finished += chosen == _FINISHED
            cut += chosen >= 0
        counts[block, 0] = finished
        counts[block, 1] = cut
        counts[block, 2] = broken


@kernel
def _write(start, stop, lower, upper, axes, firsts, kept_lower, kept_upper, half_lower, half_upper, last):  # type: ignore[no-untyped-def]
    """Write the finished rows of each block, and the halves of those that are cut side by side."""
    rows, dimension = lower.shape
    for block in range(start, stop):
        kept = firsts[block, 0]
        half = 2 * firsts[block, 1]
        for i in range(block * _BLOCK, min(rows, (block + 1) * _BLOCK)):
            cut = axes[i]
            if cut >= 0:
                for axis in range(dimension):
                    half_lower[half, axis] = half_lower[half + 1, axis] = lower[i, axis]
                    half_upper[half, axis] = half_upper[half + 1, axis] = upper[i, axis]
                half_upper[half, cut] = half_lower[half + 1, cut] = midpoint(lower[i, cut], upper[i, cut])
                last[half] = last[half + 1] = cut
                half += 2
            elif cut == _FINISHED:
                for axis in range(dimension):
                    kept_lower[kept, axis] = lower[i, axis]
                    kept_upper[kept, axis] = upper[i, axis]
                kept += 1


class Cells(NamedTuple):
    """Boxes, and for each the axis across which it was cut last (-1: never)."""

    boxes: Boxes
    last: AxisArray

    @classmethod
    def uncut(cls, boxes: Boxes) -> "Cells":
        """Return boxes that were never cut."""
        return cls(boxes, np.full(len(boxes), -1, dtype=np.int16))

    @classmethod
    def concatenate(cls, batches: "list[Cells]") -> "Cells":
        """Return all rows of several batches, in order."""
        return cls(Boxes.concatenate([each.boxes for each in batches]), np.concatenate([each.last for each in batches]))

    def part(self, start: int, stop: int) -> "Cells":
        """Return some rows."""
        return Cells(self.boxes[start:stop], self.last[start:stop])


class Division:
    """What is to happen to the rows of a batch: an empty one is dropped, one that is narrow enough is finished, another is cut in two.

    Parameters
    ----------
    cells
        The batch, n boxes of d dimensions.
    precision
        The wanted width along each axis, float64 of shape (d,). A side wider than that is cut, unless no double lies between its bounds.
    rule
        Which of these sides is cut: see `ial.contractors.paving.paver.pave`.

    Attributes
    ----------
    axes
        Across which axis each row is cut, int16 of shape (n,); negative for those that are not.
    finished, cut
        The numbers of rows that are finished, and that are cut.

    Raises
    ------
    ValueError
        If a bound is NaN, or if the weights of a rule have another shape than (n, d).
    """

    def __init__(self, cells: Cells, precision: FloatArray, rule: Rule) -> None:
        boxes, last = cells
        weights = np.empty((0, boxes.dimension))
        if callable(rule):
            kept = ~boxes.empty & ~np.isnan(boxes.lower).any(axis=1) & ~np.isnan(boxes.upper).any(axis=1)
            weights = np.full(boxes.lower.shape, -np.inf)
            weights[kept] = _weights(rule, boxes[kept])
        code = _WEIGHTS if callable(rule) else _ROUND_ROBIN if rule == "round_robin" else _LARGEST
        self._boxes = boxes
        self.axes = np.empty(len(boxes), dtype=np.int16)
        self._counts = np.zeros((-(-len(boxes) // _BLOCK), 3), dtype=np.int64)
        arguments = (boxes.lower, boxes.upper, last, precision, code, weights, self.axes, self._counts)
        run(_choose, len(self._counts), *arguments, minimum=_SHARED_BLOCKS)
        self.finished, self.cut, broken = (int(count) for count in self._counts.sum(axis=0))
        if broken:
            raise ValueError(f"{broken} bounds of {len(boxes)} boxes are NaN; a contractor returns numbers, and (inf, -inf) if empty")

    def stop(self) -> None:
        """Cut nothing: all that is not empty counts as finished."""
        np.minimum(self.axes, _FINISHED, out=self.axes)
        self._counts[:, 0] += self._counts[:, 1]
        self._counts[:, 1] = 0
        self.finished, self.cut = self.finished + self.cut, 0

    def carry_out(self) -> tuple[Boxes, Cells]:
        """Return the finished boxes and the halves of the others, both in the order of their rows, halves side by side."""
        dimension = self._boxes.dimension
        kept = Boxes(np.empty((self.finished, dimension)), np.empty((self.finished, dimension)))
        halves = Boxes(np.empty((2 * self.cut, dimension)), np.empty((2 * self.cut, dimension)))
        last = np.empty(2 * self.cut, dtype=np.int16)
        firsts = self._counts.cumsum(axis=0) - self._counts
        arguments = (self._boxes.lower, self._boxes.upper, self.axes, firsts, kept.lower, kept.upper, halves.lower, halves.upper, last)
        run(_write, len(firsts), *arguments, minimum=_SHARED_BLOCKS)
        return kept, Cells(halves, last)


def _weights(rule: Callable[[Boxes], npt.ArrayLike], boxes: Boxes) -> FloatArray:
    weights = np.asarray(rule(boxes), dtype=np.float64)
    if weights.shape != boxes.lower.shape:
        raise ValueError(f"the bisection rule gave weights of shape {weights.shape} for {len(boxes)} boxes; give {boxes.lower.shape}")
    return np.where(np.isnan(weights), -np.inf, weights)
