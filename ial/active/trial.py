"""`Trial`: how a planner did from one start, as far as a comparison counts it."""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from itertools import pairwise
from statistics import median

from ial.active.belief import Belief
from ial.active.decision import Planner
from ial.active.exploration import ENDS, explore
from ial.active.simulated_robot import SimulatedRobot
from ial.pose import Pose

CELL_M = 0.5
"""The width of the cells in which coming back is counted (m)."""


@dataclass(frozen=True)
class Trial:
    """What came of a run.

    Parameters
    ----------
    ended_by
        ``localized``, ``symmetric``, ``exhausted``, or ``drives`` if there were too many.
    drives
        How many.
    way_m
        How far the robot has come.
    revisited
        How often it has come into a cell in which it had been before.
    decided_s
        How long a decision took, the median; None without one.
    lost
        After how many scans the set did not hold the truth.
    collisions
        How often it has touched something.
    """

    ended_by: str
    drives: int
    way_m: float
    revisited: int
    decided_s: float | None
    lost: int
    collisions: int

    @classmethod
    def of(cls, belief: Belief, robot: SimulatedRobot, planner: Planner[Belief], most_drives: int) -> "Trial":
        """Return what comes of a run.

        Parameters
        ----------
        belief
            What is known, nothing yet.
        robot
            The robot where it starts.
        planner
            What chooses.
        most_drives
            At most so many drives.

        Raises
        ------
        ConfigError
            As `explore`.
        """
        times, lost, ended_by = [], 0, "drives"
        for step in explore(belief, robot, planner, most_drives):
            if step.decision is None or step.decision.drive is not None:
                lost += not step.estimate.poses.contains(belief.grid.pose_to_grid(robot.pose))
            if step.decision is not None:
                times.append(step.decided_s)
                ended_by = "exhausted" if step.decision.drive is None else "drives"
            ended_by = step.estimate.status if step.estimate.status in ENDS else ended_by
        path = robot.path
        way = sum(math.dist((one.x, one.y), (other.x, other.y)) for one, other in pairwise(path))
        return cls(ended_by, len(path) - 1, way, revisited(path, CELL_M), median(times) if times else None, lost, robot.collisions)


def revisited(path: Iterable[Pose], cell_m: float) -> int:
    """Return how often a path of straight lines comes into a cell in which it has been before.

    Parameters
    ----------
    path
        Its corners.
    cell_m
        The width of a cell.
    """
    cells: list[tuple[int, int]] = []
    for one, other in pairwise(path):
        parts = max(1, math.ceil(8.0 * math.hypot(other.x - one.x, other.y - one.y) / cell_m))
        for part in range(parts + 1):
            share = part / parts
            x, y = one.x + share * (other.x - one.x), one.y + share * (other.y - one.y)
            cell = math.floor(x / cell_m), math.floor(y / cell_m)
            if not cells or cells[-1] != cell:
                cells.append(cell)
    return len(cells) - len(set(cells))
