"""What one scan alone leaves of the possible poses, with and without free space along its beams."""

import os
import statistics
from collections.abc import Iterator
from dataclasses import replace
from itertools import islice, product
from pathlib import Path

from report import Report, options

from ial.datasets.opening import open_recording
from ial.datasets.recording import steps
from ial.datasets.trajectory import read_tum
from ial.lidar.configuration.config import FreeSpace, LocalizerConfig, Outliers
from ial.lidar.localizer import Localizer
from ial.maps.grids.map_file import read_map
from ial.study.containment import Containment

ABOUT = """\
Odd scans, maps of the even ones, each scan by itself over the whole map, without any prior; about 90 scans of each recording. The bounds
are ±0.05 m (range) and ±0.05 m (map), with `auto` the default ones. *Assumptions*: the share of scans at which the reference has no more
bad or blocked beams than allowed. *Unique*: one hypothesis."""
LOGS = {
    "intel_lab": ("intel-corrected.log.gz", 5),
    "freiburg_079": ("freiburg-079-corrected.log.gz", 26),
    "aces_austin": ("aces-corrected.log.gz", 2),
}
OUTLIERS: tuple[Outliers, ...] = (0.2, 0.1, "auto")
FREE = (FreeSpace(use=False), FreeSpace(True, 0.1, 60), FreeSpace(True, 0.05, 180), FreeSpace(True, 0.02, 180))


def configuration(outliers: Outliers, free_space: FreeSpace) -> LocalizerConfig:
    """Return what is measured in one line."""
    default = LocalizerConfig(outliers=outliers, free_space=free_space)
    if outliers == "auto":
        return default
    return replace(default, bounds=replace(default.bounds, range_error_m=0.05, bearing_error_rad=0.0, map_error_m=0.05))


def measure(folder: str, log: str, every: int, config: LocalizerConfig) -> Iterator[str]:
    """Yield the cells of one line."""
    home = Path(os.environ["IAL_DATA"]) / folder
    localizer = Localizer(read_map(home / "map_even.yaml"), config=config)
    containment = Containment(localizer, read_tum(home / "gt.tum"), "laser", static=True)
    counts, times = [], []
    for step in islice(steps(open_recording(home / log), config.bounds.motion, 1, None, 2), None, None, every):
        estimate = localizer.locate(step.scan)
        containment.add(step, estimate)
        counts.append(len(estimate.hypotheses))
        times.append(estimate.elapsed_s)
    summary, free = containment.summary(), config.free_space
    yield folder
    yield str(config.outliers)
    yield f"{free.margin_m:g} m, {free.max_rays} rays" if free.use else "–"
    yield str(len(counts))
    yield f"{counts.count(1) / len(counts):.3f}"
    yield f"{statistics.mean(counts):.1f}"
    yield f"{summary['contained']:.3f}"
    yield f"{summary['assumptions_hold']:.3f}"
    yield f"{summary['contained_when_assumptions_hold']}"
    yield f"{1e3 * statistics.median(times):.0f}, mean {1e3 * statistics.mean(times):.0f}"


def main() -> None:
    """Measure, print, and write."""
    chosen = options(__doc__ or "").parse_args()
    report = Report("Ambiguity of one scan", ABOUT)
    head = "recording|outliers|free space|scans|unique|hypotheses, mean|contained|assumptions|contained when they hold|ms, median"
    lines = (
        measure(folder, *log, configuration(outliers, free)) for (folder, log), outliers, free in product(LOGS.items(), OUTLIERS, FREE)
    )
    report.table(head.split("|"), lines)
    report.write(chosen.out)


if __name__ == "__main__":
    main()
