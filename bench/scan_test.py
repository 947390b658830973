"""Nanoseconds for one test of a box and a beam, against a bare loop that reads the same numbers from the same table."""

import os
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from ial.contractors.boxes import Boxes
from ial.contractors.paver import pave
from ial.contractors.threads import available_threads, set_threads
from ial.datasets.opening import open_recording
from ial.datasets.recording import steps
from ial.datasets.scan import LaserScan
from ial.lidar.beams import select_beams
from ial.lidar.config import Bounds, LocalizerConfig
from ial.lidar.model import LidarModel
from ial.lidar.scan_contractor import ScanContractor
from ial.maps.map_file import read_map
from ial.maps.occupancy_grid import OccupancyGrid
from lookups import Lookups
from plans import OUTLIERS, plan_and_scans
from report import Report, options

ABOUT = (
    "Static localization of one scan on the whole map, one thread and all. Each batch of boxes that the paver hands to the scan contractor is "
    "recorded. *kernel* is `ScanContractor.fits` on it, grouping, θ-dependent terms, early exit and sharing among threads included; *floor* "
    "replays the recorded table indices of the same tests: four reads, three sums, one comparison. Each time is the least of the repetitions, "
    "summed over the batches. The goal is a ratio of at most 2."
)
ROWS = 1 << 15  # a larger batch is measured in parts, so that its recorded indices fit into memory
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
    plan, scans, _ = plan_and_scans(50.0, 50.0, 0.05, count=1)
    yield Case("floor plan, 50 × 50 m", plan, scans[0], LocalizerConfig(bounds=Bounds(0.05, 0.0, 0.0), outliers=OUTLIERS))
    if "IAL_DATA" in os.environ:
        folder = Path(os.environ["IAL_DATA"]) / "intel_lab"
        config = LocalizerConfig()
        step = next(steps(open_recording(folder / "intel-corrected.log.gz"), config.bounds.motion, start=301))
        yield Case("intel_lab, scan 301", read_map(folder / "map_even.yaml"), step.scan, config)


class BatchRecorder:
    """The constraint of the localizer, which remembers the batches that reach the scan contractor."""

    dimension = 3

    def __init__(self, model: LidarModel, scan: ScanContractor) -> None:
        self._model = model
        self._scan = scan
        self.batches: list[Boxes] = []

    def contract(self, boxes: Boxes) -> Boxes:
        """Return the boxes, those emptied that hold no consistent pose."""
        keep = self._model.domain.meet(Boxes(boxes.lower[:, :2], boxes.upper[:, :2]))
        rows = np.flatnonzero(keep)
        self.batches.append(boxes[rows])
        keep[rows] = self._scan.fits(self.batches[-1])
        return boxes.where(keep)


def least_time(work: Callable[[], object]) -> float:
    """Return the least time of several runs, seconds."""
    times = []
    for _ in range(REPETITIONS):
        begun = time.perf_counter()
        work()
        times.append(time.perf_counter() - begun)
    return min(times)


def measure(case: Case, threads: list[int]) -> Iterator[tuple[object, ...]]:
    """Yield one row of the table for each number of threads."""
    model = LidarModel(case.grid, case.config)
    beams = select_beams(case.scan, case.config.bounds, case.config.outliers, case.config.max_beams)
    scan = ScanContractor(beams, model.occupied, case.config.bounds.map_error_m)
    recorder = BatchRecorder(model, scan)
    pave(recorder, model.universe().boxes, model.lattice.widths, max_boxes=case.config.max_boxes)
    boxes = tests = 0
    kernel, floor = dict.fromkeys(threads, 0.0), dict.fromkeys(threads, 0.0)
    for batch in recorder.batches:
        for start in range(0, len(batch), ROWS):
            part = batch[start : start + ROWS]
            lookups = Lookups(scan, part)
            if (lookups.replay() != scan.fits(part)).any():
                raise AssertionError("the recorded tests are not those of the kernel; bring bench/lookups.py up to date")
            boxes, tests = boxes + len(part), tests + lookups.tests
            for count in threads:
                set_threads(count)
                floor[count] += least_time(lookups.replay)
                kernel[count] += least_time(lambda part=part: scan.fits(part))
    for count in threads:
        per_kernel, per_floor = 1e9 * kernel[count] / tests, 1e9 * floor[count] / tests
        counts = (f"{boxes:,}", f"{tests:,}", f"{tests / max(boxes, 1):.0f} of {len(beams)}")
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
