"""`Robot`: what a planner needs of a robot: it looks, and it drives. A robot of your own has these two methods."""

from dataclasses import dataclass
from typing import Generic, Protocol, TypeVar

MotionT = TypeVar("MotionT")
ReadingT = TypeVar("ReadingT")


@dataclass(frozen=True)
class Drive:
    """A command: turn on the spot, then drive straight on.

    Parameters
    ----------
    turn_rad
        By how much to turn, counter-clockwise.
    distance_m
        How far to drive then; infinite for a robot that drives until a wall stops it.
    """

    turn_rad: float
    distance_m: float


@dataclass(frozen=True)
class Driven(Generic[MotionT, ReadingT]):
    """What came of a command.

    Parameters
    ----------
    motion
        What the odometry says, with its bounds.
    reading
        What the robot sees where it stopped.
    collided
        Whether it touched something and stopped early. The motion is right all the same, but one of the assumptions of `Belief` was not.
        A robot that drives until a wall stops it does not collide with that wall.
    """

    motion: MotionT
    reading: ReadingT
    collided: bool = False


class Robot(Protocol[MotionT, ReadingT]):
    """Looks and drives. A lidar robot reads a scan; one with odometers alone reads how far it came."""

    def look(self) -> ReadingT:
        """Return what the robot sees where it is; one that sees nothing without driving drives to the wall ahead for it."""
        ...

    def drive(self, command: Drive) -> Driven[MotionT, ReadingT]:
        """Obey a command, and look."""
        ...
