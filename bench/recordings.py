"""The localizer on real recordings, against their references: what is contained, how often it is unique, and how long it takes."""

import math
import os
import statistics
import time
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from answer_hash import AnswerHash
from consistent_share import ANSWERS, POSES, ConsistentShare
from report import Report, options
from sources import mrpt_loop

from ial.datasets.opening import open_recording
from ial.datasets.recording import Recording
from ial.datasets.sample import sample_grid, sample_recording
from ial.datasets.trajectory import Trajectory, read_tum
from ial.lidar.estimate import Estimate
from ial.lidar.localizer import Localizer
from ial.lidar.run import localize
from ial.maps.grids.map_file import read_map
from ial.maps.grids.occupancy_grid import OccupancyGrid
from ial.study.containment import Containment
from ial.study.reference import TruthFrame

ABOUT = f"""\
Every run has the default configuration. Maps called *even* were drawn from the even scans and are used with the odd ones. References marked
*pseudo* come from a particle filter and are good to 0.1–0.2 m: a sanity check, no measurement. Words as in the page on the guarantee.
*Consistent share*: how much of the volume of a localized answer is truly consistent, on average, with its interval of 95 % confidence;
{ANSWERS} answers at random, {POSES} random poses of each, every pose judged by the slow twin at the reported number of outliers, in the
domain, with free space. *Answers*: their hash; two commits that have the same one answer alike, bit for bit. `✗` marks what misses its
goal; the goals are: `contained when the assumptions hold` 1 over a denominator above 0, `contained` 0.97 (static) and 0.985 (recursive),
and one hypothesis in 97 % of the scans after the first that had one (recursive), for Intel and Freiburg."""
SHOWN = 25  # scans of one reason
SAMPLE_END, SAMPLE_TOLERANCE_M = (15.89, -10.0), 0.5  # what MRPT's own test of this recording accepts


@dataclass(frozen=True)
class Run:
    """A recording, the map and the reference that belong to it, and what is expected."""

    name: str
    recording: str
    map: str
    truth: str
    frame: TruthFrame = "base"
    odd: bool = False
    static: bool = False
    contained: float | None = None
    unique: float | None = None

    def open(self) -> tuple[Recording, OccupancyGrid, Trajectory]:
        """Read the files."""
        folder = Path(os.environ["IAL_DATA"])
        recording = mrpt_loop() if not self.recording else open_recording(folder / self.recording)
        return recording, read_map(folder / self.map), read_tum(folder / self.truth)


def carmen(folder: str, log: str, static: bool = False, contained: float | None = None, unique: float | None = None) -> Run:
    """Return the odd scans of a CARMEN log in the map of its even ones."""
    name = f"{folder}, odd scans, even map, {'static' if static else 'recursive'}"
    return Run(name, f"{folder}/{log}", f"{folder}/map_even.yaml", f"{folder}/gt.tum", "laser", True, static, contained, unique)


RUNS = [
    carmen("intel_lab", "intel-corrected.log.gz", static=True, contained=0.97),
    carmen("intel_lab", "intel-corrected.log.gz", contained=0.985, unique=0.97),
    carmen("freiburg_079", "freiburg-079-corrected.log.gz", contained=0.985, unique=0.97),
    carmen("aces_austin", "aces-corrected.log.gz"),
    Run("mrpt_loop, key frames of the same run", "", "mrpt_malaga/map_loop.yaml", "mrpt_malaga/map_loop_keyframes.tum"),
    Run(
        "olin_mac_tb4, pseudo", "olin_mac_tb4/original/macfirst_floor_take_2", "olin_mac_tb4/map.yaml", "olin_mac_tb4/pseudo_reference.tum"
    ),
    *(
        Run(
            name=f"wean_hall {number}, pseudo",
            recording=f"wean_hall/original/robotdata{number}.log.gz",
            map="wean_hall/map.yaml",
            truth=f"wean_hall/pseudo_reference_{number}.tum",
        )
        for number in range(1, 6)
    ),
]


def figure(value: float | None, goal: float | None = None) -> str:
    """Return a share with three digits, marked where it misses its goal."""
    if value is None:
        return "–" if goal is None else "✗ –"
    mark = "✗ " if goal is not None and value < goal else ""
    return f"{mark}{value:.4f}"


def widths(half_widths: list[tuple[float, float]]) -> str:
    """Return the medians of the half-widths while localized."""
    if not half_widths:
        return "–"
    position, heading = (statistics.median(each) for each in zip(*half_widths, strict=True))
    return f"{position:.3f} m, {math.degrees(heading):.1f}°"


