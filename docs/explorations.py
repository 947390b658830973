"""The pictures of the page on exploring: runs that show what figures 2, 3 and 4 of Goyal, Krishna and Bhuvanagiri show.

Each run is that of ``ial explore --map plan:PLAN --start START --planner PLANNER --drives DRIVES``. `make docs` draws them; alone:
``python docs/explorations.py FOLDER``.
"""

import math
import sys
from pathlib import Path
from typing import NamedTuple

from ial.active import Belief, Drive, SimulatedRobot, explore
from ial.cli.active.options import SPARE_M, PlannerName
from ial.cli.active.planning import HOPS, Planning
from ial.cli.active.simulated import Simulated
from ial.keys.reading import read
from ial.lidar import Localizer, LocalizerConfig
from ial.maps.grids.alike_plans import alike_plan
from ial.results.active.leg import Leg, legs
from ial.results.active.path_picture import PathPicture

RADIUS_M = 0.2

Start = tuple[float, float, float]


class Exploration(NamedTuple):
    """A run of a planner.

    Parameters
    ----------
    plan
        The map, one of `ial.maps.grids.alike_plans`.
    start
        Where the robot starts, x, y (m) and heading (rad).
    planner
        What chooses.
    drives
        At most so many.
    """

    plan: str
    start: Start
    planner: PlannerName = "direction"
    drives: int = 40

    def legs(self) -> list[Leg]:
        """Return what was decided and what came of it, the first look first."""
        simulated = Simulated(RADIUS_M, 4.0, 90, 360.0, 0.02, 0.002, 0, False)
        config = read(LocalizerConfig(), {"robot_radius_m": RADIUS_M + SPARE_M, **simulated.bounds(same_world=True)})
        grid = alike_plan(self.plan)
        belief = Belief(Localizer(grid, config=config), RADIUS_M, SimulatedRobot.seconds(Drive(math.pi, HOPS.hop_m)))
        robot = simulated.robot(grid, belief, self.start, 0)
        return list(legs(belief, robot, explore(belief, robot, Planning(self.planner).planner(belief), self.drives)))


DIRECTION, DETACHED, CURVED = ("office", (21.3, 10.8, -1.7)), ("detached", (11.5, 5.5, 0.2)), ("curved", (1.5, 5.0, 2.8))
"""Plans and starts, chosen among many because they show it: stage 1 is enough in two of them, and has no part in the third."""


def draw(folder: Path) -> None:
    """Draw all pictures into a folder."""
    for name, (plan, start) in (("direction", DIRECTION), ("detached", DETACHED)):
        _beside_entropy(folder / f"{name}.png", plan, start)
    _through_frontiers(folder / "frontiers.png", *CURVED)


def _beside_entropy(path: Path, plan: str, start: Start) -> None:
    """Draw a run of the two stages, and below it one that minimizes entropy."""
    with PathPicture(path, alike_plan(plan), RADIUS_M) as picture:
        two_stages, entropy = Exploration(plan, start).legs(), Exploration(plan, start, "entropy").legs()
        picture.add("The first look", two_stages[:1], two_stages[1])
        picture.add("Two stages, the end", two_stages, near=True)
        half = len(entropy) // 2
        picture.add("Least entropy, half way", entropy[: half + 1], entropy[half + 1], near=True)
        picture.add("Least entropy, the end", entropy, near=True)


def _through_frontiers(path: Path, plan: str, start: Start) -> None:
    """Draw the moments of a run at which a new goal is chosen, the first three of them, and the end."""
    with PathPicture(path, alike_plan(plan), RADIUS_M) as picture:
        run = Exploration(plan, start).legs()
        chosen = [leg.number for leg in run if leg.taken.decision is not None and not leg.taken.decision.goes_on]
        for number in chosen[:3]:
            decision = run[number].taken.decision
            assert decision is not None
            picture.add(f"Decision {number}: {decision.stage}", run[:number], run[number])
        picture.add("The end", run)


if __name__ == "__main__":
    draw(Path(sys.argv[1]))
