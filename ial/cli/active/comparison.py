"""`Comparison`: `ial explore --compare`, all planners from the same starts."""

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from typing import Any, get_args

from ial.active.belief import Belief
from ial.active.exploration import ENDS
from ial.active.robot import Drive
from ial.active.simulated_robot import SimulatedRobot
from ial.active.trial import Trial
from ial.cli.active.options import PlannerName
from ial.cli.active.planning import HOPS, Planning
from ial.cli.active.simulated import Simulated
from ial.cli.active.surroundings import Surroundings
from ial.errors import ConfigError
from ial.lidar.configuration.config import LocalizerConfig
from ial.lidar.configuration.config_record import config_yaml
from ial.lidar.localizer import Localizer
from ial.results.lidar.result_folder import ResultFolder

FILES = ("summary.json", "config.yaml", "comparison.csv")
"""What a comparison writes, its record first."""

COLUMNS = ("start", "planner", "ended_by", "drives", "way_m", "revisited", "decided_ms", "lost", "collisions")
Row = dict[str, Any]


@dataclass(frozen=True)
class Comparison:
    """What is compared.

    Parameters
    ----------
    surroundings
        The map, and what the robot really drives in.
    simulated
        The robot.
    config
        The configuration of the localizer.
    starts
        From so many starts, drawn one after the other.
    seed
        The seed of the first start; the next one has the next.
    drives
        At most so many for each run.
    out
        The folder of the results.

    Raises
    ------
    ConfigError
        If a number cannot be meant.
    """

    surroundings: Surroundings
    simulated: Simulated
    config: LocalizerConfig
    starts: int
    seed: int
    drives: int
    out: Path

    def __post_init__(self) -> None:
        if self.starts < 1:
            raise ConfigError(f"--starts is {self.starts}; give 1 or more")
        if self.drives < 0:
            raise ConfigError(f"--drives is {self.drives}; give 0 or a positive number")

    @property
    def runs(self) -> int:
        """How many runs there are."""
        return self.starts * len(get_args(PlannerName))

    def run(self, each: Callable[[Iterator[Row], int], Iterable[Row]]) -> dict[str, Any]:
        """Drive all runs and write the results; return the record as written.

        Parameters
        ----------
        each
            Is handed the rows and their number, and passes them on: a bar.
        """
        with ResultFolder(self.out) as folder:
            rows = list(each(self._rows(), self.starts * len(get_args(PlannerName))))
            folder.close()
            folder.write("comparison.csv", "\n".join([",".join(COLUMNS), *map(_line, rows)]) + "\n")
            folder.write("config.yaml", config_yaml(self.config))
            around = self.surroundings
            said = {"map": around.map_choice, "world": around.world_choice, "starts": self.starts, "seed": self.seed, "drives": self.drives}
            return folder.conclude("summary.json", {"options": said, "runs": rows})

    def _rows(self) -> Iterator[Row]:
        localizer = Localizer(self.surroundings.grid, config=self.config)
        longest_s = SimulatedRobot.seconds(Drive(math.pi, HOPS.hop_m))
        for seed in range(self.seed, self.seed + self.starts):
            for name in get_args(PlannerName):
                localizer.reset()
                belief = Belief(localizer, self.simulated.radius_m, longest_s)
                robot = self.simulated.robot(self.surroundings.world, belief, None, seed)
                yield _row(seed, name, Trial.of(belief, robot, Planning(name, seed=seed).planner(belief), self.drives))


def _row(seed: int, name: str, trial: Trial) -> Row:
    """Return a run by the names of `COLUMNS`."""
    decided = None if trial.decided_s is None else round(1e3 * trial.decided_s, 3)
    way = round(trial.way_m, 3)
    values = seed, name, trial.ended_by, trial.drives, way, trial.revisited, decided, trial.lost, trial.collisions
    return dict(zip(COLUMNS, values, strict=True))


def _line(row: Row) -> str:
    return ",".join("" if row[each] is None else str(row[each]) for each in COLUMNS)


def table(rows: Sequence[Row]) -> Iterator[str]:
    """Yield the lines of a table: one for each planner."""
    ends = f"{'localized':>10}{'symmetric':>10}{'exhausted':>10}{'gave up':>9}"
    yield f"{'planner':<10}{ends}{'drives':>8}{'way':>9}{'back':>6}{'decision':>11}"
    for name in get_args(PlannerName):
        own = [row for row in rows if row["planner"] == name]
        counts = [sum(row["ended_by"] == end for row in own) for end in (*ENDS, "exhausted", "drives")]
        drives, way, back = (median(row[key] for row in own) for key in ("drives", "way_m", "revisited"))
        times = [row["decided_ms"] for row in own if row["decided_ms"] is not None]
        decision = f"{median(times):.1f} ms" if times else "-"
        yield f"{name:<10}{counts[0]:>10}{counts[1]:>10}{counts[2]:>10}{counts[3]:>9}{drives:>8g}{way:>7.1f} m{back:>6g}{decision:>11}"
    lost, collisions = (sum(row[key] for row in rows) for key in ("lost", "collisions"))
    yield f"medians of {len(rows)} runs; the set did not hold the truth after {lost} scans; {collisions} collisions"