def measure(run: Run, misses: dict[str, list[dict[str, Any]]]) -> Iterator[str]:
    """Localize a recording; yield the cells of its line, and keep the scans whose reference was not contained."""
    recording, grid, truth = run.open()
    localizer = Localizer(grid)
    containment = Containment(localizer, truth, run.frame, static=run.static)
    consistent = ConsistentShare(localizer)
    answers = AnswerHash()
    statuses: Counter[str] = Counter()
    unique = since_unique = limited = 0
    times, half_widths = [], []
    begun = time.perf_counter()
    for step, estimate in localize(recording, localizer, start=int(run.odd), every=1 + run.odd, static=run.static):
        times.append(estimate.elapsed_s)
        statuses[estimate.status] += 1
        since_unique += bool(unique) or len(estimate.hypotheses) == 1
        unique += len(estimate.hypotheses) == 1
        if estimate.pose is not None:
            half_widths.append(estimate.hypotheses[0].half_widths)
        limited += bool(estimate.limited)
        containment.add(step, estimate)
        consistent.add(step, estimate)
        answers.add(estimate)
    elapsed = time.perf_counter() - begun
    summary = containment.summary()
    misses[run.name] = containment.misses
    scans = len(times)
    yield run.name
    yield str(scans)
    yield figure(summary["contained"], run.contained)
    yield figure(summary["contained_hull"])
    yield figure(summary["assumptions_hold"])
    goal = None if run.contained is None else 1.0
    yield f"{figure(summary['contained_when_assumptions_hold'], goal)} of {summary['scans_where_assumptions_hold']}"
    yield ", ".join(f"{count} {name}" for name, count in summary["broken"].items() if count) or "–"
    yield figure(unique / since_unique if since_unique else None, run.unique)
    yield widths(half_widths)
    yield str(consistent)
    yield ", ".join(f"{count} {name}" for name, count in statuses.most_common())
    yield figure(summary["median_position_error_m"])
    yield f"{1e3 * statistics.median(times):.0f}, at most {1e3 * max(times):.0f}"
    yield f"{elapsed:.1f}"
    yield str(limited)
    yield str(answers)


def reasons(misses: list[dict[str, Any]]) -> str:
    """Return the scans of a run by reason: their numbers where they are few."""
    by_reason: dict[str, list[int]] = {}
    for miss in misses:
        by_reason.setdefault(" and ".join(miss["broken"]).replace("_", " ") or "✗ nothing is broken", []).append(miss["index"])
    words = []
    for reason, scans in sorted(by_reason.items(), key=lambda each: -len(each[1])):
        shown = ", ".join(map(str, scans[:SHOWN])) + (", …" if len(scans) > SHOWN else "")
        words.append(f"{len(scans)} {reason} ({shown})")
    return "; ".join(words) or "none"


def sample_end() -> Estimate:
    """Localize the embedded sample; return the last estimate."""
    localizer = Localizer(sample_grid())
    for _, estimate in localize(sample_recording(), localizer):
        last = estimate
    return last


def verdict(last: Estimate) -> str:
    """Return whether the sample ends where it should, in words."""
    if len(last.hypotheses) != 1:
        return f"✗ {len(last.hypotheses)} hypotheses at the end"
    (only,) = last.hypotheses
    farthest = max(abs(x - SAMPLE_END[0]) ** 2 + abs(y - SAMPLE_END[1]) ** 2 for x in only.x for y in only.y) ** 0.5
    mark = "✗ " if farthest > SAMPLE_TOLERANCE_M else ""
    return f"{mark}one hypothesis at the end, all of it within {farthest:.2f} m of {SAMPLE_END} (the goal is {SAMPLE_TOLERANCE_M})"


def main() -> None:
    """Measure, print, and write."""
    parser = options(__doc__ or "")
    parser.add_argument("--only", metavar="TEXT", default="", help="only the recordings whose name holds this")
    chosen = parser.parse_args()
    report = Report("Real recordings", ABOUT)
    report.say(f"Embedded sample: {verdict(sample_end())}.\n")
    if "IAL_DATA" in os.environ:
        head = (
            "recording|scans|contained|contained in hull|assumptions hold|contained when they hold|broken|one hypothesis|"
            "half-widths|consistent share|status|"
            "median error, m|ms a scan, median|s in all|limited|answers"
        )
        misses: dict[str, list[dict[str, Any]]] = {}
        report.table(head.split("|"), (measure(run, misses) for run in RUNS if chosen.only in run.name))
        report.say("## Every miss: scans whose reference is not in the answer, by what the reference breaks\n")
        for name, missed in misses.items():
            report.say(f"- {name}: {reasons(missed)}")
        report.say()
    else:
        report.say("IAL_DATA is not set; set it to the folder of the test data to measure the other recordings.")
    report.write(chosen.out)


if __name__ == "__main__":
    main()
