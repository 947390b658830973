"""Static localization on maps of growing size: nodes, time, memory; and a brute-force likelihood search beside it on the same scans."""

import json
import math
import resource
import statistics
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from typing import Any

from report import Report, options  # the process that starts the cases stays small: a child's peak memory counts from its parent's

CASES = [(10.0, 4.7, 0.02), (10.0, 10.0, 0.05), (50.0, 50.0, 0.05), (100.0, 100.0, 0.05), (400.0, 400.0, 0.05)]
GROWTH = CASES[2:]  # the maps from which the exponent is taken
SCANS = 5
SLOW_S = 1.0  # what takes longer than this is timed once
ABOUT = (
    "One scan of 180 beams all around, up to 10 % of them wrong, no prior: every pose on the whole map. Floor plans of `ial.maps.floor_plan`; "
    f"{SCANS} scans at random places each, medians over the scans. Bounds: `range_error_m` 0.05 and no other, 18 outliers, default precision; "
    "simulated errors are uniform within these bounds. Each map runs in a process of its own, kernels compiled beforehand. *Memory* is the "
    "peak of that process (`getrusage`), in brackets the part that was there before the first search: Python, the map and its tables."
)


def case_name(width: float, height: float, resolution: float) -> str:
    """Return how a case is called."""
    return f"{width:g} × {height:g} m, {100.0 * resolution:g} cm"


