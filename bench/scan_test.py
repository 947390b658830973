"""Nanoseconds for one test of a box and a beam, against a bare loop that reads the same numbers from the same table."""

import os
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from unittest import mock

import numpy as np
import numpy.typing as npt
from lookups import Lookups
from plans import CONFIG, scenes
from report import Report, options
from timing import timed

from ial.contractors.boxes import Boxes
from ial.contractors.threads import available_threads, set_threads
from ial.datasets.opening import open_recording
from ial.datasets.recording import steps
from ial.datasets.scan import LaserScan
from ial.lidar.configuration.config import LocalizerConfig
from ial.lidar.localizer import Localizer
from ial.lidar.search import pose_contractor
from ial.lidar.search.scan_contractor import ScanContractor
from ial.maps.grids.map_file import read_map
from ial.maps.grids.occupancy_grid import OccupancyGrid

ABOUT = """\
Static localization of one scan on the whole map, one thread and all. Each batch of boxes that the paver hands to the scan contractor is
recorded. *kernel* is `ScanContractor.fits` on it, grouping, θ-dependent terms, early exit and sharing among threads included; *floor*
replays the recorded table indices of the same tests: four reads, three sums, one comparison. Each time is the least of the repetitions,
summed over the batches. The goal is a ratio of at most 2."""
REPETITIONS = 7


@dataclass(frozen=True)
class Case:
    """One scan in one map."""

    name: str
    grid: OccupancyGrid
    scan: LaserScan
    config: LocalizerConfig


def cases() -> Iterator[Case]:
    """Yield what is measured: a floor plan, and a real recording where the test data are at hand."""
    (scene,) = scenes(50.0, 50.0, 0.05, plans=1, scans=1)
    yield Case("floor plan, 50 × 50 m", scene.grid, scene.scan, CONFIG)
    if "IAL_DATA" in os.environ:
        folder = Path(os.environ["IAL_DATA"]) / "intel_lab"
        config = LocalizerConfig()
        step = next(steps(open_recording(folder / "intel-corrected.log.gz"), config.bounds.motion, start=301))
        yield Case("intel_lab, scan 301", read_map(folder / "map_even.yaml"), step.scan, config)


def recorded(case: Case) -> tuple[ScanContractor, list[Boxes]]:
    """Localize, and return the scan contractor with the batches that it was given."""
    batches: list[Boxes] = []
    made: list[ScanContractor] = []

    class Listener(ScanContractor):
        def fits(self, boxes: Boxes) -> npt.NDArray[np.bool_]:
            made.append(self)
            batches.append(boxes)
            return super().fits(boxes)

    with mock.patch.object(pose_contractor, "ScanContractor", Listener):
        Localizer(case.grid, config=case.config).locate(case.scan)
    listener = made[0]
    return ScanContractor(listener.beams, listener.occupied), batches


def measure(case: Case, threads: list[int]) -> Iterator[tuple[object, ...]]:
    """Yield one row of the table for each number of threads."""
    scan, batches = recorded(case)
    boxes = tests = 0
    kernel, floor = dict.fromkeys(threads, 0.0), dict.fromkeys(threads, 0.0)
    for batch in batches:
        lookups = Lookups(scan, batch)
        if (lookups.replay() != scan.fits(batch)).any():
            raise AssertionError("the recorded tests are not those of the kernel; bring bench/lookups.py up to date")
        boxes, tests = boxes + len(batch), tests + lookups.tests
        for count in threads:
            set_threads(count)
            floor[count] += timed(lookups.replay, runs=REPETITIONS)[0]
            kernel[count] += timed(scan.fits, batch, runs=REPETITIONS)[0]
    for count in threads:
        per_kernel, per_floor = 1e9 * kernel[count] / tests, 1e9 * floor[count] / tests
        counts = (f"{boxes:,}", f"{tests:,}", f"{tests / max(boxes, 1):.0f} of {len(scan.beams)}")
        yield case.name, count, *counts, f"{per_kernel:.2f}", f"{per_floor:.2f}", f"{kernel[count] / floor[count]:.2f}"


def main() -> None:
    """Measure, print, and write."""
    chosen = options(__doc__ or "").parse_args()
    report = Report("One test of a box and a beam", ABOUT)
    threads = sorted({1, available_threads()})
    head = ("map", "threads", "boxes", "tests", "beams tested a box", "kernel, ns a test", "floor, ns a test", "ratio")
    report.table(head, (row for case in cases() for row in measure(case, threads)))
    if "IAL_DATA" not in os.environ:
        report.say("IAL_DATA is not set; set it to the folder of the test data to measure a real recording too.")
    report.write(chosen.out)


if __name__ == "__main__":
    main()
