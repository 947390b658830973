"""Static localization on maps of growing size: nodes, time, memory; and a brute-force likelihood search beside it on the same scans."""

import json
import math
import pickle
import resource
import statistics
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from unittest import mock

from report import Report, options  # ial is loaded in the processes of the cases: a child's peak memory is at least its parent's
from timing import timed


@dataclass(frozen=True)
class Case:
    """Maps of one size, and how many of them, with how many scans in each."""

    width_m: float
    height_m: float
    resolution: float
    plans: int
    scans: int = 1

    def __str__(self) -> str:
        return f"{self.width_m:g} × {self.height_m:g} m, {100.0 * self.resolution:g} cm"

    @property
    def area_m2(self) -> float:
        """The area of the map."""
        return self.width_m * self.height_m


CASES = [
    Case(10.0, 4.7, 0.02, 20),
    Case(10.0, 10.0, 0.05, 20),
    Case(50.0, 50.0, 0.05, 40),
    Case(100.0, 100.0, 0.05, 16),
    Case(400.0, 400.0, 0.05, 1, 4),
    Case(1000.0, 1000.0, 0.05, 1),
]
CAMPUS = CASES[-1]
GROWTH = CASES[2:-1]  # the maps from which the exponent is taken
BRUTE_M2 = 100.0  # the brute-force search runs on maps of at most this size
SLOW_S = 0.2  # what takes longer is timed once
ABOUT = """\
One scan of 180 beams all around, up to 10 % of them wrong, no prior: every pose on the whole map. Random floor plans, random places; what
a single place costs varies by a factor of two, so small maps are many. Bounds: `range_error_m` 0.05 and no other, 18 outliers, default
precision; simulated errors are uniform within these bounds. Nodes are means, times are medians over the scans. Each size runs in a process
of its own, kernels compiled beforehand. *Memory* is the peak of that process (`getrusage`), in brackets what it was before the first
search: Python, the map and its tables. *Answers*: their hash; two commits that have the same one answer alike, bit for bit."""


