"""`BoxIndex`: which of many poses lie in any of many boxes."""

import math

import numpy as np

from ial.contractors.boxes import Boxes

_BINS = np.array([48, 48, 64])  # along x, y and θ


class BoxIndex:
    """Boxes of poses (x, y, θ), sorted into a raster.

    Parameters
    ----------
    boxes
        None of them empty; their headings are taken modulo 2π.
    """

    def __init__(self, boxes: Boxes) -> None:
        self.lower, self.upper = boxes.lower, boxes.upper
        self._corner, self._size = np.zeros(3), np.full(3, 2.0 * math.pi) / _BINS
        if len(boxes):
            self._corner[:2] = self.lower[:, :2].min(axis=0)
            self._size[:2] = np.maximum(self.upper[:, :2].max(axis=0) - self._corner[:2], 1e-12) / _BINS[:2]
        first, last = self._bins(self.lower), self._bins(self.upper)
        last[:, 2] = np.minimum(last[:, 2], first[:, 2] + _BINS[2] - 1)
        counts = last - first + 1
        total = counts.prod(axis=1)
        rows = np.repeat(np.arange(len(boxes)), total)
        number = np.arange(len(rows)) - np.repeat(np.cumsum(total) - total, total)
        across, along = counts[rows, 0], counts[rows, 1]
        steps = np.stack([number % across, number // across % along, number // (across * along)], axis=1)
        names = _names(first[rows] + steps)
        order = np.argsort(names, kind="stable")
        self._rows, self._starts = rows[order], np.searchsorted(names[order], np.arange(_BINS.prod() + 1))

    def __len__(self) -> int:
        return len(self.lower)

    def _bins(self, poses: np.ndarray) -> np.ndarray:
        bins = np.floor((poses - self._corner) / self._size).astype(np.int64)
        bins[:, :2] = np.clip(bins[:, :2], 0, _BINS[:2] - 1)
        return bins

    def contains(self, poses: np.ndarray, margin: float = 0.0) -> np.ndarray:
        """Return which poses, shape (n, 3), keep this far off the faces of some box from inside; bool of shape (n,)."""
        held = np.zeros(len(poses), dtype=np.bool_)
        names = _names(self._bins(poses))
        count = self._starts[names + 1] - self._starts[names]
        pose = np.repeat(np.arange(len(poses)), count)
        boxes = self._rows[np.repeat(self._starts[names] - np.cumsum(count) + count, count) + np.arange(len(pose))]
        at, low, high = poses[pose].T, self.lower[boxes].T + margin, self.upper[boxes].T - margin
        inside = (low[0] <= at[0]) & (at[0] <= high[0]) & (low[1] <= at[1]) & (at[1] <= high[1])
        inside &= (np.mod(at[2] - low[2], 2.0 * math.pi) <= high[2] - low[2]) | (high[2] - low[2] >= 2.0 * (math.pi - margin))
        held[pose[inside]] = True
        return held


def _names(bins: np.ndarray) -> np.ndarray:
    return np.asarray((bins[:, 2] % _BINS[2] * _BINS[1] + bins[:, 1]) * _BINS[0] + bins[:, 0])
