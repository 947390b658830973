"""`CommandedRobot`: a robot with odometers behind the protocol of robots that explore (`ial.active.Robot`)."""

from fractions import Fraction
from typing import Protocol

from ial.active.robot import Drive, Driven
from ial.odometer.command import Command


class Executes(Protocol):
    """A robot, real or simulated."""

    def execute(self, command: Command) -> float:
        """Turn, drive until a wall stops the robot or it has come far enough, and return how far the odometer says it came, in metres."""


class CommandedRobot:
    """A robot that obeys commands, as one that looks and drives: its motion is the command, its reading how far it came.

    Its translation is one reading of a virtual range sensor. A wall that stops it is no collision.

    Parameters
    ----------
    robot
        Is driven.
    """

    def __init__(self, robot: Executes) -> None:
        self._robot = robot

    def __repr__(self) -> str:
        return f"<CommandedRobot: {self._robot!r}>"

    def look(self) -> float:
        """Drive to the wall ahead, since it sees nothing without; return how far it came, in metres."""
        return self._robot.execute(Command(Fraction(0)))

    def drive(self, command: Drive) -> Driven[Command, float]:
        """Turn, drive until a wall stops it or it has come far enough, and return that with how far it came."""
        told = Command.of(command)
        return Driven(told, self._robot.execute(told))
