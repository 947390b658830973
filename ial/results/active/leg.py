"""`Leg`: one decision of an exploration and what came of it, as files show it."""

import math
from dataclasses import dataclass

from ial.active.belief import Groups
from ial.active.exploration import ExplorationStep
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
