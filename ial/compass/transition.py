"""`Transition`: which information state follows from another by a motion, exactly."""

from collections import OrderedDict
from collections.abc import Sequence

import numpy as np

from ial.compass.primitive import Direction
from ial.compass.state import InformationState, Piece
from ial.compass.strips import Strips
from ial.maps.polygons.exact.rational import rational
from ial.maps.polygons.exact.shooter import BoundaryPoint, Shooter

_KEPT_CELLS = 2**25  # entries of the tables of strips that are kept: directions along walls come again and again


class Transition:
    """The map F from an information state and a direction to the next information state (O'Kane 2005, equation 2.4 and algorithm 3.1).

    It is exact, and departs from the thesis' text in two points: the sweep line is parallel to the direction, and the points of a piece
    from which the robot passes or hits a corner are mapped by themselves, so that the corner is in the next state. Polygons may have holes.

    Parameters
    ----------
    shooter
        The walls.
    """

    def __init__(self, shooter: Shooter) -> None:
        self.shooter = shooter
        self._strips: OrderedDict[Direction, Strips] = OrderedDict()

    def __repr__(self) -> str:
        return f"<Transition in {self.shooter!r}>"

    def __call__(self, state: InformationState, direction: Direction) -> InformationState:
        """Return every place in which a robot of the state can stop that drives in a direction."""
        pieces: list[Piece] = []
        inside: list[BoundaryPoint] = []
        passing: list[tuple[int, int]] = []
        for piece in state.pieces:
            strips = self.strips(direction)
            turn = strips.turn(piece.edge)
            if turn < 0:
                pieces.append(piece)
            elif turn == 0:
                inside.append(self.shooter.on_edge(piece.edge, (piece.low + piece.high) / 2))
            else:
                _sweep(strips, piece, pieces, passing)
        points = self.points([*state.points, *inside], [direction])[0]
        passed = self.strips(direction).passed(passing) if passing else []
        return InformationState.of(self.shooter, pieces, [*points, *passed])

    def points(self, points: Sequence[BoundaryPoint], directions: Sequence[Direction]) -> list[tuple[BoundaryPoint, ...]]:
        """Return for each of some directions where robots stop that start at points of the boundary."""
        images = [list(points) for _ in directions]
        leaving = []
        for at, (ux, uy) in enumerate(directions):
            for number, point in enumerate(points):
                ex, ey = self.shooter.edges[point.edge]
                if point.corner or ex * uy >= ey * ux:  # others drive into the wall on which they are
                    leaving.append((at, number))
        stops = self.shooter.shoot_all([points[number].place for _, number in leaving], [directions[at] for at, _ in leaving])
        for (at, number), stop in zip(leaving, stops, strict=True):
            images[at][number] = stop
        return [tuple(each) for each in images]

    def strips(self, direction: Direction) -> Strips:
        """Return the strips of a direction, those that were needed last without computing them again."""
        if direction in self._strips:
            self._strips.move_to_end(direction)
        else:
            self._strips[direction] = Strips(self.shooter, direction)
            while len(self._strips) > 2 and len(self._strips) * len(self.shooter) ** 2 > _KEPT_CELLS:
                self._strips.popitem(last=False)
        return self._strips[direction]


def _sweep(strips: Strips, piece: Piece, pieces: list[Piece], passing: list[tuple[int, int]]) -> None:
    """Add the image of a piece with free space ahead: a piece for each wall that is hit, and the places from which corners are passed."""
    edge = piece.edge
    high, low = rational(strips.level(edge, piece.low)), rational(strips.level(edge, piece.high))  # the level falls along such an edge
    first, (last, exact) = strips.strip(low)[0], strips.strip(high)
    last = last - 1 if exact else last
    hits = strips.ahead[first : last + 1, edge]
    changes = [*(1 + np.flatnonzero(hits[1:] != hits[:-1])).tolist(), len(hits)]
    begin = 0
    for change in changes:
        hit = int(hits[begin])
        lower = low if begin == 0 else strips.levels[first + begin]
        upper = high if change == len(hits) else strips.levels[first + change]
        pieces.append(Piece(hit, strips.part(hit, lower), strips.part(hit, upper)))
        if change < len(hits):
            passing.append((edge, first + change))
        begin = change
