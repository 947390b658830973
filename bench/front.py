"""How tight the answer can be made for how much of the truth: half-widths against what is contained, over bounds and outliers."""

import math
import os
import statistics
from collections.abc import Iterator
from dataclasses import replace
from itertools import product
from pathlib import Path

from report import Report, options

from ial.datasets.in_memory import InMemoryRecording
from ial.datasets.opening import open_recording
from ial.datasets.trajectory import read_tum
from ial.lidar.configuration.config import Bounds, LocalizerConfig, Outliers, Precision
from ial.lidar.localizer import Localizer
from ial.lidar.run import localize
from ial.maps.grids.map_file import read_map
from ial.study.containment import Containment

ABOUT = """\
Odd scans, maps of the even ones, all else as in the default configuration. Half-widths are medians over the localized scans. *Unique*: one
hypothesis, among the scans from the first that had one. The goal is 0.10 m and 2.5° at 0.98 contained."""
LOGS = {"intel_lab": "intel-corrected.log.gz", "freiburg_079": "freiburg-079-corrected.log.gz"}
ERRORS = ((0.05, 0.0, 0.05), (0.03, 0.005, 0.04), (0.03, 0.005, 0.03), (0.02, 0.005, 0.03))
OUTLIERS: tuple[tuple[Outliers, float], ...] = ((0.2, 0.0), ("auto", 0.05), ("auto", 0.07), ("auto", 0.08), ("auto", 0.1), ("auto", 0.13))
PRECISIONS = (Precision(halvings=0), Precision(), Precision(halvings=4))


def measure(name: str, recording: InMemoryRecording, config: LocalizerConfig) -> Iterator[str]:
    """Yield the cells of one line."""
    home = Path(os.environ["IAL_DATA"]) / name
    localizer = Localizer(read_map(home / "map_even.yaml"), config=config)
    containment = Containment(localizer, read_tum(home / "gt.tum"), "laser")
    widths, counts, times = [], [], []
    for step, estimate in localize(recording, localizer, start=1, every=2):
        containment.add(step, estimate)
        counts.append(len(estimate.hypotheses))
        times.append(estimate.elapsed_s)
        if estimate.pose is not None:
            widths.append(estimate.hypotheses[0].half_widths)
    summary, bounds = containment.summary(), config.bounds
    since = counts[counts.index(1) :] if 1 in counts else []
    yield name
    yield f"{bounds.range_error_m:g} m, {bounds.bearing_error_rad:g} rad, {bounds.map_error_m:g} m"
    yield f"auto + {config.outlier_margin:g}" if config.outliers == "auto" else f"{config.outliers:g}"
    yield str(config.precision.halvings)
    yield f"{statistics.median(each[0] for each in widths):.3f} m, {math.degrees(statistics.median(each[1] for each in widths)):.1f}°"
    yield f"{summary['contained']:.4f}"
    yield f"{since.count(1) / len(since):.3f}" if since else "–"
    yield f"{summary['assumptions_hold']:.3f}"
    yield f"{summary['contained_when_assumptions_hold']:.4f} of {summary['scans_where_assumptions_hold']}"
    yield f"{1e3 * statistics.median(times):.1f}"


def configurations() -> Iterator[LocalizerConfig]:
    """Yield what is measured."""
    default = LocalizerConfig()
    for precision, error, (outliers, margin) in product(PRECISIONS, ERRORS, OUTLIERS):
        bounds = Bounds(*error, default.bounds.motion)
        yield replace(default, bounds=bounds, outliers=outliers, outlier_margin=margin, precision=precision)


def main() -> None:
    """Measure, print, and write."""
    parser = options(__doc__ or "")
    parser.add_argument("--stop", type=int, help="only the scans before this one of each recording")
    chosen = parser.parse_args()
    report = Report("Width against containment", ABOUT)
    head = "recording|bounds: range, bearing, map|outliers|halvings|half-widths|contained|unique|assumptions|contained when they hold|ms"
    for name, log in LOGS.items():
        readings = open_recording(Path(os.environ["IAL_DATA"]) / name / log).readings()
        recording = InMemoryRecording(name, [each for each in readings if chosen.stop is None or each.index < chosen.stop])
        report.table(head.split("|"), (measure(name, recording, config) for config in configurations()))
    report.write(chosen.out)


if __name__ == "__main__":
    main()
