"""`Shooter`: where a point that drives straight on in a polygon stops, exactly.

The free space is closed: a point may slide along a wall and pass a corner that it only touches. Two things stop it: the inside of a wall
that it would cross, and a corner at which no free space is ahead. There are no further cases: grazing a corner, hitting one, sliding along
walls that lie on one line, and leaving a reflex corner all follow from these two (O'Kane and LaValle 2007, section III; closed rays).
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from ial.contractors.margins import ROUNDINGS
from ial.maps.polygons.exact.rational import Rational, rational
from ial.maps.polygons.polygon import ExactPoint, Polygon

_LEAST, _MOST = 2.0**-500, 2.0**500  # of a component of a direction that a double holds with all its digits, and its square nearly

FloatArray = npt.NDArray[np.float64]
Direction = tuple[int | Rational, int | Rational]


@dataclass(frozen=True)
class BoundaryPoint:
    """A point on the boundary.

    Parameters
    ----------
    x, y
        Where it is, exactly, in metres.
    edge
        The number of an edge that holds it: of the edge that begins at it, if it is a corner.
    corner
        Whether it is a corner.
    """

    x: Rational
    y: Rational
    edge: int
    corner: bool

    @property
    def place(self) -> ExactPoint:
        """Where it is: x and y in metres."""
        return self.x, self.y


class Shooter:
    """The walls of a polygon, its edges numbered through: those of the outer ring first; the free space is on the left of each.

    Parameters
    ----------
    polygon
        The free space.

    Attributes
    ----------
    size_m
        The longer side of the box around it, in metres.

    Examples
    --------
    >>> from fractions import Fraction
    >>> from ial.maps.polygons.polygon import Polygon
    >>> shooter = Shooter(Polygon(((0, 0), (4, 0), (4, 3), (0, 3))))
    >>> hit = shooter.shoot((Fraction(1), Fraction(0)), (1, 2))
    >>> str(hit.x), str(hit.y), hit.edge, hit.corner
    ('5/2', '3', 2, False)
    """

    def __init__(self, polygon: Polygon) -> None:
        self.polygon = polygon
        self.corners = [(rational(x), rational(y)) for ring in polygon.rings for x, y in ring]
        self.after, self.before = _links([len(ring) for ring in polygon.rings])
        self.edges = [(bx - ax, by - ay) for (ax, ay), (bx, by) in zip(self.corners, (self.corners[to] for to in self.after), strict=True)]
        low_x, low_y, high_x, high_y = (rational(each) for each in polygon.bounds)
        self._middle = (low_x + high_x) / 2, (low_y + high_y) / 2
        # How far a corner is aside and ahead is a sum of two products, each of a part of 1 and of at most the size of the polygon; what
        # `_first` makes of them has terms of at most four times the size.
        self.size_m = float(max(high_x - low_x, high_y - low_y))
        self._doubt = 8.0 * ROUNDINGS * self.size_m
        mx, my = self._middle
        self._x = np.array([float(x - mx) for x, _ in self.corners])
        self._y = np.array([float(y - my) for _, y in self.corners])
        self._next = np.array(self.after)

    def __repr__(self) -> str:
        return f"<Shooter among {len(self.corners)} walls>"

    def __len__(self) -> int:
        return len(self.corners)

    @cached_property
    def touched(self) -> dict[int, list[int]]:
        """For each corner of a ring that touches another ring inside of its edges: which edges. Other corners are left out."""
        if not self.polygon.holes:
            return {}
        found: dict[int, list[int]] = {}
        for corner, (x, y) in enumerate(self.corners):
            for edge, ((ax, ay), (ex, ey)) in enumerate(zip(self.corners, self.edges, strict=True)):
                if ex * (y - ay) == ey * (x - ax) and 0 < ex * (x - ax) + ey * (y - ay) < ex * ex + ey * ey:
                    found.setdefault(corner, []).append(edge)
        return found

    def corner(self, number: int) -> BoundaryPoint:
        """Return a corner, which has the number of the edge that begins there."""
        return BoundaryPoint(*self.corners[number], number, True)

    def on_edge(self, number: int, part: Rational) -> BoundaryPoint:
        """Return the point at a part of an edge: 0 at its beginning, 1 at its end."""
        if part in (0, 1):
            return self.corner(self.after[number] if part else number)
        (x, y), (ex, ey) = self.corners[number], self.edges[number]
        return BoundaryPoint(x + part * ex, y + part * ey, number, False)

    def part(self, point: BoundaryPoint, edge: int) -> Rational:
        """Return which part of an edge lies before a point on it."""
        (x, y), (ex, ey) = self.corners[edge], self.edges[edge]
        return (point.x - x) / ex if ex else (point.y - y) / ey

    def shoot(self, start: Sequence[Rational], direction: Direction) -> BoundaryPoint:
        """Return where a point stops that starts in the closed polygon.

        Parameters
        ----------
        start
            x and y in metres, in the closed polygon; elsewhere the result means nothing.
        direction
            Where it drives, as a vector of any length but 0.
        """
        return self.shoot_all([start], [direction])[0]

    def shoot_all(self, starts: Sequence[Sequence[Rational]], directions: Sequence[Direction]) -> list[BoundaryPoint]:
        """Return where points stop, as `shoot` does for each start and its direction; much faster for many of them."""
        mx, my = self._middle
        units = np.array([_unit(*direction) for direction in directions]).reshape(-1, 2)
        places = np.array([(float(px - mx), float(py - my)) for px, py in starts]).reshape(-1, 2)
        x, y = self._x - places[:, :1], self._y - places[:, 1:]
        dx, dy = units[:, :1], units[:, 1:]
        aside, ahead = dx * y - dy * x, dx * x + dy * y
        sides = np.sign(aside).astype(np.int8)
        on_line: list[list[int]] = [[] for _ in starts]
        for ray, corner in np.argwhere(np.abs(aside) < self._doubt).tolist():
            sides[ray, corner] = self.side(corner, starts[ray], directions[ray])
            if sides[ray, corner] == 0:
                on_line[ray].append(corner)
        crossed: list[list[int]] = [[] for _ in starts]
        for ray, edge in self._first(sides, aside, ahead):
            crossed[ray].append(edge)
        return [self._stop(*each) for each in zip(starts, directions, on_line, crossed, strict=True)]

    def _stop(self, start: Sequence[Rational], direction: Direction, on_line: list[int], crossed: list[int]) -> BoundaryPoint:
        """Return where a point stops, if some corners lie on the line of its ray, and the ray may first cross one of some edges."""
        px, py = start
        ux, uy = direction
        best: BoundaryPoint | None = None
        way: Rational | None = None
        for corner in on_line:  # first, so that the end of a wall that is hit is a corner
            cx, cy = self.corners[corner]
            further = ((cx - px) * ux + (cy - py) * uy) / rational(ux * ux + uy * uy)
            if further >= 0 and (way is None or further < way) and not self.is_open(corner, ux, uy):
                best, way = BoundaryPoint(cx, cy, corner, True), further
        for edge in crossed:
            (cx, cy), (ex, ey) = self.corners[edge], self.edges[edge]
            further = ((cx - px) * ey - (cy - py) * ex) / rational(ux * ey - uy * ex)
            if further >= 0 and (way is None or further < way):
                best, way = BoundaryPoint(px + further * ux, py + further * uy, edge, False), further
        if best is None:
            raise AssertionError("a ray that starts in a bounded polygon ends")
        return best

    def _first(self, sides: npt.NDArray[np.int8], aside: FloatArray, ahead: FloatArray) -> list[tuple[int, int]]:
        """Return pairs of a ray and an edge that may be the first one it crosses, by doubles: how far corners are aside and ahead."""
        ray, edge = np.nonzero((sides < 0) & (sides[:, self._next] > 0))
        after = self._next[edge]
        across = np.abs(aside[ray, edge]) + np.abs(aside[ray, after])
        one, other = ahead[ray, edge], ahead[ray, after]
        doubt = self._doubt
        part = np.abs(aside[ray, edge]) / np.maximum(across, doubt)
        middle, reach = one + part * (other - one), np.abs(other - one) * np.minimum(2.0 * doubt / np.maximum(across, doubt), 1.0) + doubt
        least, most = np.maximum(middle - reach, np.minimum(one, other) - doubt), np.minimum(middle + reach, np.maximum(one, other) + doubt)
        nearest = np.full(len(sides), np.inf)
        sure = least >= 0.0
        np.minimum.at(nearest, ray[sure], most[sure])
        kept = (most >= 0.0) & (least <= nearest[ray])
        return list(zip(ray[kept].tolist(), edge[kept].tolist(), strict=True))

    def is_open(self, corner: int, ux: int | Rational, uy: int | Rational) -> bool:
        """Return whether a point at a corner can leave it in a direction, along one of its walls included."""
        (ax, ay), (bx, by) = self.edges[self.before[corner]], self.edges[corner]
        along = bx * uy - by * ux
        against = ax * uy - ay * ux  # cross(u, −a)
        if ax * by - ay * bx > 0:
            return along >= 0 and against >= 0
        return along >= 0 or against >= 0  # a reflex corner, or one on a straight wall

    def side(self, corner: int, start: Sequence[Rational], direction: Direction) -> int:
        """Return 1 if a corner lies to the left of a ray's line, 0 on it, −1 to its right."""
        (x, y), (px, py), (ux, uy) = self.corners[corner], start, direction
        value = ux * (y - py) - uy * (x - px)
        return (value > 0) - (value < 0)


def _links(sizes: Sequence[int]) -> tuple[list[int], list[int]]:
    """Return for each corner of some rings the number of the next one, and of the one before."""
    after, before, begin = [], [], 0
    for size in sizes:
        after += [begin + (at + 1) % size for at in range(size)]
        before += [begin + (at - 1) % size for at in range(size)]
        begin += size
    return after, before


def _unit(ux: int | Rational, uy: int | Rational) -> tuple[float, float]:
    """Return a direction as doubles, of about length 1; whole numbers may be too large for a double."""
    try:
        x, y = float(ux), float(uy)
    except OverflowError:
        x = y = math.inf
    if not _LEAST < max(abs(x), abs(y)) < _MOST:
        exact_x, exact_y = rational(ux), rational(uy)
        largest = max(abs(exact_x), abs(exact_y))
        x, y = float(exact_x / largest), float(exact_y / largest)
    length = math.hypot(x, y)
    return x / length, y / length
