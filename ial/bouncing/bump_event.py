"""`BumpEvent`: one moment of a log: a robot begins to drive, or bumps."""

from dataclasses import dataclass, field
from fractions import Fraction
from typing import Literal

EventKind = Literal["start", "bump"]


@dataclass(frozen=True)
class BumpEvent:
    """What a robot has reported.

    Parameters
    ----------
    time_s
        When, in seconds of the robot's clock.
    kind
        ``start``: it begins to drive; ``bump``: it touches a wall, and begins to turn.
    robot
        Its name; empty in a log of one robot.
    place
        Where it starts, if that is known: x and y in metres and the heading in degrees, counter-clockwise from the x axis.
    where
        The file and the line, for messages.
    """

    time_s: Fraction
    kind: EventKind
    robot: str = ""
    place: tuple[Fraction, Fraction, Fraction] | None = None
    where: str = field(default="the log", compare=False)
