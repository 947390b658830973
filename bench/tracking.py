"""The time of one tracking update, against that of a particle filter in the same run; and whole recordings against the clock."""

import math
import os
import statistics
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from report import Report, options
from sources import LOGS, Source

from ial.contractors.threads import set_threads
from ial.datasets.opening import open_recording
from ial.datasets.recording import steps
from ial.lidar.localizer import Localizer
from ial.maps.grids.map_file import read_map
from ial.particles.likelihood_field import BeamModel
from ial.particles.monte_carlo import MonteCarlo, MonteCarloConfig
from ial.particles.odometry_model import OdometryModel

ABOUT = """\
Odd scans, map of the even ones, one thread. *Localizer*: the default configuration, 180 beams, from the first scan with one hypothesis on;
scans that were rejected (`lost`, `blind`) are left out of its times. *Particles*: `ial.particles.MonteCarlo` with 5,000 particles and 36
beams, `alpha1` … `alpha4` 0.02, 0.005, 0.02, 0.02, from the reference pose of the first scan on; *sum of cubes* is nav2's
`likelihood_field`, *product* its `likelihood_field_prob` with tempering. All take turns, scan by scan. The times of a filter hold
everything from a scan to an answer.

*Whole recording*: all scans, on all cores, from opening the file to the last estimate, without writing results."""
CALM = OdometryModel(0.02, 0.005, 0.02, 0.02)


def particles(data: Source, kind: str) -> MonteCarlo:
    """Return a particle filter that knows where the robot is."""
    first = next(steps(data.recording, Localizer(data.grid).config.bounds.motion, 1, None, 2))
    beam = BeamModel(max_beams=36, laser_model_type=kind)  # type: ignore[arg-type]
    return MonteCarlo(data.grid, MonteCarloConfig(beam=beam, odometry=CALM), 1, data.truth.at(first.stamp_ns), (0.2, 0.1))


def measure(data: Source, most: int) -> Iterator[str]:
    """Yield the cells of one line."""
    localizer = Localizer(data.grid)
    peers = {kind: particles(data, kind) for kind in ("likelihood_field", "likelihood_field_prob")}
    ours: list[float] = []
    theirs: dict[str, list[float]] = {kind: [] for kind in peers}
    errors: dict[str, list[float]] = {kind: [] for kind in peers}
    tracking = False
    for step in steps(data.recording, localizer.config.bounds.motion, 1, 2 * most, 2):
        begun = time.perf_counter()
        estimate = localizer.update(step.motion, step.scan)
        elapsed = time.perf_counter() - begun
        if tracking and estimate.status not in ("lost", "blind"):
            ours.append(elapsed)
        tracking = tracking or len(estimate.hypotheses) == 1
        truth = data.truth.at(step.stamp_ns)
        for kind, peer in peers.items():
            begun = time.perf_counter()
            cloud = peer.update(step.odometry.pose, step.scan)
            theirs[kind].append(time.perf_counter() - begun)
            if truth is not None:
                errors[kind].append(math.hypot(cloud.pose.x - truth.x, cloud.pose.y - truth.y))
    median, p99 = np.quantile(ours, [0.5, 0.99]).tolist()
    yield data.name
    yield f"{1e3 * median:.2f}, {1e3 * p99:.2f}"
    for kind in peers:
        yield f"{1e3 * statistics.median(theirs[kind]):.2f}"
    for kind in peers:
        peer_median = statistics.median(theirs[kind])
        yield f"{median / peer_median:.2f}, {p99 / peer_median:.1f}"
    for kind in peers:
        yield f"{np.mean(np.array(errors[kind]) < 0.5):.2f}"


def throughput(name: str) -> Iterator[str]:
    """Yield the cells of one line: a whole recording against the clock."""
    folder = Path(os.environ["IAL_DATA"]) / name
    grid = read_map(folder / "map.yaml")
    begun = time.perf_counter()
    localizer = Localizer(grid)
    stamps, busy = [], 0.0
    for step in steps(open_recording(folder / LOGS[name]), localizer.config.bounds.motion):
        busy += localizer.update(step.motion, step.scan).elapsed_s
        stamps.append(step.stamp_ns)
    wall = time.perf_counter() - begun
    recorded = 1e-9 * (stamps[-1] - stamps[0])
    yield name
    yield str(len(stamps))
    yield f"{recorded:.0f}"
    yield f"{wall:.1f}"
    yield f"{busy:.1f}"
    yield f"{recorded / wall:.0f}"


def main() -> None:
    """Measure, print, and write."""
    parser = options(__doc__ or "")
    parser.add_argument("--scans", type=int, default=800, help="at most so many of each recording")
    chosen = parser.parse_args()
    report = Report("Tracking", ABOUT)
    head = (
        "recording|localizer, ms: median, 99 %|sum of cubes, ms|product, ms|"
        "ratio to sum of cubes: median, 99 %|ratio to product: median, 99 %|"
        "sum of cubes within 0.5 m|product within 0.5 m"
    )
    set_threads(1)
    list(measure(Source.of("aces_austin"), 20))  # compiles
    report.table(head.split("|"), (measure(Source.of(name), chosen.scans) for name in LOGS))
    set_threads(None)
    report.table(["recording", "scans", "recorded, s", "wall, s", "of it localizing, s", "× real time"], map(throughput, LOGS))
    report.write(chosen.out)


if __name__ == "__main__":
    main()
