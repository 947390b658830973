"""`VisibilityPolygon`: all that a point of a polygon sees, exactly, and which of its edges are no walls."""

from dataclasses import dataclass
from functools import cmp_to_key

from ial.maps.polygons.exact.rational import Rational, rational
from ial.maps.polygons.exact.shooter import Shooter
from ial.maps.polygons.polygon import ExactPoint

SPURIOUS = -1
_AXES = ((1, 0), (0, 1), (-1, 0), (0, -1))


@dataclass(frozen=True)
class VisibilityPolygon:
    """The closed set of points that a point sees: the whole segment between the two lies in the closed free space.

    Lines of sight that have no width, such as those between two walls that touch, are left out.

    Parameters
    ----------
    place
        The point, x and y in metres.
    corners
        The ring of the set, counter-clockwise; the point itself is one of them if it lies on the boundary, and nothing is seen behind it.
    walls
        Of what wall the edge from each corner to the next one is a part; `SPURIOUS` for one that runs along a ray past a corner (O'Kane
        2005, section 3.2.2), or along the boundary to the point itself.

    Examples
    --------
    >>> from fractions import Fraction
    >>> from ial.maps.polygons.polygon import Polygon
    >>> corner = Shooter(Polygon(((0, 0), (4, 0), (4, 2), (2, 2), (2, 4), (0, 4))))
    >>> seen = VisibilityPolygon.of(corner, (Fraction(3), Fraction(1)))
    >>> [(str(x), str(y)) for x, y in seen.corners]
    [('4', '2'), ('2', '2'), ('0', '4'), ('0', '0'), ('4', '0')]
    >>> seen.walls
    (2, -1, 5, 0, 1)
    """

    place: ExactPoint
    corners: tuple[ExactPoint, ...]
    walls: tuple[int, ...]

    def __repr__(self) -> str:
        return f"<VisibilityPolygon of {len(self.corners)} corners, {self.walls.count(SPURIOUS)} spurious edges>"

    @classmethod
    def of(cls, shooter: Shooter, place: ExactPoint) -> "VisibilityPolygon":
        """Return what a point of the closed polygon sees; elsewhere the result means nothing."""
        px, py = place
        aims = [(x - px, y - py) for x, y in shooter.corners if (x, y) != (px, py)]
        rays = _in_order([*aims, *((rational(x), rational(y)) for x, y in _AXES)])
        pieces: list[tuple[ExactPoint, ExactPoint, int]] = []
        for at, first in enumerate(rays):
            last = rays[(at + 1) % len(rays)]
            hit = shooter.shoot(place, (first[0] + last[0], first[1] + last[1]))  # between the two nothing begins and nothing ends
            if hit.place == (px, py):
                continue
            ends = [_meet(place, ray, shooter.corners[hit.edge], shooter.edges[hit.edge]) for ray in (first, last)]
            pieces.append((ends[0], ends[1], hit.edge))
        return cls(place, *_ring(place, pieces))

    @property
    def spurious(self) -> tuple[tuple[ExactPoint, ExactPoint], ...]:
        """The edges that are no walls: from the corner nearer to the start of the ring to the next one."""
        after = (*self.corners[1:], self.corners[0])
        return tuple(
            (begin, end)
            for begin, end, wall in zip(self.corners, after, self.walls, strict=True)
            if wall == SPURIOUS and self.place not in (begin, end)
        )


def _in_order(aims: list[tuple[Rational, Rational]]) -> list[tuple[Rational, Rational]]:
    """Return one of each direction, counter-clockwise from the x axis on."""

    def half(aim: tuple[Rational, Rational]) -> int:
        return 0 if aim[1] > 0 or (aim[1] == 0 and aim[0] > 0) else 1

    def compare(one: tuple[Rational, Rational], other: tuple[Rational, Rational]) -> int:
        turn = one[0] * other[1] - one[1] * other[0]
        return half(one) - half(other) or (turn < 0) - (turn > 0)

    kept: list[tuple[Rational, Rational]] = []
    for aim in sorted(aims, key=cmp_to_key(compare)):
        if not kept or compare(kept[-1], aim):
            kept.append(aim)
    return kept


def _meet(place: ExactPoint, ray: tuple[Rational, Rational], corner: ExactPoint, edge: tuple[Rational, Rational]) -> ExactPoint:
    """Return where a ray meets the line of a wall."""
    (px, py), (ux, uy), (x, y), (ex, ey) = place, ray, corner, edge
    way = ((x - px) * ey - (y - py) * ex) / (ux * ey - uy * ex)
    return px + way * ux, py + way * uy


def _ring(place: ExactPoint, pieces: list[tuple[ExactPoint, ExactPoint, int]]) -> tuple[tuple[ExactPoint, ...], tuple[int, ...]]:
    """Return the corners and the walls of the ring that pieces of walls make, counter-clockwise around a point."""
    edges: list[tuple[ExactPoint, int]] = []  # where an edge begins, and its wall
    for at, (begin, end, wall) in enumerate(pieces):
        if not edges or edges[-1][1] != wall or pieces[at - 1][1] != begin:
            edges.append((begin, wall))
        following = pieces[(at + 1) % len(pieces)][0]
        if following != end:
            edges.append((end, SPURIOUS))
            if _behind(place, end, following):  # nothing is seen between the two
                edges.append((place, SPURIOUS))
    if len(edges) > 1 and edges[0][1] == edges[-1][1] != SPURIOUS and pieces[-1][1] == pieces[0][0]:
        edges.pop(0)
    return tuple(corner for corner, _ in edges), tuple(wall for _, wall in edges)


def _behind(place: ExactPoint, end: ExactPoint, following: ExactPoint) -> bool:
    (px, py), (ax, ay), (bx, by) = place, end, following
    turn = (ax - px) * (by - py) - (ay - py) * (bx - px)
    return bool(turn != 0 or (ax - px) * (bx - px) + (ay - py) * (by - py) < 0)