def peak_mb() -> float:
    """Return the largest memory this process ever had, MB."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / (1024.0 if sys.platform != "darwin" else 1024.0**2)


def timed(work: Callable[[], Any]) -> tuple[float, Any]:
    """Return the least time of three runs, or that of one if it is slow, in seconds; and the result."""
    times: list[float] = []
    while len(times) < 3 and sum(times) < SLOW_S:
        begun = time.perf_counter()
        result = work()
        times.append(time.perf_counter() - begun)
    return min(times), result


def run_case(width: float, height: float, resolution: float) -> dict[str, Any]:
    """Localize and return what was measured, as plain values: one list entry for each scan."""
    from ial.contractors.threads import available_threads, set_threads
    from ial.lidar.config import Bounds, LocalizerConfig
    from ial.lidar.localizer import Localizer
    from ial.particles.brute_force import BruteForce
    from plans import OUTLIERS, RANGE_ERROR_M, plan_and_scans

    config = LocalizerConfig(bounds=Bounds(RANGE_ERROR_M, 0.0, 0.0), outliers=OUTLIERS)
    small, scans, _ = plan_and_scans(6.0, 6.0, 0.05, 1)
    Localizer(small, config=config).locate(scans[0])  # loads the kernels
    BruteForce(small).locate(scans[0])

    grid, scans, truths = plan_and_scans(width, height, resolution, SCANS)
    localizer = Localizer(grid, config=config)
    brute = BruteForce(grid) if width * height <= 100.0 else None
    found: dict[str, Any] = {"before_mb": peak_mb(), "threads": available_threads(), "scans": []}
    for scan, truth in zip(scans, truths, strict=True):
        row: dict[str, Any] = {}
        for name, threads in (("one", 1), ("all", None)):
            set_threads(threads)
            row[f"{name}_s"], estimate = timed(lambda scan=scan: localizer.locate(scan))
            row["peak_mb"] = peak_mb()
            if brute is not None:
                row[f"brute_{name}_s"], match = timed(lambda scan=scan: brute.locate(scan))
        row |= {"nodes": estimate.poses.nodes, "hypotheses": len(estimate.hypotheses), "limited": estimate.limited}
        row["contained"] = estimate.poses.contains(grid.pose_to_grid(truth))
        row["best_off_m"] = min(math.hypot(each.centre.x - truth.x, each.centre.y - truth.y) for each in estimate.hypotheses)
        if brute is not None:
            row |= {"brute_poses": match.poses, "brute_off_m": math.hypot(match.best.pose.x - truth.x, match.best.pose.y - truth.y)}
        found["scans"].append(row)
    return found


def in_own_process(case: tuple[float, float, float]) -> dict[str, Any]:
    """Run a case in a process of its own."""
    done = subprocess.run([sys.executable, __file__, "--case", *map(str, case)], stdout=subprocess.PIPE, text=True, check=True)
    measured: dict[str, Any] = json.loads(done.stdout)
    return measured


def median(found: dict[str, Any], name: str) -> float:
    """Return the median of a value over the scans."""
    return statistics.median(row[name] for row in found["scans"])


def row_of(case: tuple[float, float, float], found: dict[str, Any]) -> Iterator[str]:
    """Yield the cells of a line of the table."""
    scans = found["scans"]
    yield case_name(*case)
    yield f"{median(found, 'nodes'):,.0f}"
    yield f"{1e3 * median(found, 'one_s'):.1f}"
    yield f"{1e3 * median(found, 'all_s'):.1f}"
    yield f"{max(row['peak_mb'] for row in scans):.0f} ({found['before_mb']:.0f})"
    yield ", ".join(str(row["hypotheses"]) for row in scans)
    yield f"{sum(row['contained'] for row in scans)} of {len(scans)}"
    yield ", ".join(sorted({row["limited"] or "no" for row in scans}))


def slope(points: list[tuple[float, float]]) -> float:
    """Return the exponent p of the power law y = c·xᵖ that fits points best (least squares of the logarithms)."""
    return statistics.linear_regression([math.log(x) for x, _ in points], [math.log(y) for _, y in points]).slope


def main() -> None:
    """Measure, print, and write."""
    parser = options(__doc__ or "")
    parser.add_argument("--case", nargs=3, type=float, metavar=("WIDTH", "HEIGHT", "RESOLUTION"), help="one case, as JSON (used by itself)")
    chosen = parser.parse_args()
    if chosen.case:
        print(json.dumps(run_case(*chosen.case)))
        return
    report = Report("Static localization", ABOUT)
    found: dict[tuple[float, float, float], dict[str, Any]] = {}

    def rows() -> Iterator[Iterator[str]]:
        for case in CASES:
            found[case] = in_own_process(case)
            yield row_of(case, found[case])

    head = ("map", "nodes", "ms, 1 thread", "ms, all threads", "memory, MB", "hypotheses of each scan", "truth contained", "limited")
    report.table(head, rows())
    for what in ("nodes", "one_s"):
        exponent = slope([(case[0] * case[1], statistics.fmean(row[what] for row in found[case]["scans"])) for case in GROWTH])
        words = {"nodes": "Nodes (the goal is an exponent of at most 1.05)", "one_s": "Time on one thread"}[what]
        report.say(f"{words} grows as area to the power of **{exponent:.3f}** over the maps from {case_name(*GROWTH[0])} on.\n")
    report.say("Beside it, a brute-force search (`ial.particles.brute_force`) on the same scans. It returns one pose, and no guarantee.\n")
    small = {case: each for case, each in found.items() if "brute_one_s" in each["scans"][0]}
    report.table(
        ("map", "poses tried", "brute force: ms, 1 thread", "ms, all", "off by, m", "ours: ms, 1 thread", "ms, all", "nearest hypothesis' middle off by, m"),
        (
            (
                case_name(*case),
                f"{median(each, 'brute_poses'):,.0f}",
                *(f"{1e3 * median(each, name):.1f}" for name in ("brute_one_s", "brute_all_s")),
                f"{median(each, 'brute_off_m'):.2f}, at most {max(row['brute_off_m'] for row in each['scans']):.2f}",
                *(f"{1e3 * median(each, name):.1f}" for name in ("one_s", "all_s")),
                f"{median(each, 'best_off_m'):.2f}, at most {max(row['best_off_m'] for row in each['scans']):.2f}",
            )
            for case, each in small.items()
        ),
    )
    report.write(chosen.out)


if __name__ == "__main__":
    main()
