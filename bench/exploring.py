"""Active localization: whether the truth is ever lost or anything touched, whether it ends, and its cost against one-step entropy."""

import itertools
import math
import os
from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from statistics import median

import numpy as np
from report import Report, options
from timing import timed

from ial.active.belief import Belief
from ial.active.planners.entropy import EntropyPlanner, Histogram
from ial.active.planners.outlook import MOST_GROUPS
from ial.active.planners.two_stage import TwoStagePlanner
from ial.active.simulated_robot import Errors, SimulatedRobot
from ial.active.trial import Trial
from ial.datasets.motion import ErrorBound, MotionBounds
from ial.datasets.simulator import Lidar, SensorErrors
from ial.datasets.walk import random_walk
from ial.lidar.configuration.config import LocalizerConfig
from ial.lidar.localizer import Localizer
from ial.maps.grids.alike_plans import alike_plan, plan_names
from ial.maps.grids.map_file import read_map
from ial.maps.grids.occupancy_grid import OccupancyGrid

ABOUT = """\
A simulated robot, a disk with a radius of 0.2 m that keeps 0.35 m where it looks, with 91 beams all around, ± 2 cm, 4 m far (2.5 m in real
maps, where 4 m mostly leave one place at the first look); at most 2 of them are bad, and 4 may be. Its odometry errs by at most 2 % and
1 cm of a way, and 3 % and 0.3° of a turn. Every other start has errors as large as their bounds. *Lost*: scans after which the set did not
hold the truth. *Decision of stage 1*: of which direction readings differ most, from the set of poses on, with the tests of the way; of
*entropy*: of eight neighbours, and with what it takes to keep the histogram (Goyal, Krishna, Bhuvanagiri, table II). *Back*: how often it
has come into a cell of 0.5 m in which it had been before."""
RADIUS_M, CLEARANCE_M, LONGEST_S = 0.2, 0.35, 6.0
MOTION = MotionBounds(ErrorBound(0.0, 0.02, 0.01, 0.002, 0.01), ErrorBound(0.0, 0.01, 0.03, 0.0, 0.005))
LIDAR = Lidar(beams=91, angle_min=-math.pi, angle_increment=2.0 * math.pi / 91.0, range_max=4.0)
SHORT = replace(LIDAR, range_max=2.5)
REAL = ("intel_lab", "aces_austin")


def grids(names: list[str]) -> Iterator[tuple[str, OccupancyGrid]]:
    """Yield maps by their names."""
    for name in names:
        yield name, read_map(Path(os.environ["IAL_DATA"]) / name / "map.yaml") if name in REAL else alike_plan(name)


def localizer(grid: OccupancyGrid) -> Localizer:
    """Return what localizes the robot."""
    plain = LocalizerConfig()
    return Localizer(grid, config=replace(plain, outliers=4, robot_radius_m=CLEARANCE_M, bounds=replace(plain.bounds, motion=MOTION)))


def lidar_of(name: str) -> Lidar:
    """Return the sensor of a robot in a map."""
    return SHORT if name in REAL else LIDAR


def scene(knows: Localizer, lidar: Lidar, seed: int) -> tuple[Belief, SimulatedRobot]:
    """Return a start from which something is seen."""
    knows.reset()
    errors = Errors(SensorErrors(0.02, 0.002, 2, adversarial=seed % 2 == 1), MOTION)
    for drawn in itertools.count(seed, 10_000):
        start = random_walk(knows.grid, 1, drawn, clearance_m=CLEARANCE_M + 0.1)[0]
        if np.isfinite(SimulatedRobot(knows.grid, start, lidar, errors, RADIUS_M, seed).look().ranges).sum() > 10:
            break
    return Belief(knows, RADIUS_M, LONGEST_S), SimulatedRobot(knows.grid, start, lidar, errors, RADIUS_M, seed)


def ends(report: Report, names: list[str], starts: int, most: int) -> dict[str, list[Trial]]:
    """Drive from many starts with the two stages."""
    report.say("## The two stages\n")
    found: dict[str, list[Trial]] = {}

    def rows() -> Iterator[tuple[object, ...]]:
        for name, grid in grids(names):
            knows = localizer(grid)
            found[name] = []
            for seed in range(starts):
                belief, robot = scene(knows, lidar_of(name), seed)
                found[name].append(Trial.of(belief, robot, TwoStagePlanner(belief), most))
            own = found[name]
            count = Counter(each.ended_by for each in own)
            drives = [each.drives for each in own]
            times = [each.decided_s for each in own if each.decided_s is not None]
            shown = f"{1e3 * median(times):.0f} ms" if times else "-"
            ended = [count[each] for each in ("localized", "symmetric", "exhausted", "drives")]
            lost, touched = sum(each.lost for each in own), sum(each.collisions for each in own)
            yield name, len(own), *ended, f"{median(drives):g} ({max(drives)})", shown, lost, touched

    head = ["map", "starts", "localized", "symmetric", "exhausted", "gave up", "drives (most)", "a decision", "lost", "collisions"]
    report.table(head, rows())
    return found


