"""`BoxIndex`: which of many poses lie in any of many boxes."""

import math

import numpy as np

from ial.contractors.boxes import Boxes

_BINS = 64  # along an axis


class BoxIndex:
    """Boxes of poses (x, y, θ), sorted into a raster over x and y.

    Parameters
    ----------
    boxes
        None of them empty; headings as `ial.contractors.intervals.angle` says.
    """

    def __init__(self, boxes: Boxes) -> None:
        self.lower, self.upper = boxes.lower, boxes.upper
        self._corner = self.lower[:, :2].min(axis=0, initial=np.inf)
        extent = self.upper[:, :2].max(axis=0, initial=-np.inf) - self._corner
        self._bin = max(float(extent.max()) / _BINS, 1e-12) if len(boxes) else 1.0
        first, last = (self._bins(edge[:, :2]) for edge in (self.lower, self.upper))
        across, along = (last - first + 1).T
        rows = np.repeat(np.arange(len(boxes)), across * along)
        number = np.arange(len(rows)) - np.repeat(np.cumsum(across * along) - across * along, across * along)
        names = (first[rows, 1] + number // across[rows]) * (_BINS + 1) + first[rows, 0] + number % across[rows]
        order = np.argsort(names, kind="stable")
        self._rows, self._starts = rows[order], np.searchsorted(names[order], np.arange((_BINS + 1) ** 2 + 1))

    def __len__(self) -> int:
        return len(self.lower)

    def _bins(self, points: np.ndarray) -> np.ndarray:
        if not len(self):
            return np.empty((0, 2), dtype=np.int64)
        return np.clip(np.floor((points - self._corner) / self._bin), 0, _BINS).astype(np.int64)

    def contains(self, poses: np.ndarray, margin: float = 0.0) -> np.ndarray:
        """Return which poses, shape (n, 3), keep this far off the faces of some box from inside; bool of shape (n,)."""
        found = np.zeros(len(poses), dtype=np.bool_)
        if not len(self):
            return found
        column, row = self._bins(poses[:, :2]).T
        names = row * (_BINS + 1) + column
        count = self._starts[names + 1] - self._starts[names]
        pose = np.repeat(np.arange(len(poses)), count)
        boxes = self._rows[np.repeat(self._starts[names] - np.cumsum(count) + count, count) + np.arange(len(pose))]
        at, low, high = poses[pose], self.lower[boxes] + margin, self.upper[boxes] - margin
        inside = ((low[:, :2] <= at[:, :2]) & (at[:, :2] <= high[:, :2])).all(axis=1)
        width = self.upper[boxes, 2] - self.lower[boxes, 2]
        turned = np.mod(at[:, 2] - low[:, 2], 2.0 * math.pi) <= high[:, 2] - low[:, 2]
        inside &= turned | (width >= 2.0 * math.pi)
        found[pose[inside]] = True
        return found
