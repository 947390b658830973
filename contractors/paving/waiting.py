"""Boxes that wait to be contracted, and which of them come first."""

import itertools
from collections import deque
from collections.abc import Callable
from typing import Literal, Protocol

import numpy as np
import numpy.typing as npt

from ial.contractors.boxes import Boxes, FloatArray
from ial.contractors.kernels import kernel
from ial.contractors.paving.bisection import Cells

Order = Literal["depth", "breadth", "best"] | Callable[[Boxes], npt.ArrayLike]


class Waiting(Protocol):
    """Boxes that wait. `pop` removes those that are next: at least one, and no more than one contraction takes."""

    def push(self, cells: Cells) -> None:
        """Add boxes."""
        ...

    def pop(self) -> Cells:
        """Remove boxes."""
        ...

    def __len__(self) -> int: ...


class Stack:
    """What was added last comes first: batches that are too large are split evenly, and one part is finished before the next is begun.

    Parameters
    ----------
    batch
        How many boxes are removed at once, at most.
    """

    def __init__(self, batch: int) -> None:
        self._batch = batch
        self._parts: list[Cells] = []
        self._count = 0

    def push(self, cells: Cells) -> None:
        """Add boxes."""
        rows = len(cells.boxes)
        parts = -(-rows // self._batch)
        edges = [rows * i // parts for i in range(parts + 1)] if parts else []
        self._parts.extend(cells.part(start, stop) for start, stop in itertools.pairwise(edges))
        self._count += rows

    def pop(self) -> Cells:
        """Remove the last part."""
        cells = self._parts.pop()
        self._count -= len(cells.boxes)
        return cells

    def __len__(self) -> int:
        return self._count


class Queue:
    """What was added first comes first: level after level.

    Parameters
    ----------
    batch
        How many boxes are removed at once, at most.
    """

    def __init__(self, batch: int) -> None:
        self._batch = batch
        self._batches: deque[Cells] = deque()
        self._count = 0

    def push(self, cells: Cells) -> None:
        """Add boxes."""
        if len(cells.boxes):
            self._batches.append(cells)
            self._count += len(cells.boxes)

    def pop(self) -> Cells:
        """Remove the first boxes."""
        taken: list[Cells] = []
        room = self._batch
        while room and self._batches:
            cells = self._batches.popleft()
            rows = len(cells.boxes)
            if rows > room:
                self._batches.appendleft(cells.part(room, rows))
                cells = cells.part(0, room)
            taken.append(cells)
            room -= len(cells.boxes)
        self._count -= self._batch - room
        return taken[0] if len(taken) == 1 else Cells.concatenate(taken)

    def __len__(self) -> int:
        return self._count


class Heap:
    """The box with the largest key comes first; among equal keys the one that was added first.

    Parameters
    ----------
    key
        Gives boxes their keys, shape (n,).
    batch
        How many boxes are removed at once, at most.
    dimension
        The number of dimensions of the boxes.
    """

    def __init__(self, key: Callable[[Boxes], npt.ArrayLike], batch: int, dimension: int) -> None:
        self._key = key
        self._batch = batch
        self._count = self._added = 0
        self._cells = Cells(Boxes.none(dimension), np.empty(0, dtype=np.int16))
        # A binary heap of keys, of ages (equal keys keep their order) and of rows of `_cells`; after its end, the rows that are free.
        self._keys, self._ages, self._rows = np.empty(0), np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int64)

    def push(self, cells: Cells) -> None:
        """Add boxes.

        Raises
        ------
        ValueError
            If the keys have another shape than (n,), or one is NaN.
        """
        added = len(cells.boxes)
        if not added:
            return
        keys = _keys(self._key, cells.boxes)
        end = self._count + added
        if end > len(self._rows):
            self._grow(max(end, 2 * len(self._rows)))
        rows = self._rows[self._count : end].copy()
        self._cells.boxes.lower[rows], self._cells.boxes.upper[rows] = cells.boxes.lower, cells.boxes.upper
        self._cells.last[rows] = cells.last
        self._keys[self._count : end] = keys
        self._ages[self._count : end] = np.arange(self._added, self._added + added)
        _push(self._keys, self._ages, self._rows, self._count, end)
        self._count = end
        self._added += added

    def pop(self) -> Cells:
        """Remove the boxes with the largest keys, the largest first."""
        rows = np.empty(min(self._batch, self._count), dtype=np.int64)
        _pop(self._keys, self._ages, self._rows, self._count, rows)
        self._count -= len(rows)
        return Cells(self._cells.boxes[rows], self._cells.last[rows])

    def __len__(self) -> int:
        return self._count

    def _grow(self, capacity: int) -> None:
        more = capacity - len(self._rows)
        space = Boxes(np.empty((more, self._cells.boxes.dimension)), np.empty((more, self._cells.boxes.dimension)))
        self._cells = Cells.concatenate([self._cells, Cells(space, np.empty(more, dtype=np.int16))])
        self._keys = np.append(self._keys, np.empty(more))
        self._ages = np.append(self._ages, np.empty(more, dtype=np.int64))
        self._rows = np.append(self._rows, np.arange(len(self._rows), capacity))


def _keys(key: Callable[[Boxes], npt.ArrayLike], boxes: Boxes) -> FloatArray:
    keys = np.asarray(key(boxes), dtype=np.float64)
    if keys.shape != (len(boxes),):
        raise ValueError(f"the order gave keys of shape {keys.shape} for {len(boxes)} boxes; give one number for each box")
    if np.isnan(keys).any():
        raise ValueError(f"the order gave NaN as the key of {int(np.isnan(keys).sum())} of {len(boxes)} boxes; a key must be a number")
    return keys


@kernel
def _push(keys, ages, rows, start, stop):  # type: ignore[no-untyped-def]
    """Move the entries ``start … stop``, which follow a heap, to their places in it. They are the youngest."""
    for end in range(start, stop):
        key, age, row = keys[end], ages[end], rows[end]
        at = end
        while at > 0 and key > keys[(at - 1) // 2]:
            above = (at - 1) // 2
            keys[at], ages[at], rows[at] = keys[above], ages[above], rows[above]
            at = above
        keys[at], ages[at], rows[at] = key, age, row


@kernel
def _before(keys, ages, a, key, age):  # type: ignore[no-untyped-def]
    return keys[a] > key or (keys[a] == key and ages[a] < age)


@kernel
def _pop(keys, ages, rows, size, popped):  # type: ignore[no-untyped-def]
    """Move the rows of the first entries, in order, to `popped`, and to the free ones after the heap."""
    for k in range(len(popped)):
        popped[k] = rows[0]
        size -= 1
        key, age, row = keys[size], ages[size], rows[size]
        rows[size] = rows[0]
        at = 0
        child = 1
        while child < size:
            if child + 1 < size and _before(keys, ages, child + 1, keys[child], ages[child]):
                child += 1
            if not _before(keys, ages, child, key, age):
                break
            keys[at], ages[at], rows[at] = keys[child], ages[child], rows[child]
            at = child
            child = 2 * at + 1
        if size > 0:
            keys[at], ages[at], rows[at] = key, age, row


def waiting(order: Order, precision: FloatArray, batch: int) -> Waiting:
    """Return an empty collection for an order of search: see `ial.contractors.paving.paver.pave`."""
    if callable(order):
        return Heap(order, batch, len(precision))
    if order == "best":
        return Heap(lambda boxes: _excess(boxes, precision), batch, len(precision))
    return Stack(batch) if order == "depth" else Queue(batch)


def _excess(boxes: Boxes, precision: FloatArray) -> FloatArray:
    """Return the widest side of each box in units of its wanted width."""
    with np.errstate(invalid="ignore"):
        excess = boxes.width() / precision
    return np.asarray(np.where(np.isnan(excess), 0.0, excess).max(axis=1))
