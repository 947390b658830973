"""Simple polygons drawn at random: a tour through random points whose crossings are undone one by one (2-opt)."""

import numpy as np
import numpy.typing as npt

from ial.errors import MapError
from ial.maps.polygons.polygon import Polygon

_EXTENT = 10_000  # coordinates are whole numbers from 0 to this


def random_polygon(corners: int, seed: int, extent: int = _EXTENT) -> Polygon:
    """Return a simple polygon with a number of corners; the same one for the same seed."""
    chooser = np.random.default_rng((seed, corners))
    while True:
        points = chooser.integers(0, extent + 1, (corners, 2))
        tour = _untangled(points, chooser)
        try:
            return Polygon(tuple((int(x), int(y)) for x, y in tour.tolist()))  # type: ignore[misc]
        except MapError:  # corners on one line, or one of them twice
            continue


def rectilinear_polygon(columns: int, seed: int, height: int = 100) -> Polygon:
    """Return a polygon with walls along the axes only: columns that stand side by side, each open to the next one."""
    chooser = np.random.default_rng((seed, columns, height))
    spans = [(0, height)]
    while len(spans) < columns:
        low, high = sorted(chooser.integers(0, height + 1, 2).tolist())
        if high - low >= 2 and min(high, spans[-1][1]) - max(low, spans[-1][0]) >= 1 and low != spans[-1][0] and high != spans[-1][1]:
            spans.append((low, high))
    widths = np.cumsum([0, *chooser.integers(3, 20, columns)]).tolist()
    below = [(x, low) for (low, _), left, right in zip(spans, widths, widths[1:], strict=False) for x in (left, right)]
    above = [(x, high) for (_, high), left, right in zip(spans, widths, widths[1:], strict=False) for x in (left, right)]
    return Polygon((*below, *above[::-1]))  # type: ignore[arg-type]


def _untangled(points: npt.NDArray[np.int64], chooser: np.random.Generator) -> npt.NDArray[np.int64]:
    """Return the points in an order in which no two edges of the ring cross: each change makes the ring shorter, so this ends."""
    while True:
        crossed = np.argwhere(np.triu(_crossings(points)))
        if not len(crossed):
            return points
        first, second = crossed[chooser.integers(len(crossed))].tolist()
        points[first + 1 : second + 1] = points[first + 1 : second + 1][::-1].copy()


def _crossings(points: npt.NDArray[np.int64]) -> npt.NDArray[np.bool_]:
    """Return which edges properly cross which others."""
    after = np.roll(points, -1, axis=0)
    way = after - points
    offset = points[None, :, :] - points[:, None, :]
    side = np.sign(way[:, None, 0] * offset[..., 1] - way[:, None, 1] * offset[..., 0])  # of corner j beside edge i
    apart = side * np.roll(side, -1, axis=1) < 0
    crossing: npt.NDArray[np.bool_] = apart & apart.T
    return crossing
