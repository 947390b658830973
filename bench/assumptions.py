"""Simulated runs in which the assumptions hold, and in which they are broken on purpose: what the localizer then says."""

import dataclasses
import itertools
import math
import statistics
from collections import Counter
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace

import numpy as np
from report import Report, options

from ial.contractors.threads import set_threads
from ial.datasets.in_memory import InMemoryRecording
from ial.datasets.motion import ErrorBound, MotionBounds
from ial.datasets.odometry import Odometry
from ial.datasets.simulator import Lidar, SensorErrors, Simulation, simulate
from ial.datasets.walk import random_walk
from ial.lidar.configuration.config import LocalizerConfig
from ial.lidar.configuration.share import number_of
from ial.lidar.localizer import Localizer
from ial.lidar.run import localize
from ial.maps.grids.floor_plan import floor_plan
from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, OccupancyGrid
from ial.pose import Pose

ABOUT = """\
Random floor plans of 15 × 12 m at 5 cm, a lidar of 180 beams all around, range errors of up to 0.03 m, bearing errors of up to 0.005 rad,
steps of up to 0.3 m and 0.3 rad. Odometry errs by at most half the default bound of motion. The configuration is the default, with `auto`
or with a fixed share of outliers; a line is 20 runs of 100 scans.

Where all assumptions hold, the answer holds the truth and there is no alarm: an alarm is a scan reported as `lost` or `blind`. With `auto`
the assumption is that the truth has no more bad beams than the reported number. *Silently wrong*: localized at a place that does not hold
the truth. *Wrong but told*: the truth is not in the answer, which is ambiguous, lost or blind. Shares are of all scans."""
BEAMS = 180
STRETCH = 1.02
LIDAR = Lidar(beams=BEAMS, angle_min=-math.pi, angle_increment=2.0 * math.pi / BEAMS, range_max=25.0)
DEFAULT = LocalizerConfig()


def _halved(bound: ErrorBound, factor: float = 0.5) -> ErrorBound:
    return ErrorBound(*(factor * part for part in dataclasses.astuple(bound)))


MOTION = MotionBounds(_halved(DEFAULT.bounds.motion.translation), _halved(DEFAULT.bounds.motion.rotation))


@dataclass(frozen=True)
class Case:
    """One way to break an assumption, or none."""

    name: str
    outliers: float = 0.05
    drift: float = 0.0
    map_change: str = ""


CASES = [
    Case("nothing broken"),
    *(Case(f"{share:.0%} of the beams bad", outliers=share) for share in (0.15, 0.25, 0.4, 0.6)),
    Case("furniture of a quarter of the map moved", map_change="furniture"),
    Case("map stretched by 2 %", map_change="stretched"),
    Case("map of another building", map_change="other"),
    *(Case(f"odometry turns {factor:g} × its bound too far, each step", drift=factor) for factor in (1.5, 2.0, 4.0)),
]


def run_of(case: Case, seed: int, scans: int) -> tuple[OccupancyGrid, Simulation]:
    """Simulate one run; return the map that the localizer is given, and the run."""
    world = floor_plan(15.0, 12.0, 0.05, seed)
    path = random_walk(world, scans, seed, step_m=0.3, turn_rad=0.3)
    errors = SensorErrors(0.03, 0.005, number_of(case.outliers, BEAMS), adversarial=case.outliers > 0.05)
    run = simulate(world, path, LIDAR, errors, MOTION, seed)
    if case.drift:
        run = replace(run, recording=drifting(run.recording, case.drift))
    return changed(world, case.map_change, seed), run


def drifting(recording: InMemoryRecording, factor: float) -> InMemoryRecording:
    """Return a recording whose odometry turns a little further with every step than the bound allows."""
    readings = list(recording.readings())
    at = readings[0].odometry.pose
    moved = [readings[0]]
    for before, reading in itertools.pairwise(readings):
        step = before.odometry.pose.inverse() @ reading.odometry.pose
        room = DEFAULT.bounds.motion.enclose(step, 1e-9 * (reading.stamp_ns - before.stamp_ns))
        bound = 0.5 * float(room.upper[2] - room.lower[2])
        at = at @ Pose(step.x, step.y, step.theta + factor * bound)
        moved.append(replace(reading, odometry=Odometry.of(at)))
    return InMemoryRecording(recording.name, moved)


