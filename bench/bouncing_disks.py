"""What filters say about disks and points: the exact one, and the one with bounds of errors."""

import sys
from collections import Counter
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path

from report import Report, options

sys.path.append(str(Path(__file__).parents[1]))  # the robots are those of the tests

from ial.bouncing.cells.headings import Headings
from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.filters.building import build_filter
from ial.errors import MapError
from tests.bouncing.disk_truth import TEN_WORLDS, filter_of, judge
from tests.bouncing.judged_runs import OUTCOMES, WORLDS, judged, robots

ABOUT = """\
Four rooms on a lattice of 1 m. Filters are made as `ial bounce build` makes them, with cells of 1 m; a simulated robot of the same kind
drives 300 steps. *Right* is a robot that is localized in the end and was in one of the told places at each moment since; *wrong* is one
that was once told to be where it was not."""

BOUNDED = ("lost", "wrong", "localized", "not localized")
RADII = (Fraction(1, 5), Fraction(2, 5))
DISK, POINT = Fraction(1, 2), Fraction(0)
SOME = ExecutionBounds(Fraction(1), Fraction(1, 50), 0)
KINDS = {
    "disk as wide as a cell, 90°, from centres of cells": (90, DISK, "centre", {}),
    "the same, with `--rule inside`": (90, DISK, "inside", {}),
    "the same disk, 45°": (45, DISK, "centre", {}),
    "the same disk, 90°, from anywhere in any heading": (90, DISK, "centre", {"anywhere": True}),
    "the same disk, 90°, turns ± 1°, steps ± 2 %": (90, DISK, "centre", {"bounds": SOME}),
    "disk of 0.3 m, 90°": (90, Fraction(3, 10), "centre", {}),
    "point, 90°": (90, POINT, "centre", {}),
    "point, 90°, from anywhere in any heading": (90, POINT, "centre", {"anywhere": True}),
}


def rows(count: int) -> Iterator[tuple[str, ...]]:
    """Yield, for each kind of robot, what became of it in each world."""
    for name, (angle, radius, rule, how) in KINDS.items():
        shown = []
        for world, environment in WORLDS.items():
            try:
                made = build_filter({world: environment}, Headings.of_angle(Fraction(angle)), Fraction(1), radius, rule)
            except MapError:
                shown.append("no cell is free")
                continue
            outcomes = judged(made, robots(environment, made, count, **how))
            shown.append(" / ".join(str(outcomes[each]) for each in OUTCOMES))
        yield name, *shown


def bounded(count: int) -> Iterator[tuple[str, ...]]:
    """Yield, for each of ten worlds, what became of disks with errors at their bounds."""
    total: Counter[str] = Counter()
    for world in TEN_WORLDS:
        for radius in RADII:
            made = filter_of(world, radius)
            outcomes = Counter(judge(made, seed) for seed in range(count))
            total += outcomes
            yield world, f"{float(radius):g}", str(len(made.map)), *(str(outcomes[each]) for each in BOUNDED)
    yield "all", "", "", *(str(total[each]) for each in BOUNDED)


def main() -> None:
    """Measure, print, and write."""
    parser = options(__doc__ or "")
    parser.add_argument("--robots", type=int, default=100, metavar="N", help="how many robots of each kind in each world")
    parser.add_argument("--bounded", type=int, default=500, metavar="N", help="how many with errors of each radius in each of ten worlds")
    chosen = parser.parse_args()
    report = Report("The exact filter and robots with real geometry", ABOUT)
    report.table((f"{chosen.robots} robots: {' / '.join(OUTCOMES)}", *WORLDS), rows(chosen.robots))
    report.say(
        "The filter with bounds of errors (`PieceFilter`; 100° ± 2°, steps of 1/4 m ± 2 %, counts ± 1; parts of 1/4 m, 72 headings), and "
        "disks that are at their bounds every other time, for 30 legs each. *Lost* is one that was once outside of its set, *wrong* one "
        "that was once told to be where it was not; of a *localized* one the place was once known to 2 m.\n"
    )
    report.table(("world", "radius, m", "pieces", *BOUNDED), bounded(chosen.bounded))
    report.write(chosen.out)


if __name__ == "__main__":
    main()
