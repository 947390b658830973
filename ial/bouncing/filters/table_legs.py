"""`TableLegs`: a filter of cells that takes whole legs, by how long the robot drove: as many steps without a bump, then one with it."""

from fractions import Fraction

from ial.bouncing.bump_timing import BumpTiming
from ial.bouncing.filters.bounce_filter import BounceFilter
from ial.bouncing.filters.robust_filter import RobustFilter
from ial.errors import ConfigError, StreamError


class TableLegs:
    """What `BumpTracker` asks of a filter, for one of cells.

    The steps of a robust filter are counted as a clock counts them. Those of an exact filter are the nearest whole number: its robot drives
    from centre to centre, so that a way is no part of a step longer.

    Parameters
    ----------
    made
        The filter.
    timing
        How fast the robot drives, and how well its clock tells.

    Raises
    ------
    ConfigError
        If the bounds of a robust filter do not cover those of clock and speed, or the steps of an exact one differ in their lengths.
    """

    def __init__(self, made: BounceFilter | RobustFilter, timing: BumpTiming) -> None:
        setting = made.setting
        self.made, self.timing, self.step_m = made, timing, setting.headings.step * setting.cell
        self._exact = isinstance(made, BounceFilter)
        if isinstance(made, RobustFilter):
            timing.check(self.step_m, made.bounds)
        else:
            offsets = {made.step_of(each) for each in made.places.heading_class.tolist()}
            if any(x * x + y * y != setting.headings.step**2 for x, y in offsets):
                raise ConfigError(
                    "the steps of this exact filter are not equally long in all headings, so times do not tell their number; build it "
                    "with --headings 4 and a step of whole cells, or a filter with --rays"
                )

    def __repr__(self) -> str:
        return f"<TableLegs of {self.made!r}>"

    def universe(self) -> int:
        """Return the state of a robot where it may start."""
        return 0

    def anew(self) -> int:
        """Return the state of a robot anywhere, in any heading: no state stands for all robots that have just bumped.

        Raises
        ------
        ConfigError
            If the start of the filter is not anywhere.
        """
        self.made.setting.check_restart()
        return 0

    def untimed(self, where: str) -> int:
        """Refuse a bump of which only the end is known: no one state stands for what any number of steps can leave.

        Raises
        ------
        StreamError
            Always.
        """
        raise StreamError(
            f"{where}: a bump with no start before it, and a filter of cells needs to know how long every leg took; begin the log with the "
            "start, or build a filter with --rays, which does without"
        )

    def leg(self, states: int, drive_s: Fraction, where: str) -> int:
        """Return the state after a bump, when the robot drove so long by its clock.

        Raises
        ------
        StreamError
            If the filter is exact, and the time tells no certain number of cells.
        """
        table, state, seen = self.made.table, states, dict[int, int]()
        left = self.timing.whole_steps(drive_s, self.step_m, where) if self._exact else self.timing.steps(drive_s, self.step_m)
        while left:
            if state in seen:  # the same states again and again: a pause may be as long as it likes
                left %= seen[state] - left
                seen.clear()
                continue
            seen[state] = left
            state, left = table.step(state, 0), left - 1
        return table.step(state, 1)

    def empty(self, states: int) -> bool:
        """Return whether no place is left."""
        return states == self.made.table.trap

    def is_localized(self, states: int) -> bool:
        """Return whether the robot counts as localized."""
        return self.made.table.is_localized(states)
