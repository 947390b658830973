"""Runs of the planner of two stages, each beside the oracle."""

from dataclasses import dataclass

from ial.active.exploration import ENDS, explore
from ial.active.planners.two_stage import TwoStagePlanner
from ial.datasets.walk import random_walk
from ial.maps.grids.occupancy_grid import OccupancyGrid
from tests.active.scenes import CLEARANCE_M, LIDAR, RADIUS_M, SENSOR, belief, robot
from tests.active.views_oracle import Verdict, ViewsOracle

GAVE_UP = "gave up"


@dataclass(frozen=True)
class JudgedRun:
    """What the oracle says of a start, and how the run ends.

    Parameters
    ----------
    verdict
        Of the oracle, after the first look.
    end
        ``localized``, ``symmetric``, ``exhausted``, or ``gave up`` after too many drives.
    drives
        How many there were.
    """

    verdict: Verdict
    end: str
    drives: int

    @property
    def disagrees(self) -> bool:
        """Whether planner and oracle cannot both be right, or the planner has come to no end."""
        wrong = {"localizable": self.end == "exhausted", "not": self.end != "exhausted", "undecided": False}
        return self.end == GAVE_UP or wrong[self.verdict]


def judged_run(grid: OccupancyGrid, seed: int, most_drives: int = 150) -> JudgedRun:
    """Return what comes of a random start; the truth must be in the set after each drive, and nothing be touched."""
    start = random_walk(grid, 1, seed, clearance_m=0.5)[0]
    known, driving = belief(grid), robot(grid, start, seed, adversarial=seed % 2 == 1)
    oracle = ViewsOracle(grid, LIDAR, RADIUS_M, CLEARANCE_M, known.localizer.config.outliers, SENSOR.outliers)
    verdict: Verdict | None = None
    drives = -1
    for step in explore(known, driving, TwoStagePlanner(known), most_drives):
        drives += step.decision is None or step.decision.drive is not None
        assert step.estimate.poses.contains(grid.pose_to_grid(driving.pose)), f"seed {seed}: the truth is lost after {drives} drives"
        assert not step.collided, f"seed {seed}: drive {drives} ends at something"
        verdict = verdict or oracle.judge(grid.pose_to_grid(start), known.poses)
    if step.estimate.status in ENDS:
        end = step.estimate.status
    else:
        end = "exhausted" if step.decision is not None and step.decision.drive is None else GAVE_UP
    assert verdict is not None
    return JudgedRun(verdict, end, drives)
