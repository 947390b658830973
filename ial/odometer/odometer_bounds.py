"""`OdometerBounds`: by how much the two odometers of a robot may be wrong."""

import math
from dataclasses import dataclass
from fractions import Fraction

from ial.contractors.intervals.arithmetic import add, div, mul
from ial.contractors.intervals.trigonometric import PI_LOWER, PI_UPPER
from ial.errors import ConfigError
from ial.odometer.wall_table import enclosed

EXACT = 1e-9
"""The part by which a distance may be wrong that is called exact: room for its rounding to a double, and for much more."""
_LARGEST_PART, _LARGEST_TURN_DEG = 0.5, 45.0


@dataclass(frozen=True)
class OdometerBounds:
    """Bounds of the errors of a robot's odometers; by default they are exact, but for the rounding of readings.

    Parameters
    ----------
    distance_part
        By which part of the true distance a reading may be wrong: a reading of a distance d lies within d ± part · d. So a reading is
        0 if, and only if, the robot did not move. Infinite: it has no linear odometer.
    turn_deg
        By how many degrees a turn may be larger or smaller than commanded. Each turn has an error of its own.

    Raises
    ------
    ConfigError
        If a bound is negative, not finite, or too large to localize anything with.
    """

    distance_part: float = EXACT
    turn_deg: float = 0.0

    def __post_init__(self) -> None:
        if not 0.0 <= self.distance_part <= _LARGEST_PART and self.measures:
            raise ConfigError(
                f"the distance error {self.distance_part:g} is a part of the distance; give a number from 0 to {_LARGEST_PART:g}"
            )
        if not 0.0 <= self.turn_deg <= _LARGEST_TURN_DEG:
            raise ConfigError(f"the turn error {self.turn_deg:g}° is not from 0 to {_LARGEST_TURN_DEG:g}°; give a smaller one")
        object.__setattr__(self, "distance_part", max(float(self.distance_part), EXACT))

    @property
    def measures(self) -> bool:
        """Whether there is a linear odometer at all."""
        return self.distance_part != math.inf

    @property
    def exact(self) -> bool:
        """Whether two readings leave single configurations, as far as rounding allows."""
        return self.distance_part <= EXACT and self.turn_deg == 0.0

    def distance(self, reading: float) -> tuple[float, float]:
        """Return bounds of the distance that a reading stands for, in metres."""
        part = self.distance_part
        low = math.nextafter(1.0 + part, 2.0)
        high = math.nextafter(1.0 - part, 0.0)
        lower: float = div(reading, reading, low, low)[0]
        upper: float = div(reading, reading, high, high)[1]
        return lower, upper

    def turn(self, turn_deg: Fraction) -> tuple[float, float]:
        """Return bounds of the angle of a commanded turn, in radians."""
        low, high = enclosed(turn_deg)
        low, high = add(low, high, -self.turn_deg, self.turn_deg)
        low, high = mul(low, high, PI_LOWER, PI_UPPER)
        bounds: tuple[float, float] = div(low, high, 180.0, 180.0)
        return bounds
