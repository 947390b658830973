"""The exact hull of the points that lie in enough of several boxes, in d dimensions."""

import numpy as np

from ial.contractors.kernels import kernel

_STEPS = 2**26  # about a third of a second for the worst row


def require_affordable(count: int, dimension: int) -> None:
    """Raise if the exact hull of m boxes in d dimensions could take minutes for one row.

    Raises
    ------
    ValueError
        If 2·d·m^d is above 2^26: more than 4096 boxes in the plane, 223 in space, 53 in four dimensions, 13 in six.
    """
    steps = 2 * dimension * count**dimension
    if steps > _STEPS:
        raise ValueError(
            f"the exact relaxed intersection of {count} boxes in {dimension} dimensions may take {steps:.1e} steps a row, "
            f"above the limit of {_STEPS:.1e}; use exact=False, which handles each axis by itself"
        )


@kernel
def _meet_elsewhere(starts, fixed, needed, alive, tried):  # type: ignore[no-untyped-def]
    """Return whether enough of the boxes ``alive[0]`` share a point in all axes but `fixed`.

    If so, they share the one whose every coordinate is the largest of their lower bounds. Axis by axis, the lower bound of each box that is
    still alive is tried as the coordinate, and only boxes that hold it stay alive.
    """
    dimension, count = starts.shape[:2]
    level = 0
    tried[0] = 0
    while level >= 0:
        if level == dimension - 1:
            return True
        axis = level + (level >= fixed)
        j = tried[level]
        tried[level] += 1
        if j == count:
            level -= 1
        elif alive[level, j]:
            kept = 0
            for k in range(count):
                alive[level + 1, k] = alive[level, k] & starts[axis, j, k]
                kept += alive[level + 1, k]
            if kept >= needed:
                level += 1
                tried[level] = 0
    return False


@kernel
def _side(lower, upper, starts, axis, above, needed, alive, tried):  # type: ignore[no-untyped-def]
    """Return the least (or, `above`, the greatest) coordinate of a point of enough boxes; NaN if there is none."""
    count = len(lower)
    order = np.argsort(-upper[:, axis]) if above else np.argsort(lower[:, axis])
    for j in order:
        value = upper[j, axis] if above else lower[j, axis]
        kept = 0
        for k in range(count):
            alive[0, k] = (lower[k, axis] <= value) & (value <= upper[k, axis])
            kept += alive[0, k]
        if kept >= needed and _meet_elsewhere(starts, axis, needed, alive, tried):
            return value
    return np.nan


@kernel
def intersect_exactly(start, stop, lower, upper, needed, out_lower, out_upper):  # type: ignore[no-untyped-def]
    """Narrow a box around the points of at least `needed` of the m boxes of each row to their hull.

    The hull ends, on each side, where a box begins or ends: these coordinates are tried from outside inwards.
    """
    count, dimension = lower.shape[1:]
    alive = np.empty((dimension, count), dtype=np.bool_)
    tried = np.empty(dimension, dtype=np.int64)
    kept_lower, kept_upper = np.empty((count, dimension)), np.empty((count, dimension))
    table = np.empty((dimension, count, count), dtype=np.bool_)  # whether, on an axis, the lower bound of box j lies in box k
    for i in range(start, stop):
        kept = 0
        for j in range(count):
            here = True
            for axis in range(dimension):
                # Boxes that miss the box already known around the points count for none of them.
                low, high = max(lower[i, j, axis], out_lower[i, axis]), min(upper[i, j, axis], out_upper[i, axis])
                kept_lower[kept, axis], kept_upper[kept, axis] = low, high
                here &= low <= high
            kept += here
        starts = table[:, :kept, :kept]
        for axis in range(dimension):
            for j in range(kept):
                for k in range(kept):
                    starts[axis, j, k] = (kept_lower[k, axis] <= kept_lower[j, axis]) & (kept_lower[j, axis] <= kept_upper[k, axis])
        empty = kept < needed
        for axis in range(dimension):
            for above in (False, True):
                if not empty:
                    end = _side(kept_lower[:kept], kept_upper[:kept], starts, axis, above, needed, alive[:, :kept], tried)
                    empty = np.isnan(end)
                    if above:
                        out_upper[i, axis] = end
                    else:
                        out_lower[i, axis] = end
        if empty:
            out_lower[i] = np.inf
            out_upper[i] = -np.inf
