"""`Polygon`: an area with holes whose corners are exact rational points, the free space of a robot."""

import math
from collections import defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

from ial.errors import MapError
from ial.maps.polygons.ring import Point, Ring, contacts, doubled_area, edges, side

ExactPoint = tuple[Fraction, Fraction]
ExactRing = tuple[ExactPoint, ...]


@dataclass(frozen=True)
class Polygon:
    """A closed area: the inside of an outer ring without the open insides of its holes.

    Rings close by themselves: their first point is not repeated at the end. Two rings may touch in single points, as in the simple
    features of the OGC; a ring does not touch itself.

    Parameters
    ----------
    outer
        The outer ring, in metres; it is turned counter-clockwise.
    holes
        The rings of the holes; they are turned clockwise.

    Raises
    ------
    MapError
        If a ring has fewer than three corners, no area or a repeated corner, touches or crosses itself or crosses another one, or a hole
        does not lie inside of the outer ring or lies in another hole.
    """

    outer: ExactRing
    holes: tuple[ExactRing, ...] = ()

    def __post_init__(self) -> None:
        rings = [tuple((Fraction(x), Fraction(y)) for x, y in ring) for ring in (self.outer, *self.holes)]
        scale = common_denominator(rings)
        whole = [scaled(ring, scale) for ring in rings]
        for index, ring in enumerate(whole):
            _check_ring(ring, _name(index))
        _check_contacts(whole, scale)
        turned = (_turned(ring, doubled_area(same) > 0, index == 0) for index, (ring, same) in enumerate(zip(rings, whole, strict=True)))
        object.__setattr__(self, "outer", next(turned))
        object.__setattr__(self, "holes", tuple(turned))

    def __repr__(self) -> str:
        corners = "corner" if len(self.outer) == 1 else "corners"
        return f"<Polygon: {len(self.outer)} {corners}, {len(self.holes)} {'hole' if len(self.holes) == 1 else 'holes'}>"

    @classmethod
    def trusted(cls, outer: ExactRing, holes: tuple[ExactRing, ...]) -> "Polygon":
        """Return a polygon from rings of which the caller knows that they are in order, and turned the right way."""
        polygon = object.__new__(cls)
        object.__setattr__(polygon, "outer", outer)
        object.__setattr__(polygon, "holes", holes)
        return polygon

    @property
    def rings(self) -> tuple[ExactRing, ...]:
        """The outer ring and the holes."""
        return (self.outer, *self.holes)

    @property
    def area(self) -> Fraction:
        """The area of the free space in square metres."""
        scale = common_denominator(self.rings)
        return Fraction(sum(doubled_area(scaled(ring, scale)) for ring in self.rings), 2 * scale * scale)

    @property
    def bounds(self) -> tuple[Fraction, Fraction, Fraction, Fraction]:
        """The least and the greatest coordinates: (x, y, x, y)."""
        xs, ys = zip(*self.outer, strict=True)
        return min(xs), min(ys), max(xs), max(ys)


def common_denominator(rings: Iterable[ExactRing]) -> int:
    """Return the least whole number that makes every coordinate whole."""
    return math.lcm(*{number.denominator for ring in rings for point in ring for number in point})


def scaled(ring: ExactRing, scale: int) -> list[Point]:
    """Return a ring with coordinates multiplied by a number that makes them whole."""
    return [(int(x * scale), int(y * scale)) for x, y in ring]


def _name(index: int) -> str:
    return "the outer ring" if index == 0 else f"hole {index}"


def _turned(ring: ExactRing, left: bool, wanted: bool) -> ExactRing:
    return ring if left == wanted else (ring[0], *ring[:0:-1])


def _check_ring(ring: Ring, name: str) -> None:
    if len(ring) < 3:
        raise MapError(f"{name} has {len(ring)} corners; give at least three")
    if len(set(ring)) < len(ring):
        raise MapError(f"{name} has a corner twice; give each corner once, and leave out the repeated first one")
    if doubled_area(ring) == 0:
        raise MapError(f"{name} has no area: its corners lie on a line, or it crosses itself; give a simple ring")


def _near_pairs(rings: list[list[Point]]) -> Iterator[tuple[tuple[int, int, Point, Point], tuple[int, int, Point, Point]]]:
    """Yield the pairs of edges whose boxes meet, each edge with the number of its ring and its own."""
    every = [(ring, at, a, b) for ring, points in enumerate(rings) for at, (a, b) in enumerate(edges(points))]
    every.sort(key=lambda edge: min(edge[2][0], edge[3][0]))
    active: list[tuple[int, int, Point, Point]] = []
    for edge in every:
        left, low, high = min(edge[2][0], edge[3][0]), min(edge[2][1], edge[3][1]), max(edge[2][1], edge[3][1])
        active = [other for other in active if max(other[2][0], other[3][0]) >= left]
        for other in active:
            if min(other[2][1], other[3][1]) <= high and max(other[2][1], other[3][1]) >= low:
                yield other, edge
        active.append(edge)


def _check_contacts(rings: list[list[Point]], scale: int) -> None:
    """Raise unless the rings touch in single points only and lie in each other as they should."""
    touched: defaultdict[tuple[int, int], list[Point]] = defaultdict(list)
    for (ring, at, a, b), (other, to, c, d) in _near_pairs(rings):
        points = contacts(a, b, c, d)
        if points == ():
            continue
        neighbours = ring == other and abs(at - to) in (1, len(rings[ring]) - 1)
        if points is None or (ring == other and not neighbours):
            both = (
                f"{_name(ring)} crosses or touches itself"
                if ring == other
                else f"{_name(min(ring, other))} and {_name(max(ring, other))} cross"
            )
            place = f"({float(Fraction(c[0], scale)):g}, {float(Fraction(c[1], scale)):g})"
            raise MapError(f"{both} at the edge that starts at {place}; correct the corners so that rings meet in single points at most")
        if ring != other:
            touched[ring, at] += points
            touched[other, to] += points
    boxes = [tuple((min(each), max(each)) for each in zip(*ring, strict=True)) for ring in rings]
    for index, hole in enumerate(rings[1:], 1):
        pieces = list(_pieces(hole, index, touched))
        for point in pieces if len(pieces) > len(hole) or any((index, at) in touched for at in range(len(hole))) else pieces[:1]:
            _check_place(point, index, rings, boxes)


def _pieces(hole: list[Point], index: int, touched: dict[tuple[int, int], list[Point]]) -> Iterator[Point]:
    """Yield the middles of the parts of the edges between contacts, in coordinates that are doubled."""
    for at, (a, b) in enumerate(edges(hole)):
        stops = sorted({a, b, *touched.get((index, at), ())})
        for (x0, y0), (x1, y1) in pairwise(stops):
            yield x0 + x1, y0 + y1


def _check_place(doubled: Point, index: int, rings: list[list[Point]], boxes: list[tuple[Point, ...]]) -> None:
    for other, ring in enumerate(rings):
        if other == index:
            continue
        if other > 0 and any(not 2 * low <= at <= 2 * high for at, (low, high) in zip(doubled, boxes[other], strict=True)):
            continue  # outside of the box, so outside of the hole
        position = side(doubled, [(2 * x, 2 * y) for x, y in ring])
        if other == 0 and position < 0:
            raise MapError(f"hole {index} does not lie inside of the outer ring; move it in, or leave it out")
        if other > 0 and position > 0:
            raise MapError(f"hole {index} lies in hole {other}, which is no free space; leave it out")
