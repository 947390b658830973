"""Robots with real geometry in random environments: how often is one outside of a set of the ray mode? It must never be."""

import sys
from collections.abc import Callable, Iterator
from pathlib import Path

from report import Report, options
from timing import timed

sys.path.append(str(Path(__file__).parents[1]))  # the robots are those of the tests

from tests.bouncing import disk_truth, piece_truth
from tests.bouncing.truth import Run, follow

ABOUT = """\
Each run draws an environment (stars with holes, small grids whose holes and corners touch), a bouncing angle, a step, bounds of errors, a
bound on the size of sets and what is known at the start; then a simulated robot drives there for six legs, and its errors are at their
bounds every other time. After every bump, and at one step of every leg, the set of the ray mode must hold it, compared exactly."""


def rows(follow: Callable[[int], Run], count: int, each: int) -> Iterator[tuple[str, ...]]:
    """Yield what became of runs, so many for each row, and of all of them."""
    total, all_seconds, all_runs = 0, 0.0, 0
    for begin in range(0, count, each):
        seeds = range(begin, min(begin + each, count))
        seconds, runs = timed(lambda seeds=seeds: [follow(seed) for seed in seeds], runs=1)
        lost = sum(run.losses for run in runs)
        total, all_seconds, all_runs = total + lost, all_seconds + seconds, all_runs + len(runs)
        yield f"{seeds[0]} to {seeds[-1]}", *_figures(runs), f"{seconds:.0f}", str(lost)
    yield f"all {all_runs}", "", "", "", f"{all_seconds:.0f}", str(total)


def _figures(runs: list[Run]) -> tuple[str, str, str]:
    left = sorted(run.left for run in runs)
    return str(sum(run.legs for run in runs)), str(max(run.pieces for run in runs)), f"{left[len(left) // 2]:.1e}"


def main() -> None:
    """Measure, print, and write."""
    parser = options(__doc__ or "")
    parser.add_argument("--runs", type=int, default=10_000, metavar="N", help="how many robots")
    parser.add_argument("--disks", type=int, default=2_000, metavar="N", help="how many disks")
    chosen = parser.parse_args()
    report = Report("A bouncing robot is never outside of its set", ABOUT)
    head = ("seeds", "legs", "pieces at most", "median of what is left of the set", "s", "losses")
    report.table(head, rows(follow, chosen.runs, 1000))
    report.say("The same on fixed grids of pieces of walls (`PieceMap`), for twelve legs each, compared after every bump.\n")
    report.table(head, rows(piece_truth.follow, chosen.runs, 1000))
    report.say("Disks, in the same environments; every third starts on a lattice, in a multiple of 45°.\n")
    report.table(head, rows(disk_truth.follow, chosen.disks, 500))
    report.say("Disks on fixed grids.\n")
    report.table(head, rows(disk_truth.follow_pieces, chosen.disks, 500))
    report.write(chosen.out)


if __name__ == "__main__":
    main()
