"""Coarsening: pieces of walls cut along a grid of parts and headings, with one piece for each cell: a superset of bounded size.

Of a sequence of grids it is the finest that keeps the bound: a large set is held coarsely, one that shrinks more and more finely.
"""

import numpy as np

from ial.bouncing.rays.ray_set import RaySet
from ial.contractors.expressions.functions import mul, sub
from ial.contractors.intervals.trigonometric import TWO_PI_LOWER, TWO_PI_UPPER
from ial.maps.polygons.walls import FloatArray, Walls

COARSEST, FINEST = 5, 16  # there are 2^level intervals of headings; the coarsest are narrow enough for `ray_shooting`
_TWO_PI = 2.0 * np.pi
_PIECES_PER_CELL = 4  # so many more pieces than cells may be cut before they are joined


def least_pieces(walls: Walls) -> int:
    """Return how many pieces the coarsest grid may need."""
    return int((2**COARSEST + 1) * _parts(walls, COARSEST).sum()) * 2


def _parts(walls: Walls, level: int) -> FloatArray:
    """Return into how many parts each wall is divided: what headings of neighbouring intervals are apart at half the scale."""
    parts: FloatArray = np.ceil(walls.lengths / (_TWO_PI / 2**level * walls.scale / 2.0))
    return parts


def _normal(states: RaySet) -> RaySet:
    """Return the set with headings that begin in [0, 2π), or a rounding beside it."""
    turns = np.floor(states.lower[:, 1] / _TWO_PI)
    lower, upper = states.lower.copy(), states.upper.copy()
    whole = mul.bounds((turns, turns), (np.array(TWO_PI_LOWER), np.array(TWO_PI_UPPER)))
    lower[:, 1] = sub.bounds((lower[:, 1], lower[:, 1]), whole)[0]
    upper[:, 1] = sub.bounds((upper[:, 1], upper[:, 1]), whole)[1]
    return RaySet(states.walls, lower, upper, states.steps, states.arriving, states.reach)


def _ranges(states: RaySet, walls: Walls, level: int) -> tuple[FloatArray, FloatArray]:
    """Return the numbers of the first and the last cell of each piece in both directions; rounding may cost a cell, never a piece."""
    per = np.stack([_parts(walls, level)[states.walls], np.full(len(states), 2.0**level / _TWO_PI)], axis=1)
    return np.floor(states.lower * per), np.maximum(np.ceil(states.upper * per) - 1.0, np.floor(states.lower * per))


def coarsened(states: RaySet, walls: Walls, most: int) -> RaySet:
    """Return a superset with at most so many pieces, none wider than a cell of the grid it is cut along.

    Parameters
    ----------
    states
        Any set; its `reach` is not kept.
    walls
        The walls.
    most
        At least `least_pieces` for each number of steps that occurs.
    """
    states = _normal(states)
    best, level = None, COARSEST
    while level < FINEST and _cells(states, walls, level + 1) <= most:
        level += 1  # so few need not even be joined
    for finer in range(level, FINEST + 1):
        if best is not None and _cells(states, walls, finer) > _PIECES_PER_CELL * most:
            break
        joined = _joined(_cut(states, walls, finer), walls, finer)
        if best is not None and len(joined) > most:
            break
        best = joined
    assert best is not None
    return best


def _cells(states: RaySet, walls: Walls, level: int) -> float:
    """Return into how many pieces a grid would cut the set."""
    first, last = _ranges(states, walls, level)
    return float((last - first + 1.0).prod(axis=1).sum())


def _cut(states: RaySet, walls: Walls, level: int) -> RaySet:
    """Return the set with every piece cut along the lines of a grid."""
    first, last = _ranges(states, walls, level)
    for side in (0, 1):
        counts = (last[:, side] - first[:, side] + 1.0).astype(np.int64)
        rows = np.repeat(np.arange(len(states)), counts)
        offset = np.arange(len(rows)) - np.repeat(np.cumsum(counts) - counts, counts)
        per = _parts(walls, level)[states.walls] if side == 0 else np.full(len(states), 2.0**level / _TWO_PI)
        states, first, last, per = states.only(rows), first[rows], last[rows], per[rows]
        cell = first[:, side] + offset
        lower, upper = states.lower.copy(), states.upper.copy()
        # The ends of a piece stay as they are, and neighbours share the line between them: nothing gets lost between two.
        lower[:, side] = np.where(offset == 0, lower[:, side], cell / per)
        upper[:, side] = np.where(cell == last[:, side], upper[:, side], (cell + 1.0) / per)
        first[:, side] = last[:, side] = cell
        states = RaySet(states.walls, lower, upper, states.steps, states.arriving, states.reach)
    return states


def _joined(states: RaySet, walls: Walls, level: int) -> RaySet:
    """Return the set with one piece, their hull, in place of all that have their middles in one cell."""
    if not len(states):
        return states
    middle = 0.5 * (states.lower + states.upper)
    parts = _parts(walls, level)
    ends = np.cumsum(parts)
    # The end of a wall belongs to its last part: one further on is the first of the next wall.
    part = np.minimum(np.floor(middle[:, 0] * parts[states.walls]), parts[states.walls] - 1.0) + (ends - parts)[states.walls]
    # Headings go at most twice around, but for rounding.
    heading = np.clip(np.floor(middle[:, 1] * (2.0**level / _TWO_PI)), 0.0, 2.0 ** (level + 1) - 1.0)
    _, group = np.unique(2 * states.steps.astype(np.int64) + states.arriving, return_inverse=True)
    keys = ((group * (int(ends[-1]) + 1) + part.astype(np.int64)) << (level + 1)) + heading.astype(np.int64)
    order = np.argsort(keys, kind="stable")
    keys = keys[order]
    starts = np.flatnonzero(np.concatenate([[True], keys[1:] != keys[:-1]]))
    first = states.only(order[starts])
    lower = np.minimum.reduceat(states.lower[order], starts, axis=0)
    upper = np.maximum.reduceat(states.upper[order], starts, axis=0)
    return RaySet(first.walls, lower, upper, first.steps, first.arriving, first.reach)
