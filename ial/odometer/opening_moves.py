"""`OpeningMoves`: the commands with which a robot begins that knows nothing (O'Kane and LaValle 2007, section IV-B)."""

import math
from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import pairwise

from ial.odometer.command import Command
from ial.odometer.wall_table import WallTable

_LARGEST_STEP_DEG = 45
_SHARE = 0.45  # of the smallest corner: of two directions so far apart from one that is free, one is free, too
_PARTS = 2**20  # of a degree


class OpeningMoves:
    """Turns that lead a robot out of where it stands.

    Parameters
    ----------
    worlds
        The walls of the environments in which it may be.
    """

    def __init__(self, worlds: Sequence[WallTable]) -> None:
        smallest = min(_smallest_corner_deg(walls) for walls in worlds)
        self.step_deg = Fraction(max(int(min(_SHARE * smallest, _LARGEST_STEP_DEG) * _PARTS), 1), _PARTS)
        self._left = self.back(), self.across()

    def __repr__(self) -> str:
        return f"<OpeningMoves by {float(self.step_deg):g}°>"

    def next(self, measured: int) -> Command | None:
        """Return the next command; None if none is left.

        Parameters
        ----------
        measured
            How many drives have moved the robot since a wall stopped it first: after one, it is to drive across, after two it has begun.
        """
        return next((command for moves in self._left[measured:] for command in moves), None)

    def back(self) -> Iterator[Command]:
        """Yield the turns to try until the robot moves: back from the wall, which fails only in a corner, and then all around.

        Headings come in the order of van der Corput: halves, quarters, eighths of a turn, and so on. So a wide corner is left after few of
        them, and the sharpest one before they end.
        """
        yield Command(Fraction(180))
        at, count = Fraction(180), 2
        while count * self.step_deg < 2 * 360:
            for number in range(1, count, 2):
                heading = Fraction(360 * number, count)
                if heading != at:
                    yield Command(heading - at)
                    at = heading
            count *= 2

    def across(self) -> Iterator[Command]:
        """Yield the turns to try after a drive: to the left, to the right, and, if a sharp corner forbids both, beside the way back."""
        headings = [Fraction(0), Fraction(90), Fraction(-90), 180 - self.step_deg, 180 + self.step_deg]
        for before, heading in pairwise(headings):
            yield Command(heading - before)


def _smallest_corner_deg(walls: WallTable) -> float:
    """Return about the smallest angle inside of a convex corner, in degrees."""
    smallest = 180.0
    for corner, (_, before, reflex) in enumerate(walls.links.tolist()):
        (ex, _, ey, _), (ax, _, ay, _) = walls.edges[corner].tolist(), walls.edges[before].tolist()
        if not reflex:
            smallest = min(smallest, math.degrees(math.pi - math.atan2(ax * ey - ay * ex, ax * ex + ay * ey)))
    return smallest