def changed(world: OccupancyGrid, how: str, seed: int) -> OccupancyGrid:
    """Return the map that the localizer is given."""
    if how == "other":
        return floor_plan(15.0, 12.0, 0.05, seed + 1000)
    cells = world.cells.copy()
    if how == "stretched":
        return OccupancyGrid(cells, world.resolution * STRETCH, world.origin)
    if how == "furniture":
        random = np.random.default_rng(seed)
        block = 30  # cells
        for row, column in itertools.product(range(block, world.rows - block, block), range(block, world.columns - block, block)):
            if random.random() < 0.25:
                cells[row : row + 8, column : column + 8] = random.choice([FREE, OCCUPIED])
    return replace(world, cells=cells)


def watch(case: Case, config: LocalizerConfig, seed: int, scans: int) -> tuple[Counter[str], list[int]]:
    """Localize one run; count what was said, and the scans from a wrong answer to the next alarm."""
    set_threads(1)
    grid, run = run_of(case, seed, scans)
    counts: Counter[str] = Counter()
    waits: list[int] = []
    wrong_since: int | None = None
    for step, estimate in localize(run.recording, Localizer(grid, config=config)):
        truth = run.truth.at(step.stamp_ns)
        if truth is not None and case.map_change == "stretched":
            truth = Pose(STRETCH * truth.x, STRETCH * truth.y, truth.theta)  # every place has moved with the walls around it
        right = truth is not None and estimate.poses.contains(grid.pose_to_grid(truth))
        alarm = estimate.status in ("lost", "blind")
        counts["scans"] += 1
        counts["contained"] += right
        counts["alarms"] += alarm
        counts["ambiguous"] += estimate.status in ("ambiguous", "symmetric")
        counts["right"] += estimate.status == "localized" and right
        counts["silent"] += estimate.status == "localized" and not right
        counts["told"] += estimate.status != "localized" and not right
        if alarm and wrong_since is not None:
            waits.append(step.index - wrong_since)
        wrong_since = None if right or alarm else (step.index if wrong_since is None else wrong_since)
    return counts, waits


def configurations() -> dict[str, LocalizerConfig]:
    """Return the configurations that are compared."""
    return {"auto": DEFAULT, "12 %": replace(DEFAULT, outliers=0.12)}


def line(case: Case, name: str, config: LocalizerConfig, runs: int, scans: int, spread: Callable[..., Iterator[object]]) -> Iterator[str]:
    """Yield the cells of one line."""
    total: Counter[str] = Counter()
    waits: list[int] = []
    for counts, waited in spread(watch, [case] * runs, [config] * runs, range(runs), [scans] * runs):  # type: ignore[misc]
        total += counts
        waits += waited
    yield case.name
    yield name
    yield str(total["scans"])
    for key in ("contained", "right", "ambiguous", "alarms", "told", "silent"):
        yield f"{total[key] / total['scans']:.4f}"
    yield f"{statistics.median(waits):g}" if waits else "–"


def main() -> None:
    """Measure, print, and write."""
    parser = options(__doc__ or "")
    parser.add_argument("--runs", type=int, default=20)
    parser.add_argument("--scans", type=int, default=100)
    chosen = parser.parse_args()
    report = Report("Assumptions, kept and broken", ABOUT)
    head = [
        "case",
        "outliers",
        "scans",
        "truth contained",
        "localized, right",
        "ambiguous",
        "alarms",
        "wrong but told",
        "silently wrong",
        "scans from wrong to alarm",
    ]
    with ProcessPoolExecutor() as pool:
        kept = (line(CASES[0], name, config, 100, 100, pool.map) for name, config in configurations().items())
        report.table(head, kept)
        broken = (
            line(case, name, config, chosen.runs, chosen.scans, pool.map) for case in CASES[1:] for name, config in configurations().items()
        )
        report.table(head, broken)
    report.write(chosen.out)


if __name__ == "__main__":
    main()
