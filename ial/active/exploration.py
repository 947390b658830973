"""`explore`: drive a robot as a planner says, until it knows where it is or nothing is left to see."""

import time
from collections.abc import Iterator
from dataclasses import dataclass

from ial.active.belief import Belief
from ial.active.decision import Decision, Planner
from ial.active.robot import Robot
from ial.datasets.motion import Motion
from ial.datasets.scan import LaserScan
from ial.errors import ConfigError
from ial.lidar.estimate import Estimate
from ial.pose import Pose

ENDS = ("localized", "symmetric")


@dataclass(frozen=True, eq=False)
class ExplorationStep:
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
    estimate: Estimate
    moved: Pose
    collided: bool
    decided_s: float


def explore(
    belief: Belief, robot: Robot[Motion, LaserScan], planner: Planner[Belief], most_drives: int = 1000
) -> Iterator[ExplorationStep]:
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
        What chooses.
    most_drives
        At most so many drives.

    Raises
    ------
    ConfigError
        If the number of drives is negative, or the first scan has no beam that tells anything.
    """
    if most_drives < 0:
        raise ConfigError(f"at most {most_drives} drives are allowed; give a number that is not negative")
    estimate = belief.update(None, robot.look())
    if estimate.uninformative:
        raise ConfigError("the first scan has no usable beam, so that nothing can be learned by driving; check the lidar and its limits")
    yield ExplorationStep(None, estimate, belief.moved, False, 0.0)
    for _ in range(most_drives):
        if estimate.status in ENDS:
            return
        begun = time.perf_counter()
        decision = planner.choose(belief)
        took = time.perf_counter() - begun
        if decision.drive is None:
            yield ExplorationStep(decision, estimate, belief.moved, False, took)
            return
        driven = robot.drive(decision.drive)
        estimate = belief.update(driven.motion, driven.reading)
        yield ExplorationStep(decision, estimate, belief.moved, driven.collided, took)
