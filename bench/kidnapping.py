"""Kidnapped recordings: how soon it is noticed, where the robot is found again, and what it costs."""

import os
import statistics
import time
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from report import Report, options

from ial.datasets.in_memory import InMemoryRecording
from ial.datasets.kidnapping import Kidnapping, kidnap
from ial.datasets.opening import open_recording
from ial.datasets.trajectory import Trajectory, read_tum
from ial.lidar.config import LocalizerConfig
from ial.lidar.localizer import Localizer
from ial.lidar.run import localize
from ial.maps.map_file import read_map
from ial.maps.occupancy_grid import OccupancyGrid
from ial.study.containment import Containment

ABOUT = """\
Each kidnapping joins two places of a recording, at least 2 m apart, drawn at random; odometry and clock go on. The localizer begins 12
processed scans before with nothing known, and is watched for 20 scans behind. Odd scans, maps of the even ones, the default configuration.

*Delay*: processed scans behind the jump until one is reported as `lost` or `blind`; 0 is the first one. *Recovered*: localized within those
20 scans at a place that holds the reference. *Silent*: scans localized at a place that does not hold it. *False alarms*: `lost` and `blind`
scans in the whole recording without kidnapping, for each hour of it. `fixed 12 %` has ±0.05 m, ±0.05 m, no free space and 12 % outliers;
`restart` trusts the scan that rejected the prediction (Guyonneau et al. 2014)."""
BEFORE, AFTER, NEAR_M = 12, 20, 2.0
LOGS = {
    "intel_lab": "intel-corrected.log.gz",
    "freiburg_079": "freiburg-079-corrected.log.gz",
    "aces_austin": "aces-corrected.log.gz",
}


@dataclass(frozen=True)
class Outcome:
    """What became of one kidnapping."""

    delay: int | None
    recovered: int | None
    silent: int
    recovery_s: float | None


def configurations() -> dict[str, LocalizerConfig]:
    """Return the configurations that are compared."""
    default = LocalizerConfig()
    bounds = replace(default.bounds, range_error_m=0.05, bearing_error_rad=0.0, map_error_m=0.05)
    fixed = replace(default, bounds=bounds, outliers=0.12, free_space=replace(default.free_space, use=False))
    return {"default": default, "default, restart": replace(default, recovery="restart"), "fixed 12 %": fixed}


def carried(recording: InMemoryRecording, truth: Trajectory, localizer: Localizer, jump: Kidnapping) -> Outcome:
    """Localize around one kidnapping."""
    moved, reference = kidnap(recording, [jump], truth)
    assert reference is not None
    localizer.reset()
    containment = Containment(localizer, reference, "laser")
    delay = recovered = recovery_s = None
    silent = 0
    scans = localize(moved, localizer, start=jump.at - 2 * BEFORE, stop=jump.at + 2 * AFTER + 2, every=2)
    for number, (step, estimate) in enumerate(scans):
        behind = number - BEFORE - 1
        pose = containment.reference(step)
        if behind < 0 or pose is None:
            continue
        right = estimate.poses.contains(localizer.grid.pose_to_grid(pose))
        silent += estimate.status == "localized" and not right
        if delay is None and estimate.status in ("lost", "blind"):
            delay, recovery_s = behind, estimate.elapsed_s
        if recovered is None and estimate.status == "localized" and right:
            recovered = behind
    return Outcome(delay, recovered, silent, recovery_s)


def jumps(recording: InMemoryRecording, truth: Trajectory, count: int) -> list[Kidnapping]:
    """Return random kidnappings from an odd scan to an even one, behind which the odd ones go on."""
    readings, random = list(recording.readings()), np.random.default_rng(0)
    found: list[Kidnapping] = []
    while len(found) < count:
        at = 2 * int(random.integers(BEFORE, len(readings) // 2 - 1)) + 1
        to = 2 * int(random.integers(0, len(readings) // 2 - AFTER - 1))
        before, after = truth.at(readings[at].stamp_ns), truth.at(readings[to + 1].stamp_ns)
        if before is not None and after is not None and np.hypot(after.x - before.x, after.y - before.y) >= NEAR_M:
            found.append(Kidnapping(at, to))
    return found


def false_alarms(recording: InMemoryRecording, localizer: Localizer) -> float:
    """Return how many scans in an hour are rejected without kidnapping."""
    localizer.reset()
    run = list(localize(recording, localizer, start=1, every=2))
    alarms = sum(estimate.status in ("lost", "blind") for _, estimate in run)
    return 3600e9 * alarms / (run[-1][0].stamp_ns - run[0][0].stamp_ns)


def quantiles(values: list[int]) -> str:
    """Return median, 95 % and largest."""
    return ", ".join(f"{value:g}" for value in np.quantile(values, [0.5, 0.95, 1.0])) if values else "–"


def measure(folder: str, log: str, name: str, config: LocalizerConfig, count: int) -> Iterator[str]:
    """Yield the cells of one line."""
    home = Path(os.environ["IAL_DATA"]) / folder
    grid: OccupancyGrid = read_map(home / "map_even.yaml")
    truth = read_tum(home / "gt.tum")
    recording = InMemoryRecording(folder, open_recording(home / log).readings())
    localizer = Localizer(grid, config=config)
    begun = time.perf_counter()
    outcomes = [carried(recording, truth, localizer, jump) for jump in jumps(recording, truth, count)]
    noticed = [each.delay for each in outcomes if each.delay is not None]
    recovered = [each.recovered for each in outcomes if each.recovered is not None]
    times = [each.recovery_s for each in outcomes if each.recovery_s is not None]
    yield folder
    yield name
    yield quantiles(noticed)
    yield str(count - len(noticed))
    yield f"{len(recovered)} of {count}"
    yield quantiles(recovered)
    yield str(sum(each.silent for each in outcomes))
    yield f"{1e3 * statistics.median(times):.0f}, at most {1e3 * max(times):.0f}" if times else "–"
    yield f"{false_alarms(recording, localizer):.1f}"
    yield f"{time.perf_counter() - begun:.0f}"


def main() -> None:
    """Measure, print, and write."""
    parser = options(__doc__ or "")
    parser.add_argument("--count", type=int, default=100, help="kidnappings of each recording")
    chosen = parser.parse_args()
    report = Report("Kidnappings", ABOUT)
    head = (
        "recording|configuration|delay: median, 95 %, most|never noticed|recovered|after scans: median, 95 %, most|silent|"
        "ms of the recovery|false alarms an hour|s"
    )
    lines = (measure(folder, log, name, config, chosen.count) for folder, log in LOGS.items() for name, config in configurations().items())
    report.table(head.split("|"), lines)
    report.write(chosen.out)


if __name__ == "__main__":
    main()
