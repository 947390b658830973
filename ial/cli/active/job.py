"""`ExplorationJob`: what `ial explore` was asked to do, and the doing of it."""

import math
from collections import Counter
from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

from ial.active.belief import Belief
from ial.active.exploration import ENDS, explore
from ial.active.robot import Drive
from ial.active.simulated_robot import SimulatedRobot
from ial.cli.active.planning import HOPS, Planning
from ial.cli.active.report import line_of
from ial.cli.active.simulated import Simulated
from ial.cli.active.surroundings import Surroundings
from ial.errors import ConfigError
from ial.lidar.configuration.config import LocalizerConfig
from ial.lidar.localizer import Localizer
from ial.results.active.animation import ExplorationAnimation
from ial.results.active.decisions import DecisionsFile
from ial.results.active.leg import Leg, legs
from ial.results.active.tree_picture import TreePicture
from ial.results.active.true_path import TruePath
from ial.results.lidar.result_folder import ResultFolder
from ial.results.lidar.run_results import FILES as RUN_FILES
from ial.results.lidar.run_results import RunResults
from ial.results.lidar.summary import Summary
from ial.study.containment import Containment

FILES = (*RUN_FILES, "decisions.jsonl", "tree.png", "truth.tum")
"""What an exploration writes, its record first."""


@dataclass
class _Driven:
    """Where the scans come from."""

    name: str
    skipped: Counter[str] = field(default_factory=Counter)
    repaired: Counter[str] = field(default_factory=Counter)


@dataclass(frozen=True)
class ExplorationJob:
    """One exploration, with its results in a folder.

    Parameters
    ----------
    surroundings
        The map, and what the robot drives in.
    simulated
        The robot.
    planning
        What chooses.
    config
        The configuration of the localizer.
    out
        The folder of the results.
    start
        Where the robot starts, x, y (m) and heading (rad) in the map frame; drawn if None.
    seed
        What is drawn from.
    drives
        At most so many.
    film
        Where to write a film; None for none.

    Raises
    ------
    ConfigError
        If the number of drives is negative.
    """

    surroundings: Surroundings
    simulated: Simulated
    planning: Planning
    config: LocalizerConfig
    out: Path
    start: tuple[float, float, float] | None
    seed: int
    drives: int
    film: Path | None

    def __post_init__(self) -> None:
        if self.drives < 0:
            raise ConfigError(f"--drives is {self.drives}; give 0 or a positive number")

    def run(self, say: Callable[[str], None]) -> tuple[Leg, dict[str, Any]]:
        """Drive and write all results.

        Parameters
        ----------
        say
            Is handed a line for each decision that begins something, and where something has changed.

        Returns
        -------
        tuple
            The last leg, and the record of the run as written.

        Raises
        ------
        IalError
            If an input cannot be used or the results cannot be written; nothing is then left under the name of a result.
        """
        with ResultFolder(self.out) as folder, ExitStack() as stack:
            grid = self.surroundings.grid
            longest_s = SimulatedRobot.seconds(Drive(math.pi, HOPS.hop_m))
            belief = Belief(Localizer(grid, config=self.config), self.simulated.radius_m, longest_s)
            robot = self.simulated.robot(self.surroundings.world, belief, self.start, self.seed)
            source = _Driven(f"{self.planning.name} in {self.surroundings.name}")
            with folder.writing():
                truth, decisions = TruePath(folder.place("truth.tum")), DecisionsFile(folder.place("decisions.jsonl"))
                tree = TreePicture(folder.place("tree.png"), source.name)
            folder.keep(truth, decisions, tree)
            containment = Containment(belief.localizer, truth)
            summary = Summary(source, grid, self.config, self._options())
            results = RunResults(folder, summary, source, grid, self.config, containment.reference)
            film = None
            if self.film is not None:
                film = stack.enter_context(ExplorationAnimation(self.film, grid, self.simulated.radius_m, source.name))
            taken = explore(belief, robot, self.planning.planner(belief), self.drives)
            times = []
            for leg in legs(belief, robot, taken):
                if leg.drives or not leg.number:
                    with folder.writing():
                        truth.add(leg.step.stamp_ns, leg.truth)
                    results.add(leg.step, leg.estimate)
                    containment.add(leg.step, leg.estimate)
                if leg.taken.collided:
                    results.events.write(leg.step, event="collision", decision=leg.number)
                with folder.writing():
                    decisions.add(leg)
                tree.add(leg)
                if film is not None:
                    film.add(leg)
                if leg.number:
                    times.append(leg.taken.decided_s)
                line = line_of(leg)
                if line is not None:
                    say(line)
            outcome = self._outcome(leg, robot, times)
            with folder.writing():
                results.events.write(leg.step, event="ended", by=outcome["ended_by"], drives=outcome["drives"])
            record = results.conclude({**containment.summary(), "misses": containment.misses}, exploration=outcome)
        return leg, record

    def _outcome(self, last: Leg, robot: SimulatedRobot, times: list[float]) -> dict[str, Any]:
        """Return how it ended, as plain values that JSON can hold."""
        exhausted = last.number > 0 and not last.drives
        status = last.estimate.status
        start = robot.path[0]
        return {
            "planner": self.planning.name,
            "ended_by": "exhausted" if exhausted else status if status in ENDS else "drives",
            "drives": len(robot.path) - 1,
            "way_m": sum(math.hypot(one.x - other.x, one.y - other.y) for one, other in pairwise(robot.path)),
            "collisions": robot.collisions,
            "hypotheses": last.hypotheses,
            "start": {"x": start.x, "y": start.y, "theta": start.theta},
            "decision_median_s": float(np.median(times)) if times else None,
            "decision_max_s": max(times, default=None),
        }

    def _options(self) -> dict[str, Any]:
        """Return what was asked for, under the names of the options, as plain values that JSON can hold."""
        around, robot, planning = self.surroundings, self.simulated, self.planning
        return {
            "map": around.map_choice,
            "world": around.world_choice,
            "map_semantics": around.semantics,
            "map_topic": around.map_topic,
            "start": None if self.start is None else list(self.start),
            "seed": self.seed,
            "drives": self.drives,
            "planner": planning.name,
            "alpha": planning.alpha,
            "beta": planning.beta,
            "raw": planning.raw,
            "guaranteed": planning.guaranteed,
            "radius": robot.radius_m,
            "range": robot.range_m,
            "beams": robot.beams,
            "fov": robot.fov_deg,
            "range_error_m": robot.range_error_m,
            "bearing_error_rad": robot.bearing_error_rad,
            "bad_beams": robot.bad_beams,
            "adversarial": robot.adversarial,
            "animate": None if self.film is None else str(self.film),
            "out": str(self.out),
        }
