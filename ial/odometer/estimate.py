"""`OdometerEstimate`: what is known after a drive of a robot with odometers."""

from dataclasses import dataclass
from typing import Literal

from ial.odometer.command import Command
from ial.odometer.hypotheses import Hypothesis

Status = Literal["localized", "symmetric", "ambiguous", "rejected"]


@dataclass(frozen=True)
class OdometerEstimate:
    """One answer.

    Parameters
    ----------
    status
        `localized`: one hypothesis. `symmetric`: several that are images of each other under motions that lay the environments upon each
        other, so that no motion of the robot can tell them apart. `ambiguous`: neither, or they are not yet as narrow as they get.
        `rejected`: no configuration explains the readings, so an assumption is false.
    hypotheses
        Where the robot may be; None before two drives were measured, when they are curves for each pair of walls.
    command
        What the robot was told; None for the first drive, of which nothing is used but that a wall ended it.
    reading
        How far it drove by its odometer, in metres.
    """

    status: Status
    hypotheses: tuple[Hypothesis, ...] | None
    command: Command | None
    reading: float

    @property
    def moved(self) -> bool:
        """Whether the robot came as far as it was told, or moved at all if it was told no distance."""
        return self.reading > 0.0 and (self.command is None or self.command.to_wall or self.reading >= self.command.ahead_m)