def against_entropy(report: Report, names: list[str], starts: int, most: int, found: dict[str, list[Trial]]) -> None:
    """Drive from the same starts with one-step entropy."""
    report.say(f"## Against one-step entropy, at most {most} drives of 0.5 m\n")
    better: Counter[str] = Counter()

    def rows() -> Iterator[tuple[object, ...]]:
        for name, grid in grids(names):
            knows = localizer(grid)
            pairs = []
            for seed in range(starts):
                belief, robot = scene(knows, lidar_of(name), seed)
                pairs.append((found[name][seed], Trial.of(belief, robot, EntropyPlanner(belief, seed=seed), most)))
            pairs = [(own, other) for own, other in pairs if own.drives or other.drives]
            for own, other in pairs:
                better["starts"] += 1
                better["way"] += _knows(own) and (own.way_m < other.way_m or not _knows(other))
                better["back"] += _knows(own) and (own.revisited <= other.revisited or not _knows(other))
            known = [sum(map(_knows, each)) for each in zip(*pairs, strict=True)] or [0, 0]
            ways = [median(each.way_m for each in column) for column in zip(*pairs, strict=True)] or [0.0, 0.0]
            backs = [median(each.revisited for each in column) for column in zip(*pairs, strict=True)] or [0, 0]
            yield name, len(pairs), *known, *(f"{each:.1f} m" for each in ways), *(f"{each:g}" for each in backs)

    head = ["map", "starts", "known", "known, entropy", "way", "way, entropy", "back", "back, entropy"]
    report.table(head, rows())
    count = better["starts"]
    report.say(
        f"Of {count} starts from which something was to be driven, the way of the two stages is shorter in {better['way'] / count:.0%} "
        f"(goal: 80 %), and they come back into no more cells in {better['back'] / count:.0%} (goal: 80 %). Where only one of both knows "
        "its place in the end, that one counts as better.\n"
    )


def _knows(trial: Trial) -> bool:
    return trial.ended_by in ("localized", "symmetric")


def decisions(report: Report, names: list[str], starts: int) -> None:
    """Time decisions at the same poses."""
    report.say("## Time of a decision, at the first look\n")

    def rows() -> Iterator[tuple[object, ...]]:
        for name, grid in grids(names):
            knows = localizer(grid)
            times = []
            for seed in range(starts):
                belief, robot = scene(knows, lidar_of(name), seed)
                belief.update(None, robot.look())
                if belief.status not in ("localized", "symmetric"):
                    times.append(_times(belief))
            if times:
                own, alone, whole = (1e3 * median(column) for column in zip(*times, strict=True))
                yield name, len(times), f"{own:.2f} ms", f"{alone:.1f} ms", f"{whole:.1f} ms", f"{alone / own:.1f}", f"{whole / own:.1f}"

    head = ["map", "poses", "stage 1", "entropy", "with the histogram", "ratio (goal: 5)", "ratio with the histogram"]
    report.table(head, rows())


def _times(belief: Belief) -> tuple[float, float, float]:
    """Return how long a decision of stage 1 takes, one by entropy, and one with the histogram kept up to date (s)."""
    stages, entropy = TwoStagePlanner(belief), EntropyPlanner(belief)
    stage_s, _ = timed(lambda: stages.by_direction(belief, belief.groups(most=MOST_GROUPS)))
    histogram = Histogram(belief)
    histogram.follow(belief)
    markov = histogram.follow(belief)
    entropy_s, _ = timed(lambda: entropy.by_entropy(belief, markov))
    whole_s, _ = timed(lambda: entropy.by_entropy(belief, histogram.follow(belief)))
    return stage_s, entropy_s, whole_s


def main() -> None:
    """Run it."""
    parser = options(__doc__ or "")
    parser.add_argument("--starts", type=int, default=26, metavar="N", help="from so many starts in each map")
    parser.add_argument("--drives", type=int, default=300, metavar="N", help="at most so many drives of the two stages")
    parser.add_argument("--compared", type=int, default=14, metavar="N", help="so many of the starts are compared with entropy; 0 for none")
    parser.add_argument("--entropy-drives", type=int, default=60, metavar="N", help="at most so many drives by entropy")
    parser.add_argument("--maps", nargs="*", default=[*plan_names(), *REAL], metavar="NAME", help="in these maps")
    given = parser.parse_args()
    report = Report("Active localization", ABOUT)
    found = ends(report, given.maps, given.starts, given.drives)
    if given.compared:
        decisions(report, given.maps, given.compared)
        against_entropy(report, given.maps, given.compared, given.entropy_drives, found)
    report.write(given.out)


if __name__ == "__main__":
    main()
