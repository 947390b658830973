"""`InformationState`: where on the boundary a robot can be, as open pieces of walls and single points, exactly."""

from collections.abc import Iterable
from dataclasses import dataclass

from ial.maps.polygons.exact.rational import Rational, rational
from ial.maps.polygons.exact.shooter import BoundaryPoint, Shooter
from ial.maps.polygons.polygon import ExactPoint


@dataclass(frozen=True)
class Piece:
    """An open piece of an edge.

    Parameters
    ----------
    edge
        The number of the edge.
    low, high
        The parts of the edge that lie before its ends.
    """

    edge: int
    low: Rational
    high: Rational


@dataclass(frozen=True)
class InformationState:
    """Pieces that do not overlap, by their edges, and points that lie in none of them (O'Kane 2005, section 3.1).

    Parameters
    ----------
    pieces
        Sorted; two of them on one edge have a gap or a point that does not belong to the state between them.
    points
        No two at the same place; sorted by edge and place.
    """

    pieces: tuple[Piece, ...]
    points: tuple[BoundaryPoint, ...]

    def __repr__(self) -> str:
        return f"<InformationState of {len(self.pieces)} pieces and {len(self.points)} points>"

    @classmethod
    def of(cls, shooter: Shooter, pieces: Iterable[Piece], points: Iterable[BoundaryPoint]) -> "InformationState":
        """Return the state that pieces and points make, in whatever order they come and however they overlap.

        Pieces that overlap are merged, two that meet in a point of the state are joined, and points that a piece covers are dropped.
        """
        places = {point.place: point for point in points}
        on_edges: dict[int, list[BoundaryPoint]] = {}
        for point in places.values():
            for edge in shooter.touched.get(point.edge, ()) if point.corner else (point.edge,):
                on_edges.setdefault(edge, []).append(point)
        by_edge: dict[int, list[tuple[Rational, Rational]]] = {}
        for piece in pieces:
            by_edge.setdefault(piece.edge, []).append((piece.low, piece.high))
        merged = []
        for edge in sorted(by_edge):
            inside = {shooter.part(point, edge): point.place for point in on_edges.get(edge, ())}
            spans = _merged(sorted(by_edge[edge]), inside)
            for part, place in inside.items():
                if any(low < part < high for low, high in spans):
                    places.pop(place, None)  # two walls may hold it, where rings touch
            merged += [Piece(edge, low, high) for low, high in spans]
        return cls(tuple(merged), tuple(sorted(places.values(), key=lambda point: (point.edge, shooter.part(point, point.edge)))))

    @classmethod
    def boundary(cls, shooter: Shooter) -> "InformationState":
        """Return the state in which nothing is known but that the robot is at a wall: every edge and every corner."""
        walls = range(len(shooter))
        return cls.of(shooter, [Piece(edge, rational(0), rational(1)) for edge in walls], [shooter.corner(each) for each in walls])

    @property
    def sizes(self) -> tuple[int, int]:
        """How many pieces and how many points there are."""
        return len(self.pieces), len(self.points)

    @property
    def single(self) -> ExactPoint | None:
        """The one place where the robot is, if it is only one."""
        return self.points[0].place if self.sizes == (0, 1) else None


def _merged(spans: list[tuple[Rational, Rational]], inside: dict[Rational, ExactPoint]) -> list[tuple[Rational, Rational]]:
    """Merge open intervals that are sorted; two that touch are joined if the point between them is one of some others."""
    merged = [spans[0]]
    for low, high in spans[1:]:
        begin, end = merged[-1]
        if low < end or (low == end and low in inside):
            merged[-1] = begin, max(end, high)
        else:
            merged.append((low, high))
    return merged
