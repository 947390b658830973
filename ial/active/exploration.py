"""`explore`: drive a robot as a planner says, until it knows where it is or nothing is left to see."""

import itertools
import time
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

from ial.active.decision import Decision, Planner
from ial.active.knowledge import Judged, Knowledge
from ial.active.robot import Robot
from ial.errors import ConfigError
from ial.pose import Pose

ENDS = ("localized", "symmetric")

MotionT = TypeVar("MotionT")
ReadingT = TypeVar("ReadingT")
EstimateT = TypeVar("EstimateT", bound=Judged)


@dataclass(frozen=True, eq=False)
class ExplorationStep(Generic[EstimateT]):
    """One decision and what came of it.

    Parameters
    ----------
    decision
        What was chosen; None at the first look.
    estimate
        What is known after it.
    moved
        Where the robot is, by the middle of its odometry, in the frame of its start.
    collided
        Whether it touched something.
    decided_s
        How long the choice took.
    """

    decision: Decision | None
    estimate: EstimateT
    moved: Pose
    collided: bool
    decided_s: float


def explore(
    belief: Knowledge[MotionT, ReadingT, EstimateT],
    robot: Robot[MotionT, ReadingT],
    planner: Planner[Any],  # of this belief, which is of a narrower type than can be said here
    most_drives: int | None = 1000,
) -> Iterator[ExplorationStep[EstimateT]]:
    """Yield the first look, and each drive with what is known after it.

    It ends when the robot is localized, or as well as the symmetry of the map lets it be, or when the planner has nothing left: then the
    last decision has no drive.

    Parameters
    ----------
    belief
        What is known, nothing yet.
    robot
        What drives and looks.
    planner
        What chooses; one that is made for such a belief.
    most_drives
        At most so many drives; None for any number of them.

    Raises
    ------
    ConfigError
        If the number of drives is negative; and what the belief refuses.
    """
    if most_drives is not None and most_drives < 0:
        raise ConfigError(f"at most {most_drives} drives are allowed; give a number that is not negative")
    estimate = belief.update(None, robot.look())
    yield ExplorationStep(None, estimate, belief.moved, False, 0.0)
    for _ in itertools.count() if most_drives is None else range(most_drives):
        if estimate.status in ENDS:
            return
        begun = time.perf_counter()
        decision = planner.choose(belief)
        took = time.perf_counter() - begun
        if decision.drive is None:
            yield ExplorationStep(decision, estimate, belief.moved, False, took)
            return
        driven = robot.drive(decision.drive)
        estimate = belief.update(driven.motion, driven.reading, collided=driven.collided)
        yield ExplorationStep(decision, estimate, belief.moved, driven.collided, took)