def peak_mb() -> float:
    """Return the largest memory this process ever had, MB."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / (1024.0**2 if sys.platform == "darwin" else 1024.0)


def draw(case: Case, file: Path) -> None:
    """Simulate the scenes of a case into a file; this takes memory that the search does not."""
    from plans import scenes

    with file.open("wb") as out:
        for scene in scenes(case.width_m, case.height_m, case.resolution, case.plans, case.scans):
            pickle.dump(scene, out)


def nodes_of(localizer: Any, scan: Any) -> int:
    """Return how many boxes and cells the search for a scan tries."""
    from ial.lidar import model

    tried, pave, count_cells = [], model.pave, model.count_cells

    def paved(*args: Any, **options: Any) -> Any:
        paving = pave(*args, **options)
        tried.append(paving.nodes)
        return paving

    def counted(bitmaps: Any, *args: Any) -> Any:
        tried.append(len(bitmaps))
        return count_cells(bitmaps, *args)

    with mock.patch.multiple(model, pave=paved, count_cells=counted):
        localizer.locate(scan)
    return sum(tried)


def measure(scene: Any, config: Any, answers: Any, brute_force: bool) -> dict[str, Any]:
    """Localize in one scene; return what was measured, as plain values, and the hash of all answers so far."""
    from ial.contractors.threads import set_threads
    from ial.lidar.localizer import Localizer
    from ial.particles.brute_force import BruteForce

    localizer = Localizer(scene.grid, config=config)
    brute = BruteForce(scene.grid) if brute_force else None
    row: dict[str, Any] = {"before_mb": peak_mb()}
    for name, threads in (("one", 1), ("all", None)):
        set_threads(threads)
        row[f"{name}_s"], estimate = timed(localizer.locate, scene.scan, runs=3, enough_s=SLOW_S)
        if brute is not None:
            row[f"brute_{name}_s"], match = timed(brute.locate, scene.scan, runs=3, enough_s=SLOW_S)
    row |= {"peak_mb": peak_mb(), "nodes": nodes_of(localizer, scene.scan), "limited": estimate.limited}
    row |= {"hypotheses": len(estimate.hypotheses), "contained": estimate.poses.contains(scene.grid.pose_to_grid(scene.truth))}
    answers.add(estimate)
    row["answers"] = str(answers)
    row["off_m"] = min(off(each.centre, scene.truth) for each in estimate.hypotheses)
    if brute is not None:
        row |= {"brute_poses": match.poses, "brute_off_m": off(match.best.pose, scene.truth)}
    return row


def search(case: Case, file: Path) -> list[dict[str, Any]]:
    """Localize in every scene of a file."""
    from answer_hash import AnswerHash
    from plans import CONFIG, scenes

    for scene in scenes(6.0, 6.0, 0.05, 1, 1):
        measure(scene, CONFIG, AnswerHash(), brute_force=True)  # loads the kernels
    answers = AnswerHash()
    with file.open("rb") as source:
        return [measure(pickle.load(source), CONFIG, answers, case.area_m2 <= BRUTE_M2) for _ in range(case.plans * case.scans)]


def off(pose: Any, truth: Any) -> float:
    """Return the distance of two positions."""
    return math.hypot(pose.x - truth.x, pose.y - truth.y)


def in_own_processes(case: Case) -> list[dict[str, Any]]:
    """Simulate in one process and localize in another."""
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, __file__, "--case", str(CASES.index(case)), "--scenes", str(Path(folder) / "scenes.pickle")]
        subprocess.run([*command, "--draw"], check=True)
        done = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True)
    measured: list[dict[str, Any]] = json.loads(done.stdout)
    return measured


def milliseconds(rows: list[dict[str, Any]], name: str) -> str:
    """Return the median of a time over the scans."""
    return f"{1e3 * statistics.median(row[name] for row in rows):.1f}"


def line(case: Case, rows: list[dict[str, Any]]) -> Iterator[str]:
    """Yield the cells of a line of the table."""
    nodes = [row["nodes"] for row in rows]
    yield str(case)
    yield str(len(rows))
    yield f"{statistics.fmean(nodes):,.0f} ({min(nodes):,}–{max(nodes):,})"
    yield f"{statistics.fmean(nodes) / case.area_m2:.1f}"
    yield milliseconds(rows, "one_s")
    yield milliseconds(rows, "all_s")
    yield f"{max(row['peak_mb'] for row in rows):.0f} ({rows[0]['before_mb']:.0f})"
    yield ", ".join(f"{count} × {number}" for number, count in sorted(Counter(row["hypotheses"] for row in rows).items()))
    yield f"{sum(row['contained'] for row in rows)} of {len(rows)}"
    yield str(sum(bool(row["limited"]) for row in rows))
    yield rows[-1]["answers"]


def exponent(measured: dict[Case, list[dict[str, Any]]], name: str) -> float:
    """Return the exponent of area with which the mean of a value grows best over `GROWTH` (least squares of the logarithms)."""
    means = [statistics.fmean(row[name] for row in measured[case]) for case in GROWTH]
    return statistics.linear_regression([math.log(case.area_m2) for case in GROWTH], [math.log(mean) for mean in means]).slope


def beside(case: Case, rows: list[dict[str, Any]]) -> Iterator[str]:
    """Yield the cells of a line of the comparison."""
    yield str(case)
    yield f"{statistics.median(row['brute_poses'] for row in rows):,.0f}"
    for times, distance in (("brute_{}_s", "brute_off_m"), ("{}_s", "off_m")):
        yield milliseconds(rows, times.format("one"))
        yield milliseconds(rows, times.format("all"))
        yield f"{statistics.median(row[distance] for row in rows):.2f}, at most {max(row[distance] for row in rows):.2f}"


def main() -> None:
    """Measure, print, and write."""
    parser = options(__doc__ or "")
    parser.add_argument("--case", type=int, metavar="NUMBER", help="run this case alone (used by itself)")
    parser.add_argument("--scenes", type=Path, metavar="FILE", help="where the scenes of the case are (used by itself)")
    parser.add_argument("--draw", action="store_true", help="only simulate them (used by itself)")
    parser.add_argument("--campus", action="store_true", help="only the map of 1 km², which takes minutes and some GB")
    chosen = parser.parse_args()
    if chosen.case is not None and chosen.draw:
        draw(CASES[chosen.case], chosen.scenes)
        return
    if chosen.case is not None:
        print(json.dumps(search(CASES[chosen.case], chosen.scenes)))
        return
    report = Report("Static localization", ABOUT)
    measured: dict[Case, list[dict[str, Any]]] = {}

    def lines() -> Iterator[Iterator[str]]:
        for case in [CAMPUS] if chosen.campus else CASES[:-1]:
            measured[case] = in_own_processes(case)
            yield line(case, measured[case])

    head = "map|scans|nodes|nodes per m²|ms, 1 thread|ms, all threads|memory, MB|scans × hypotheses|truth contained|limited|answers"
    report.table(head.split("|"), lines())
    if chosen.campus:
        report.write(chosen.out)
        return
    report.say(f"From {GROWTH[0]} on, nodes grow as area to the power of **{exponent(measured, 'nodes'):.3f}** (the goal is at most 1.05),")
    report.say(f"and the time on one thread as area to the power of {exponent(measured, 'one_s'):.3f}.\n")
    report.say("Beside it, a brute-force search (`ial.particles.brute_force`) on the same scans. It returns one pose, and no guarantee.\n")
    head = "map|poses tried|brute force: ms, 1 thread|ms, all threads|off by, m|ours: ms, 1 thread|ms, all threads|nearest middle off by, m"
    report.table(head.split("|"), (beside(case, rows) for case, rows in measured.items() if "brute_poses" in rows[0]))
    report.write(chosen.out)


if __name__ == "__main__":
    main()
