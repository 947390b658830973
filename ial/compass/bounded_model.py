"""`BoundedCompassModel`: a robot whose compass errs by at most an angle, in sets that hold every place it can be in."""

import math
from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import pairwise, product

import numpy as np
import numpy.typing as npt

from ial.compass.bounded_state import BoundedState, Span
from ial.compass.primitive import Direction, primitive
from ial.contractors import Boxes, Interval, atan2, check_rounding, cos, hypot, sin
from ial.errors import ConfigError
from ial.maps.polygons.polygon import Polygon
from ial.membership.model import Model

_PIECES = 64  # into how many a wall as long as the polygon is wide is divided
_PARTS = 3  # into how many the directions of a motion are divided
_MOST_ERROR_DEG = 10

FloatArray = npt.NDArray[np.float64]

PI = Interval(4) * atan2(Interval(1), Interval(1))
Row = tuple[int, int, float, float, float, float]  # an edge, the edge before if it is a corner, parts of the edge, and headings


class BoundedCompassModel(Model[BoundedState, Direction, None]):
    """Motions in a direction that is off by at most a bound, each time by another angle.

    This is not in the papers, whose robot needs an exact compass: there every segment is collapsed by a motion exactly along it. Here
    nothing collapses, but a motion that leads from a wall at a small angle maps the wall to a short piece of another one. A robot is
    localized when the set of its places is at most as wide as wanted.

    A set is an outer approximation. Pieces of walls and cones of directions are small boxes; where a box can hit a wall is enclosed by
    interval arithmetic, and a wall that all of a box is sure to hit hides what lies behind it.

    Parameters
    ----------
    polygon
        The environment; coordinates in metres.
    error_deg
        The bound of the error of the compass in degrees, above 0 and at most 10.

    Raises
    ------
    ConfigError
        If the bound is out of its range.
    """

    def __init__(self, polygon: Polygon, error_deg: float) -> None:
        check_rounding()
        if not 0.0 < error_deg <= _MOST_ERROR_DEG:
            raise ConfigError(
                f"the error of the compass is {error_deg:g}°; give a bound above 0 and of at most {_MOST_ERROR_DEG}°; without an error "
                "use CompassModel"
            )
        self.polygon = polygon
        self.error_deg = error_deg
        self._error = Interval(error_deg) * PI / 180
        corners = [corner for ring in polygon.rings for corner in ring]
        sizes = [len(ring) for ring in polygon.rings]
        begins = np.cumsum([0, *sizes])[:-1].tolist()
        self._after = [begin + (at + 1) % size for begin, size in zip(begins, sizes, strict=True) for at in range(size)]
        self._before = [begin + (at - 1) % size for begin, size in zip(begins, sizes, strict=True) for at in range(size)]
        ways = [(corners[to][0] - x, corners[to][1] - y) for (x, y), to in zip(corners, self._after, strict=True)]
        self._corner = tuple(_enclosed([corner[axis] for corner in corners]) for axis in range(2))
        self._way = tuple(_enclosed([way[axis] for way in ways]) for axis in range(2))
        self._headings = [atan2(Interval(y), Interval(x)) for x, y in ways]
        low_x, low_y, high_x, high_y = map(float, polygon.bounds)
        self._longest = max(high_x - low_x, high_y - low_y) / _PIECES
        self._lengths = [math.hypot(float(x), float(y)) for x, y in ways]

    def __repr__(self) -> str:
        return f"BoundedCompassModel({self.polygon!r}, {self.error_deg:g})"

    def universe(self) -> BoundedState:
        """Return the whole boundary, which stands for the whole polygon: see `Sequence`, the lemma is about each direction by itself."""
        return BoundedState.of((edge, 0.0, 1.0) for edge in range(len(self._after)))

    def predict(self, states: BoundedState, motion: Direction) -> BoundedState:
        """Return a set that holds every place to which a motion leads.

        Raises
        ------
        ConfigError
            If the motion is given in floats, or is (0, 0).
        """
        check_rounding()
        x, y = primitive(*motion)
        middle = atan2(Interval(y), Interval(x))
        low, high = (middle - self._error).lower, (middle + self._error).upper
        cuts = [low, *(min(high, low + (high - low) * part / _PARTS) for part in range(1, _PARTS)), high]
        stays: list[Span] = []
        rows: list[Row] = []
        for place, cone in product(self._places(states), pairwise(cuts)):
            self._divide(place, Interval.of_bounds(*cone), stays, rows)
        return BoundedState.of([*stays, *(self._hits(rows) if rows else ())])

    def step(self, states: BoundedState, motion: Direction, reading: None) -> BoundedState:
        """Return a set that holds every place to which a motion leads; the reading says nothing."""
        return self.predict(states, motion)

    def unite(self, allowed: BoundedState, predicted: BoundedState) -> BoundedState:
        """Return the union."""
        return BoundedState.of((*allowed.spans, *predicted.spans))

    def empty(self, states: BoundedState) -> bool:
        """Return whether no place is left."""
        return not states.spans

    def diameter_m(self, states: BoundedState) -> float:
        """Return a bound of how far two places of a set are apart, in metres, rounded up."""
        edges = np.array([edge for edge, _, _ in states.spans])
        parts = _column([low for _, low, _ in states.spans], [high for _, _, high in states.spans])
        x, y = (_at(corner, edges) + parts * _at(way, edges) for corner, way in zip(self._corner, self._way, strict=True))
        wide = Interval(x.lower.min(), x.upper.max()), Interval(y.lower.min(), y.upper.max())
        sides = [Interval(each.upper) - Interval(each.lower) for each in wide]
        return float(hypot(*sides).upper)

    def is_localized(self, states: BoundedState, within_m: float) -> bool:
        """Return whether no two places of a set are further apart than wanted, in metres."""
        return self.diameter_m(states) <= within_m

    def _places(self, states: BoundedState) -> Iterator[tuple[int, int, float, float]]:
        """Yield an edge, the edge before it for a corner and −1 for others, and parts of the edge: short pieces, and corners."""
        corners = set()
        for edge, low, high in states.spans:
            corners |= {edge} if low <= 0.0 else set()
            corners |= {self._after[edge]} if high >= 1.0 else set()
            count = max(1, math.ceil((high - low) * self._lengths[edge] / self._longest))
            cuts = [low, *(min(high, low + (high - low) * part / count) for part in range(1, count)), high]
            yield from ((edge, -1, one, other) for one, other in pairwise(cuts))
        yield from ((corner, self._before[corner], 0.0, 0.0) for corner in sorted(corners))

    def _divide(self, place: tuple[int, int, float, float], cone: Interval, stays: list[Span], rows: list[Row]) -> None:
        """Add what stays of a box of places and headings, and the box of what may leave."""
        edge, before, low, high = place
        opening = PI
        if before >= 0:  # how far the free space opens at the corner, counter-clockwise from its edge
            opening = _turned(self._headings[before] + PI - self._headings[edge], Interval(math.pi))
        turn = _turned(cone - self._headings[edge], opening / 2)
        if turn.lower <= 0.0 or turn.upper >= opening.lower:
            stays.append((edge, low, high))
            if before >= 0:
                stays.append((before, 1.0, 1.0))
        least, most = max(turn.lower, 0.0), min(turn.upper, opening.upper)
        if least <= most:
            headings = Interval.of_bounds(least, most) + self._headings[edge]
            rows.append((edge, before, low, high, headings.lower, headings.upper))

    def _hits(self, rows: list[Row]) -> Iterator[Span]:
        """Yield enclosures of where boxes of places and headings hit walls."""
        own = np.array([row[:2] for row in rows])
        parts, headings = (_column([row[at] for row in rows], [row[at + 1] for row in rows]) for at in (2, 4))
        dx, dy = cos(headings), sin(headings)
        x, y = (_at(corner, own[:, 0]) + parts * _at(way, own[:, 0]) for corner, way in zip(self._corner, self._way, strict=True))
        (cx, cy), (ex, ey) = ([_row(each) for each in pair] for pair in (self._corner, self._way))
        wx, wy = cx - x, cy - y
        across = dx * ey - dy * ex  # above 0 where the wall is hit from its free side
        beside = wx * dy - wy * dx
        part = beside / across
        turned = (abs(beside) / abs(across)).lower  # if the wall may be parallel: how many times its length a hit is away at least
        apart = (across.lower > 0.0) | (across.upper < 0.0)
        low, high = np.where(apart, np.maximum(part.lower, 0.0), 0.0), np.where(apart, np.minimum(part.upper, 1.0), 1.0)
        possible = (low <= high) & (across.upper > 0.0) & (apart | (turned <= 1.0))
        clipped = Boxes(np.where(possible, low, 0.0), np.where(possible, high, 1.0))
        far = dx * (wx + clipped * ex) + dy * (wy + clipped * ey)
        possible &= far.upper >= 0.0
        incident = np.zeros_like(possible)
        every = np.arange(len(rows))
        incident[every, own[:, 0]] = True
        incident[every[own[:, 1] >= 0], own[own[:, 1] >= 0, 1]] = True
        possible &= ~incident  # what stays on the wall where it is was dealt with
        sure = possible & (across.lower > 0.0) & (part.lower >= 0.0) & (part.upper <= 1.0) & (far.lower > 0.0)
        nearest = np.where(sure, far.upper, np.inf).min(axis=1, keepdims=True)
        possible &= far.lower <= nearest
        for row, wall in np.argwhere(possible).tolist():
            yield wall, float(low[row, wall]), float(high[row, wall])


def _enclosed(numbers: Sequence[Fraction]) -> Boxes:
    """Return rational numbers as a column of intervals."""
    return Boxes.of(*([Interval(number)] for number in numbers))


def _column(lower: list[float], upper: list[float]) -> Boxes:
    return Boxes(np.array(lower)[:, None], np.array(upper)[:, None])


def _row(column: Boxes) -> Boxes:
    return Boxes(column.lower.T, column.upper.T)


def _at(column: Boxes, rows: npt.NDArray[np.int64]) -> Boxes:
    lower: FloatArray = column.lower[rows]
    upper: FloatArray = column.upper[rows]
    return Boxes(lower, upper)


def _turned(angle: Interval, around: Interval) -> Interval:
    """Return an angle shifted by whole turns so that its middle is within half a turn of another one's."""
    turns = round((around.midpoint - angle.midpoint) / (2.0 * math.pi))
    turned: Interval = angle + Interval(turns) * 2 * PI
    return turned
