"""The paver: contract, discard, bisect, repeat. Everything in ial that bisects calls this one."""

import itertools
import time
from dataclasses import dataclass
from typing import Literal

import numpy as np

from ial.contractors.boxes import Boxes, FloatArray
from ial.contractors.contractor import Contractor

Limit = Literal["", "boxes", "time"]

_BATCH = 1 << 14  # larger ones sweep more of a map's table than the caches hold: a third slower on 400 × 400 m


@dataclass(frozen=True)
class Paving:
    """A set of boxes that covers every solution.

    Parameters
    ----------
    boxes
        The boxes, none of them empty. Neighbours share faces.
    limited
        What stopped the search early: "" (nothing: every box reached the wanted precision), "boxes" or "time". A limited paving is
        coarser, and covers every solution all the same.
    nodes
        How many boxes were contracted.
    """

    boxes: Boxes
    limited: Limit = ""
    nodes: int = 0


def pave(
    contractor: Contractor,
    boxes: Boxes,
    precision: FloatArray,
    *,
    max_boxes: int,
    max_seconds: float | None = None,
    batch: int = _BATCH,
) -> Paving:
    """Return a paving of all points of `boxes` that satisfy the constraint of a contractor.

    Boxes are contracted, emptied ones are discarded, and a box with a side above its wanted precision is bisected across the widest side,
    measured in units of its wanted precision. The search runs level by level, so that one contraction takes a large batch; a batch
    that grows above `batch` rows is split, and its parts are finished one after the other, which bounds the memory. The result does not
    depend on the number of threads.

    Parameters
    ----------
    contractor
        Narrows boxes of dimension d.
    boxes
        Where to search.
    precision
        The wanted width along each axis, shape (d,).
    max_boxes
        Boxes are not bisected where that would make more than this many, finished and waiting together; they are returned as they are.
    max_seconds
        A limit on time; None for none. A search that reaches it is no longer reproducible.
    batch
        The largest number of boxes that one contraction takes.

    Source: SIVIA, Jaulin and Walter 1993, with a contractor in the place of the inclusion test; Guyonneau et al. 2014, algorithm 1.
    """
    deadline = None if max_seconds is None else time.monotonic() + max_seconds
    finished: list[Boxes] = []
    kept = nodes = 0
    waiting = _split(boxes, batch)
    count = len(boxes)
    limited: Limit = ""
    while waiting:
        if deadline is not None and time.monotonic() > deadline:
            limited = "time"
            break
        rows = waiting.pop()
        count -= len(rows)
        nodes += len(rows)
        rows = contractor.contract(rows)
        rows = rows[~rows.empty]
        excess = rows.width() / precision
        axis = excess.argmax(axis=1)
        wide = excess[np.arange(len(rows)), axis] > 1.0
        halves = 2 * int(np.count_nonzero(wide))
        if halves and kept + count + len(rows) + halves // 2 > max_boxes:
            limited = "boxes"
            wide[:] = False
        finished.append(rows[~wide])
        kept += len(finished[-1])
        bisected = rows[wide].bisect(axis[wide])
        count += len(bisected)
        waiting.extend(_split(bisected, batch))
    return Paving(Boxes.concatenate([Boxes.none(boxes.dimension), *finished, *waiting]), limited, nodes)


def _split(boxes: Boxes, batch: int) -> list[Boxes]:
    parts = -(-len(boxes) // batch)
    edges = [len(boxes) * i // parts for i in range(parts + 1)] if parts else [0]
    return [boxes[start:stop] for start, stop in itertools.pairwise(edges)]
