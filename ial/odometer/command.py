"""`Command`: what a robot with odometers is told: turn, then drive straight on."""

import math
from dataclasses import dataclass
from fractions import Fraction

from ial.errors import ConfigError


@dataclass(frozen=True)
class Command:
    """A turn, and a drive until a wall stops the robot or it has come far enough; its reading is the distance of the drive.

    Parameters
    ----------
    turn_deg
        By how much to turn, counter-clockwise, in degrees; exactly, if the robot's angular odometer is exact. A float means
        exactly that double.
    ahead_m
        How far to drive at most by the robot's odometer, in metres; to the next wall by default. A reading of that is one of a robot that
        no wall has stopped.

    Raises
    ------
    ConfigError
        If the turn is not finite or the distance not positive.
    """

    turn_deg: Fraction
    ahead_m: float = math.inf

    def __post_init__(self) -> None:
        if not math.isfinite(self.turn_deg):
            raise ConfigError(f"a turn by {self.turn_deg}° is none; give a finite number of degrees")
        if not self.ahead_m > 0.0:
            raise ConfigError(f"{self.ahead_m:g} m are no way ahead; give more than 0")
        object.__setattr__(self, "turn_deg", Fraction(self.turn_deg))

    def __str__(self) -> str:
        way = "to a wall" if math.isinf(self.ahead_m) else f"{self.ahead_m:.6g} m"
        return f"turn {float(self.turn_deg):g}°, drive {way}"
