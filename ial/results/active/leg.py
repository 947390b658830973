"""`Leg`: one decision of an exploration and what came of it, as files show it; `legs`: those of a simulated robot."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

from ial.active.belief import Belief, Groups
from ial.active.exploration import ExplorationStep
from ial.active.simulated_robot import SimulatedRobot
from ial.datasets.odometry import Odometry
from ial.datasets.recording import Step
from ial.lidar.estimate import Estimate
from ial.pose import Pose


@dataclass(frozen=True, eq=False)
class Leg:
    """One decision and what came of it.

    Parameters
    ----------
    number
        Of the decision, from 1; 0 is the first look.
    before
        How many hypotheses there were before it; None at the first look.
    step
        The scan after it, and the motion.
    taken
        The decision, and what came of it.
    groups
        Poses that are possible after it, in the grid's frame.
    truth
        Where the simulated robot is then, ``T_map_base``.
    """

    number: int
    before: int | None
    step: Step
    taken: ExplorationStep[Estimate]
    groups: Groups
    truth: Pose

    @property
    def estimate(self) -> Estimate:
        """What is known after it."""
        return self.taken.estimate

    @property
    def hypotheses(self) -> int:
        """How many hypotheses there are after it."""
        return len(self.estimate.hypotheses)

    @property
    def drives(self) -> bool:
        """Whether the robot has driven."""
        return self.taken.decision is not None and self.taken.decision.drive is not None

    @property
    def words(self) -> str:
        """The decision in words."""
        decision = self.taken.decision
        if decision is None:
            return "first look"
        if decision.drive is None:
            return f"{decision.stage}: {decision.reason}"
        turn = math.degrees(decision.drive.turn_rad)
        return f"{decision.stage}: {decision.reason}; turn {turn:.0f}°, drive {decision.drive.distance_m:.2f} m"


def legs(belief: Belief, robot: SimulatedRobot, taken: Iterator[ExplorationStep[Estimate]]) -> Iterator[Leg]:
    """Yield each decision of an exploration with what came of it.

    Parameters
    ----------
    belief
        What is known.
    robot
        What drives.
    taken
        The steps of `explore` of these two, none of which was taken yet.
    """
    step, before = None, None
    index = -1
    for number, each in enumerate(taken):
        if each.decision is None or each.decision.drive is not None:
            if belief.scan is None:
                raise AssertionError("a step of an exploration comes with a scan")
            index += 1
            step = Step(index, belief.scan.stamp_ns, belief.motion, belief.scan, Odometry.of(each.moved))
        if step is None:
            raise AssertionError("an exploration begins with a look")
        yield Leg(number, before, step, each, belief.groups(), robot.pose)
        before = len(each.estimate.hypotheses)
