"""Kidnapped recordings: how soon it is noticed, where the robot is found again, and what it costs."""

import itertools
import statistics
import time
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from report import Report, options
from sources import NAMES, Source

from ial.datasets.kidnapping import Kidnapping, kidnap
from ial.datasets.scan import LaserScan
from ial.lidar.configuration.config import LocalizerConfig
from ial.lidar.localizer import Localizer
from ial.lidar.run import localize
from ial.pose import Pose
from ial.study.containment import Containment

ABOUT = """\
Each kidnapping joins two places of a recording, drawn at random; odometry and clock go on. The localizer begins 12 processed scans before
with nothing known, and is watched for 20 scans. Odd scans and maps of the even ones; all scans of the MRPT loop, whose map is of the
same run and whose reference is a pseudo-reference.

*Any*: at least 2 m away. *Near*: 1 to 3 m. *Look-alike*: at least 2 m away, to a scan that alone would also fit where the robot believes
to be. *Repeated*: three in a row, 15 processed scans apart; what is counted is the last one. *Delay*: processed scans after the jump until
one is reported as `lost` or `blind`; 0 is the first one. *Recovered*: localized within those 20 scans at a place that holds the reference.
*Silent*: scans localized at a place that does not hold it. *False alarms*: `lost` and `blind` scans in the whole recording without
kidnapping, for each hour of it. `fixed 12 %` has ±0.05 m, ±0.05 m, no free space and 12 % outliers; `restart` trusts the scan that rejected
the prediction (Guyonneau et al. 2014)."""
BEFORE, AFTER, APART = 12, 20, 15
DISTANCES_M = {"any": (2.0, np.inf), "near": (1.0, 3.0), "look-alike": (2.0, np.inf), "repeated": (2.0, np.inf)}
TRIES = {"any": 5000, "near": 5000, "look-alike": 250, "repeated": 5000}


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


def carried(source: Source, localizer: Localizer, jumps: list[Kidnapping]) -> Outcome:
    """Localize around the last of some kidnappings, from before the first one on."""
    moved, reference = kidnap(source.recording, jumps, source.truth)
    assert reference is not None
    localizer.reset()
    containment = Containment(localizer, reference, source.frame)
    delay = recovered = recovery_s = None
    silent = 0
    every = source.every
    first, at = jumps[0].at, jumps[0].at
    for earlier, later in itertools.pairwise(jumps):
        at += later.at - earlier.to + 1
    for step, estimate in localize(moved, localizer, start=first - every * BEFORE, stop=at + every * (AFTER + 1), every=every):
        since = (step.index - at) // every - 1
        pose = containment.reference(step)
        if since < 0 or pose is None:
            continue
        right = estimate.poses.contains(localizer.grid.pose_to_grid(pose))
        silent += estimate.status == "localized" and not right
        if delay is None and estimate.status in ("lost", "blind"):
            delay, recovery_s = since, estimate.elapsed_s
        if recovered is None and estimate.status == "localized" and right:
            recovered = since
    return Outcome(delay, recovered, silent, recovery_s)


def draw(source: Source, kind: str, count: int) -> list[list[Kidnapping]]:
    """Return random kidnappings after a processed scan, to one that is followed by the processed ones."""
    readings, random, every = list(source.recording.readings()), np.random.default_rng(0), source.every
    poses = [source.truth.at(reading.stamp_ns) for reading in readings]
    last = len(readings) // every
    nearest, farthest = DISTANCES_M[kind]
    localizer = Localizer(source.grid)
    drawn: list[list[Kidnapping]] = []

    def fits(at: int, to: int) -> bool:
        """Return whether a kidnapping is of the kind that is wanted."""
        before, after = poses[at], poses[to + source.start]
        return before is not None and after is not None and nearest <= np.hypot(after.x - before.x, after.y - before.y) <= farthest

    for _ in range(TRIES[kind]):
        at = every * int(random.integers(BEFORE, last - 1)) + source.start
        to = every * int(random.integers(0, last - AFTER - 1))
        if kind == "look-alike":
            answer = localizer.locate(readings[to + source.start].scan).poses
            others = [
                row
                for row in range(every * BEFORE + source.start, len(readings) - every, every)
                if fits(row, to) and answer.contains(source.grid.pose_to_grid(in_base(source, readings[row].scan, poses[row])))
            ]
            if not others:
                continue
            at = int(random.choice(others))
        jumps = [Kidnapping(at, to)]
        while kind == "repeated" and len(jumps) < 3:
            at = jumps[-1].to + source.start + every * APART
            to = every * int(random.integers(0, last - 4 * AFTER))
            jumps.append(Kidnapping(at, to))
        if all(jump.at < len(readings) - every and jump.to != jump.at + 1 and fits(jump.at, jump.to) for jump in jumps):
            drawn.append(jumps)
        if len(drawn) == count:
            break
    return drawn


def in_base(source: Source, scan: LaserScan, pose: Pose) -> Pose:
    """Return a reference pose as one of the base."""
    return pose @ scan.mounting.pose.inverse() if source.frame == "laser" else pose


def false_alarms(source: Source, localizer: Localizer) -> float:
    """Return how many scans in an hour are rejected without kidnapping."""
    localizer.reset()
    run = list(localize(source.recording, localizer, start=source.start, every=source.every))
    alarms = sum(estimate.status in ("lost", "blind") for _, estimate in run)
    return 3600e9 * alarms / (run[-1][0].stamp_ns - run[0][0].stamp_ns)


def quantiles(values: list[int]) -> str:
    """Return median, 95 % and largest."""
    return ", ".join(f"{value:g}" for value in np.quantile(values, [0.5, 0.95, 1.0])) if values else "–"


def measure(source: Source, kind: str, name: str, config: LocalizerConfig, count: int) -> Iterator[str]:
    """Yield the cells of one line."""
    localizer = Localizer(source.grid, config=config)
    begun = time.perf_counter()
    outcomes = [carried(source, localizer, jumps) for jumps in draw(source, kind, count)]
    count = len(outcomes)
    noticed = [each.delay for each in outcomes if each.delay is not None]
    recovered = [each.recovered for each in outcomes if each.recovered is not None]
    times = [each.recovery_s for each in outcomes if each.recovery_s is not None]
    yield source.name
    yield kind
    yield name
    yield quantiles(noticed)
    yield str(count - len(noticed))
    yield f"{len(recovered)} of {count}"
    yield quantiles(recovered)
    yield str(sum(each.silent for each in outcomes))
    yield f"{1e3 * statistics.median(times):.0f}, at most {1e3 * max(times):.0f}" if times else "–"
    yield f"{false_alarms(source, localizer):.1f}" if kind == "any" else ""
    yield f"{time.perf_counter() - begun:.0f}"


def main() -> None:
    """Measure, print, and write."""
    parser = options(__doc__ or "")
    parser.add_argument("--count", type=int, default=100, help="kidnappings of each recording")
    chosen = parser.parse_args()
    report = Report("Kidnappings", ABOUT)
    head = (
        "recording|kind|configuration|delay: median, 95 %, most|never noticed|recovered|after scans: median, 95 %, most|silent|"
        "ms of the recovery|false alarms an hour|s"
    )
    report.table(head.split("|"), lines(chosen.count))
    report.write(chosen.out)


def lines(count: int) -> Iterator[Iterator[str]]:
    """Yield the lines of the table."""
    for source in map(Source.of, NAMES):
        for name, config in configurations().items():
            yield measure(source, "any", name, config, count)
        for kind in ("near", "look-alike", "repeated"):
            yield measure(source, kind, "default", LocalizerConfig(), count // 4)


if __name__ == "__main__":
    main()
