"""`PieceLegs`: a filter of pieces of walls that takes whole legs, by how long the robot drove."""

from fractions import Fraction

import numpy as np

from ial.bouncing.bump_timing import BumpTiming
from ial.bouncing.filters.piece_filter import PieceFilter
from ial.bouncing.rays.piece_model import PieceSet


class PieceLegs:
    """What `BumpTracker` asks of a filter, for one of pieces of walls.

    Parameters
    ----------
    made
        The filter.
    timing
        How fast the robot drives, and how well its clock tells.

    Raises
    ------
    ConfigError
        If the bounds of the filter do not cover those of clock and speed.
    """

    def __init__(self, made: PieceFilter, timing: BumpTiming) -> None:
        timing.check(made.step_m, made.bounds)
        self.made, self.timing, self._model = made, timing, made.model
        self._longest = int(made.map.longest.max(initial=0))

    def __repr__(self) -> str:
        return f"<PieceLegs of {self.made!r}>"

    def universe(self) -> PieceSet:
        """Return a robot where it may start."""
        return self._model.universe()

    def anew(self) -> PieceSet:
        """Return a robot that leaves from any wall, in any heading, as after a bump of which only the end is known."""
        anywhere = self.made.anywhere
        return anywhere.leg(anywhere.universe(), 0)

    def untimed(self, where: str) -> PieceSet:
        """Return what a bump leaves of the start, of which only the end is known."""
        first = self.made.first
        return self.anew() if first is None else PieceSet(first.pieces, np.zeros(len(first), dtype=np.int32))

    def leg(self, states: PieceSet, drive_s: Fraction, where: str) -> PieceSet:
        """Return where the robot can be after a bump, when it drove so long by its clock."""
        # No leg of any piece takes more steps than the longest, so one more leaves nothing, as any larger number does.
        return self._model.leg(states, min(self.timing.steps(drive_s, self.made.step_m), self._longest + 1))

    def empty(self, states: PieceSet) -> bool:
        """Return whether no place is left."""
        return self._model.empty(states)

    def is_localized(self, states: PieceSet) -> bool:
        """Return whether the robot counts as localized."""
        return self.made.is_localized(states)
