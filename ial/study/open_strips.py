"""Which strips of a map a straight line passes without meeting an occupied cell."""

import numpy as np

from ial.study.obstacles import BoolArray, FloatArray, IndexArray, Obstacles, portions, slack_m

_STEP = 0.99  # cells between points that are looked at: whatever touches the strip is then at most one cell from one of them


def open_strips(obstacles: Obstacles, origins: FloatArray, angles: FloatArray, lengths: FloatArray, aside_m: float) -> BoolArray:
    """Return in which strips there is certainly a ray that meets no closed occupied cell, shape (n,).

    A strip consists of the parallel rays at most `aside_m` to the left and to the right of a middle one. Each cell throws a shadow on the
    far end of its strip; what the shadows leave is where rays pass.

    Parameters
    ----------
    obstacles
        The occupied cells.
    origins, angles, lengths
        Of the middle rays: float64 of shape (n, 2) in metres, (n,) in radians, (n,) in metres. A ray of no length meets nothing.
    aside_m
        Half the width of a strip, 0 for a single ray.
    """
    middle = 0.5 * np.array(obstacles.mask.shape[::-1]) * obstacles.resolution
    slack = slack_m(origins, 2.0 * middle, aside_m)
    # Only what lies beside the map can meet anything: the rest of each ray is cut off, and rays of a strip may pass outside of the map.
    around = float(np.hypot(*middle)) + 2.0 * obstacles.resolution + slack
    ux, uy = np.cos(angles), np.sin(angles)
    x, y = (middle - origins).T
    along, beside = x * ux + y * uy, y * ux - x * uy
    first = np.maximum(along - around, 0.0)
    lengths = np.minimum(lengths, along + around) - first
    origins = origins + first[:, None] * np.stack([ux, uy], axis=1)
    passed: BoolArray = (lengths <= 0.0) | (aside_m + np.abs(beside) > around)
    rows = np.flatnonzero(~passed)
    rows = rows[np.argsort(lengths[rows], kind="stable")]  # of like length together: rows of points are as long as the longest
    if not len(rows):
        return passed
    step = _STEP * obstacles.resolution
    across = np.linspace(-aside_m, aside_m, int(np.ceil(2.0 * aside_m / step)) + 1) if aside_m else np.zeros(1)
    for part in portions(len(rows), len(across) * (int(lengths[rows[-1]] / step) + 2)):
        some = rows[part]
        along = np.minimum(np.arange(int(np.ceil(lengths[some[-1]] / step)) + 1) * step, lengths[some, None])
        unit = np.stack([np.cos(angles[some]), np.sin(angles[some])], axis=1)
        normal = np.stack([-unit[:, 1], unit[:, 0]], axis=1)
        line = origins[some, None] + along[..., None] * unit[:, None]
        points = line[:, :, None] + across[:, None] * normal[:, None, None]
        hit = np.nonzero(obstacles.any_around(points, 1))
        ray = hit[0]
        if not len(ray):
            passed[some] = True
            continue
        at, cells = obstacles.occupied_around(points[hit], 1)
        ray, row, column = np.unravel_index(
            np.unique(np.ravel_multi_index((ray[at], cells[:, 1], cells[:, 0]), shape := (len(some), *obstacles.mask.shape))), shape
        )
        cells = np.stack([column, row], axis=1)
        low, high, met = _shadows(cells, obstacles.resolution, origins[some], unit, lengths[some], ray, slack)
        passed[some] = _gaps_between(ray[met], low[met], high[met], len(some), aside_m, slack)
    return passed


def _shadows(
    cells: IndexArray, width: float, origins: FloatArray, unit: FloatArray, lengths: FloatArray, ray: IndexArray, slack: float
) -> tuple[FloatArray, FloatArray, BoolArray]:
    """Return from where to where, across its ray, each cell reaches with what of it lies beside the ray, and whether anything does."""
    offsets = width * np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (0.0, 0.0)])
    from_laser = width * cells[:, None] + offsets - origins[ray][:, None]
    ux, uy = unit[ray, 0, None], unit[ray, 1, None]
    along = from_laser[..., 0] * ux + from_laser[..., 1] * uy
    across = from_laser[..., 1] * ux - from_laser[..., 0] * uy
    first, last = -slack, lengths[ray, None] + slack
    start, rise = along[:, :-1], np.diff(along)  # of the four sides of each cell
    level = rise == 0.0
    with np.errstate(divide="ignore", invalid="ignore"):
        one, other = (first - start) / rise, (last - start) / rise
    within = level & (first <= start) & (start <= last)
    enter = np.maximum(np.where(level, np.where(within, 0.0, 2.0), np.minimum(one, other)), 0.0)
    leave = np.minimum(np.where(level, np.where(within, 1.0, -1.0), np.maximum(one, other)), 1.0)
    beside = enter <= leave
    base, slope = across[:, :-1], np.diff(across)
    reached = np.stack([base + enter * slope, base + leave * slope])
    low = np.where(beside, reached, np.inf).min(axis=(0, 2))
    high = np.where(beside, reached, -np.inf).max(axis=(0, 2))
    return low, high, np.asarray(beside.any(axis=1))


def _gaps_between(ray: IndexArray, low: FloatArray, high: FloatArray, count: int, aside_m: float, slack: float) -> BoolArray:
    """Return which rays have a gap between the shadows: two slacks wide, so that its middle keeps one slack off every cell."""
    edge = aside_m + slack  # the middle of such a gap within these edges is at most `aside_m` from the middle ray
    every = np.arange(count)
    ray = np.concatenate([every, ray, every])
    low = np.concatenate([np.full(count, -edge), np.clip(low, -edge, edge), np.full(count, edge)])
    high = np.concatenate([np.full(count, -edge), np.clip(high, -edge, edge), np.full(count, edge)])
    order = np.lexsort((low, ray))
    ray, low, high = ray[order], low[order], high[order]
    apart = ray * (4.0 * edge)  # moves the shadows of different rays off each other, so that all are passed through in one go
    gap = (low + apart)[1:] - np.maximum.accumulate(high + apart)[:-1]
    wide = (gap >= 1.99 * slack) & (ray[1:] == ray[:-1])
    gaps = np.zeros(count, dtype=np.bool_)
    gaps[ray[1:][wide]] = True
    return gaps
