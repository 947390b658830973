"""`BumpTiming`: what turns the times between bumps into numbers of steps, which filters count."""

from dataclasses import dataclass
from fractions import Fraction
from math import ceil, floor

from ial.bouncing.bump_event import BumpEvent
from ial.bouncing.execution_bounds import ExecutionBounds
from ial.errors import ConfigError, StreamError


@dataclass(frozen=True)
class BumpTiming:
    """How fast a robot drives and how long it turns.

    Between two bumps it turns and then drives; from a start it drives at once. A robot that has driven for t seconds by its clock, the time
    of the turn taken off, has come v·(1 − e)·(t − tolerance) metres far at least, and v·(1 + e)·(t + tolerance) at most.

    Parameters
    ----------
    speed_m_s
        v.
    turn_s
        How long a turn takes.
    clock_s
        The tolerance: by how much the driving time may be wrong. It covers the error of both times and of that of the turn.
    speed_part
        e, as a part of the speed: 1/50 for 2 %.

    Raises
    ------
    ConfigError
        If the speed is not positive, or another number cannot be meant.
    """

    speed_m_s: Fraction
    turn_s: Fraction = Fraction(0)
    clock_s: Fraction = Fraction(0)
    speed_part: Fraction = Fraction(0)

    def __post_init__(self) -> None:
        if self.speed_m_s <= 0:
            raise ConfigError(f"the speed is {float(self.speed_m_s):g} m/s; give a speed greater than 0")
        if self.turn_s < 0:
            raise ConfigError(f"the time of a turn is {float(self.turn_s):g} s; give 0 or more")
        if self.clock_s < 0:
            raise ConfigError(f"the bound of the error of the clock is {float(self.clock_s):g} s; give 0 or more")
        if not 0 <= self.speed_part < 1:
            raise ConfigError(f"the bound of the error of the speed is {float(self.speed_part):g} of it; give 0 or more, and less than 1")

    def drive_s(self, before: BumpEvent, bump: BumpEvent) -> Fraction:
        """Return how long the robot drove between an event and the next bump, by its clock.

        Raises
        ------
        StreamError
            If that is less than 0 by more than the tolerance.
        """
        passed = bump.time_s - before.time_s
        driven = passed - (self.turn_s if before.kind == "bump" else 0)
        if driven < -self.clock_s:
            raise StreamError(
                f"{bump.where}: the bump comes {float(passed):g} s after the {before.kind} before it, too soon for a "
                f"turn of {float(self.turn_s):g} s; take out bumps that the switch reports twice, or correct "
                "--turn-time or --clock-error"
            )
        return driven

    def steps(self, drive_s: Fraction, step_m: Fraction) -> int:
        """Return how many steps a robot counts that drives so long: k = ⌊v·t/h⌋, and 0 for a time below 0.

        A filter takes k to mean that the way is in [(k − c)·h·(1 − e), (k + c + 1)·h·(1 + e)], and not below 0, c being its bound of the
        error of a count and e that of a step.
        """
        # Why that is true if c·h ≥ v·tolerance, and e is at least the speed's bound:
        #   k·h ≤ v·t < (k + 1)·h, so the way is at least (1 − e)·(v·t − v·tolerance) ≥ (1 − e)·(k·h − c·h),
        #   and at most (1 + e)·(v·t + v·tolerance) ≤ (1 + e)·((k + 1)·h + c·h).
        # For a time below 0 k is 0: the way is at least 0, and at most (1 + e)·v·tolerance ≤ (1 + e)·c·h, as v·t is below 0.
        return max(floor(self.speed_m_s * drive_s / step_m), 0)

    def count_error(self, step_m: Fraction) -> int:
        """Return the least bound of the error of a count that covers the tolerance of the clock: ⌈v·tolerance/h⌉."""
        return ceil(self.speed_m_s * self.clock_s / step_m)

    def check(self, step_m: Fraction, bounds: ExecutionBounds) -> None:
        """Refuse a filter whose bounds do not cover what a clock and a speed may do wrong.

        Raises
        ------
        ConfigError
            If the filter counts, or steps, with smaller errors.
        """
        count = self.count_error(step_m)
        if bounds.count < count:
            raise ConfigError(
                f"a clock with an error of {float(self.clock_s):g} s counts up to {count} step{'s' * (count != 1)} of {float(step_m):g} m "
                f"wrong at {float(self.speed_m_s):g} m/s, and the filter is for {bounds.count}; build one with --count-error {count}"
            )
        if bounds.step < self.speed_part:
            raise ConfigError(
                f"the error of the speed is up to {float(self.speed_part):g} of it, and the filter is for steps with an error of "
                f"{float(bounds.step):g}; build one with --step-error {self.speed_part}"
            )

    def whole_steps(self, drive_s: Fraction, step_m: Fraction, where: str) -> int:
        """Return the whole number of steps that is nearest to the way: for robots that drive from centre to centre of cells.

        Raises
        ------
        StreamError
            If the errors allow another whole number, or two are equally near.
        """
        way = self.speed_m_s * drive_s / step_m
        nearest = max(floor(way + Fraction(1, 2)), 0)
        tolerance = self.speed_m_s * self.clock_s / step_m
        least, most = (1 - self.speed_part) * (way - tolerance), (1 + self.speed_part) * (way + tolerance)
        if abs(way - nearest) == Fraction(1, 2) or max(ceil(least), 0) < nearest or floor(most) > nearest:
            raise StreamError(
                f"{where}: a way of {float(way):.3f} steps, give or take the errors of clock and speed, is no certain number of cells; "
                "build a filter for robots with errors (--rays, --count-error)"
            )
        return nearest
