"""`Knowledge`: what `explore` needs of what a robot knows: it takes a motion and a reading, and says how well the robot is localized."""

from typing import Protocol, TypeVar

from ial.pose import Pose

MotionT = TypeVar("MotionT", contravariant=True)
ReadingT = TypeVar("ReadingT", contravariant=True)
EstimateT = TypeVar("EstimateT", covariant=True)


class Judged(Protocol):
    """An answer with a word for how well the robot is localized."""

    @property
    def status(self) -> str:
        """The word; ``localized`` and ``symmetric`` end an exploration."""
        ...


class Knowledge(Protocol[MotionT, ReadingT, EstimateT]):
    """What a robot knows: `ial.active.Belief` of one with a lidar, `ial.odometer.OdometerBelief` of one with odometers alone."""

    @property
    def moved(self) -> Pose:
        """Where the robot is, by the middle of its odometry, in the frame of its start."""
        ...

    def update(self, motion: MotionT | None, reading: ReadingT, /, *, collided: bool = False) -> EstimateT:
        """Take a motion, None before the first reading, and a reading, and whether the robot touched something on its way."""
        ...
