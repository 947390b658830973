"""`Command`: what a robot with odometers is told: turn, then drive straight on."""

import math
from dataclasses import dataclass
from fractions import Fraction

from ial.active.robot import Drive
from ial.errors import ConfigError

_PARTS = 2**32  # of a degree: turns in radians are rounded to these, so that those by halves, quarters and so on are exact again


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

    @classmethod
    def of(cls, drive: Drive) -> "Command":
        """Return a drive as a command: its turn to the nearest 2⁻³² of a degree, which is what the robot is told and what is reckoned with.

        Raises
        ------
        ConfigError
            If the turn is not finite or the distance not positive.
        """
        if not math.isfinite(drive.turn_rad):
            raise ConfigError(f"a turn by {drive.turn_rad} rad is none; give a finite angle")
        return cls(Fraction(round(math.degrees(drive.turn_rad) * _PARTS), _PARTS), drive.distance_m)

    @property
    def to_wall(self) -> bool:
        """Whether only a wall ends it."""
        return math.isinf(self.ahead_m)

    @property
    def drive(self) -> Drive:
        """The same as a drive, whose turn is a double in radians."""
        return Drive(math.radians(self.turn_deg), self.ahead_m)

    def __str__(self) -> str:
        way = "to a wall" if self.to_wall else f"{self.ahead_m:.6g} m"
        return f"turn {float(self.turn_deg):g}°, drive {way}"
