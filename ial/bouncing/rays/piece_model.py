"""`PieceModel`: the set filter on a fixed grid of pieces of walls."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ial.bouncing.rays.first_bump import FirstBumps
from ial.bouncing.rays.piece_map import PieceMap
from ial.contractors.kernels import kernel
from ial.membership.model import Model

IntArray = npt.NDArray[np.int32]

NOT_BUMPED = -1


@dataclass(frozen=True, eq=False)
class PieceSet:
    """Pieces that the robot may have left from, each with the number of steps since.

    Parameters
    ----------
    pieces
        Numbers of pieces, int32; −1 for a robot that has not bumped yet.
    steps
        How many steps were observed since the last bump, int32.
    """

    pieces: IntArray
    steps: IntArray

    def __len__(self) -> int:
        return len(self.pieces)

    def __repr__(self) -> str:
        return f"<PieceSet of {len(self)} pieces>"


@kernel
def _mark(starts, ends, least, most, pieces, steps, parts, headings, first_turn, last_turn, marked):  # type: ignore[no-untyped-def]
    """Mark the pieces in which robots are that bump now."""
    for i in range(len(pieces)):
        heading = pieces[i] // parts
        for at in range(starts[pieces[i]], starts[pieces[i] + 1]):
            if least[at] <= steps[i] <= most[at]:
                for turn in range(first_turn, last_turn + 1):
                    marked[(heading + turn) % headings * parts + ends[at]] = True


class PieceModel(Model[PieceSet, None, int]):
    """Sets of pieces; a reading is 1 for a bump and 0 for a step without one. A motion is always None.

    Parameters
    ----------
    map_
        The pieces, and where robots come to from them.
    first
        Where the robot can be after its first bump; on any piece on which it can stand, if that is left out.

    Examples
    --------
    >>> from fractions import Fraction
    >>> from ial.bouncing import ExecutionBounds, PieceMap, PieceModel
    >>> from ial.maps import Environment
    >>> from ial.maps.polygons.polygon import Polygon
    >>> corners = [(0, 0), (4, 0), (4, 3), (0, 3)]
    >>> room = Environment((Polygon(tuple((Fraction(x), Fraction(y)) for x, y in corners)),))
    >>> pieces = PieceMap.of(room, Fraction(100), Fraction(1, 2), ExecutionBounds(), Fraction(1), 36)
    >>> model = PieceModel(pieces)
    >>> states = model.step(model.universe(), None, 1)
    >>> len(states)
    504
    """

    def __init__(self, map_: PieceMap, first: FirstBumps | None = None) -> None:
        self.map, self.first = map_, first
        self._longest_first = int((map_.longest if first is None else first.most).max(initial=0))

    def __repr__(self) -> str:
        return f"<PieceModel on {self.map!r}>"

    def universe(self) -> PieceSet:
        """Return a robot that has not bumped yet."""
        return PieceSet(np.array([NOT_BUMPED], dtype=np.int32), np.zeros(1, dtype=np.int32))

    def predict(self, states: PieceSet, motion: None) -> PieceSet:
        """Return where the robot can be after a step of which nothing was observed."""
        return self.unite(self.step(states, None, 0), self.step(states, None, 1))

    def step(self, states: PieceSet, motion: None, reading: int) -> PieceSet:
        """Return where the robot can be after a step with a bump (1) or without one (0)."""
        return self._bumped(states) if reading else self._stepped(states)

    def leg(self, states: PieceSet, steps: int) -> PieceSet:
        """Return where the robot can be after a bump that was observed after so many more steps."""
        return self._bumped(PieceSet(states.pieces, states.steps + np.int32(steps)))

    def unite(self, allowed: PieceSet, predicted: PieceSet) -> PieceSet:
        """Return the pieces of either set."""
        pairs = np.concatenate([np.stack([each.pieces, each.steps], axis=1) for each in (allowed, predicted)])
        pieces, steps = np.unique(pairs, axis=0).T
        return PieceSet(pieces.copy(), steps.copy())

    def empty(self, states: PieceSet) -> bool:
        """Return whether nothing is left: the robot is in no place of the environment."""
        return len(states) == 0

    def _stepped(self, states: PieceSet) -> PieceSet:
        steps = states.steps + np.int32(1)
        longest = np.where(states.pieces == NOT_BUMPED, self._longest_first, self.map.longest[states.pieces])
        return PieceSet(states.pieces[steps <= longest], steps[steps <= longest])

    def _bumped(self, states: PieceSet) -> PieceSet:
        """Return the pieces that the robot leaves from after a bump now."""
        map_ = self.map
        marked = np.zeros(len(map_), dtype=np.bool_)
        for steps in states.steps[states.pieces == NOT_BUMPED].tolist():
            if self.first is None:
                marked |= (map_.longest >= 0) & (steps <= self._longest_first)
            else:
                marked[self.first.pieces[(self.first.least <= steps) & (steps <= self.first.most)]] = True
        known = states.pieces != NOT_BUMPED
        arcs = map_.starts, map_.ends, map_.least, map_.most
        _mark(*arcs, states.pieces[known], states.steps[known], int(map_.parts.sum()), map_.headings, *map_.turns, marked)
        return self._leaving(np.flatnonzero(marked).astype(np.int32))

    @staticmethod
    def _leaving(pieces: IntArray) -> PieceSet:
        return PieceSet(pieces, np.zeros(len(pieces), dtype=np.int32))
