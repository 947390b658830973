"""`BumpTracker`: one robot followed through its log, bump by bump."""

from fractions import Fraction
from typing import Any, Protocol, TypeVar

from ial.bouncing.bump_event import BumpEvent
from ial.bouncing.bump_timing import BumpTiming
from ial.bouncing.filters.bounce_filter import BounceFilter
from ial.bouncing.filters.piece_filter import PieceFilter
from ial.bouncing.filters.piece_legs import PieceLegs
from ial.bouncing.filters.robust_filter import RobustFilter
from ial.bouncing.filters.table_legs import TableLegs
from ial.errors import StreamError

States = TypeVar("States")


class Legs(Protocol[States]):
    """A filter that takes whole legs."""

    timing: BumpTiming

    def universe(self) -> States:
        """Return everything: the robot has not bumped yet."""
        ...

    def untimed(self, where: str) -> States:
        """Return what a bump leaves of everything, of which only the end is known."""
        ...

    def anew(self) -> States:
        """Return everything after a bump: the robot may have been carried before it."""
        ...

    def leg(self, states: States, drive_s: Fraction, where: str) -> States:
        """Return what a leg leaves that took so long."""
        ...

    def empty(self, states: States) -> bool:
        """Return whether nothing is left."""
        ...

    def is_localized(self, states: States) -> bool:
        """Return whether the robot counts as localized."""
        ...


def legs_of(made: BounceFilter | RobustFilter | PieceFilter, timing: BumpTiming) -> Legs[Any]:
    """Return a filter of any kind as one that takes legs.

    Raises
    ------
    ConfigError
        If its bounds do not cover those of clock and speed, or times do not tell its steps.
    """
    return PieceLegs(made, timing) if isinstance(made, PieceFilter) else TableLegs(made, timing)


class BumpTracker:
    """Follows one robot. Bumps count from 1.

    Parameters
    ----------
    legs
        The filter.
    restart
        Whether to begin anew after a rejection: the robot may have been carried.

    Attributes
    ----------
    states
        What is known after the last event.
    bumps
        How many there were.
    rejected_at
        The bumps that left nothing.
    localized_at, localized_s
        The bump after which it was first localized, and its time by the robot's clock; 0 and None if it was localized before all bumps,
        and None if it never was.
    last_s
        The time of the last event.
    """

    def __init__(self, legs: Legs[Any], restart: bool = False) -> None:
        self.legs, self.restart = legs, restart
        self.states: Any = legs.universe()
        self.bumps = 0
        self.rejected_at: list[int] = []
        self.localized_at = 0 if self.localized else None
        self.localized_s: Fraction | None = None
        self.last_s: Fraction | None = None
        self._before: BumpEvent | None = None

    def __repr__(self) -> str:
        return f"<BumpTracker after {self.bumps} bumps>"

    @property
    def localized(self) -> bool:
        """Whether the robot is localized now."""
        return self.legs.is_localized(self.states)

    def take(self, event: BumpEvent) -> bool:
        """Take in an event; return whether it leaves nothing of what was left before it.

        Raises
        ------
        StreamError
            If the robot starts a second time, or its times are no times between bumps.
        """
        before, self._before, self.last_s = self._before, event, event.time_s
        if event.kind == "start":
            if before is not None:
                raise StreamError(
                    f"{event.where}: the robot starts a second time; cut the log there, or give each run a robot of its own name"
                )
            return False
        self.bumps += 1
        alive = not self.legs.empty(self.states)
        if before is None:
            self.states = self.legs.untimed(event.where)
        else:
            drive_s = self.legs.timing.drive_s(before, event)
            if alive:
                self.states = self.legs.leg(self.states, drive_s, event.where)
        rejected = alive and self.legs.empty(self.states)
        if rejected:
            self.rejected_at.append(self.bumps)
            if self.restart:
                self.states = self.legs.anew()
        if self.localized_at is None and self.localized:
            self.localized_at, self.localized_s = self.bumps, event.time_s
        return rejected
