"""Closed rings of exact points: area, contacts of edges, and on which side a point lies.

All functions take whole coordinates, so that every answer is exact; `Polygon` scales its fractions before it asks.
"""

from collections.abc import Iterator, Sequence

Point = tuple[int, int]
Ring = Sequence[Point]


def doubled_area(ring: Ring) -> int:
    """Return twice the signed area: positive for a counter-clockwise ring."""
    return sum(x0 * y1 - x1 * y0 for (x0, y0), (x1, y1) in edges(ring))


def edges(ring: Ring) -> Iterator[tuple[Point, Point]]:
    """Yield the edges of a ring, the last one back to its start."""
    return zip(ring, [*ring[1:], ring[0]], strict=True)


def cross(a: Point, b: Point, c: Point) -> int:
    """Return twice the signed area of a triangle: positive if c lies to the left of a → b."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def on_edge(point: Point, a: Point, b: Point) -> bool:
    """Return whether a point lies on a closed edge."""
    return cross(a, b, point) == 0 and min(a[0], b[0]) <= point[0] <= max(a[0], b[0]) and min(a[1], b[1]) <= point[1] <= max(a[1], b[1])


def side(point: Point, ring: Ring) -> int:
    """Return 1 for a point inside of a ring, 0 on it, −1 outside; by counting the edges to its right."""
    x, y = point
    inside = False
    for a, b in edges(ring):
        if on_edge(point, a, b):
            return 0
        if (a[1] > y) != (b[1] > y):  # half open: a vertex belongs to one of its two edges
            turn = (b[0] - a[0]) * (y - a[1]) - (x - a[0]) * (b[1] - a[1])
            inside ^= (turn > 0) == (b[1] > a[1])
    return 1 if inside else -1


def contacts(a: Point, b: Point, c: Point, d: Point) -> tuple[Point, ...] | None:
    """Return the points at which ends of one edge touch the other edge; None if the two cross or share more than a point."""
    touching = {point for point, start, end in ((a, c, d), (b, c, d), (c, a, b), (d, a, b)) if on_edge(point, start, end)}
    if len(touching) > 1:
        return None
    if not touching:
        crossed = cross(a, b, c) * cross(a, b, d) < 0 and cross(c, d, a) * cross(c, d, b) < 0
        return None if crossed else ()
    return tuple(touching)
