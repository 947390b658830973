"""Memory, time and outcomes of filters for a bouncing robot beside a particle filter: the paper's table III with numbers."""

import shutil
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from bouncing_followed import ERRS, GOAL_M, HALL, KEEPS, Box, Followed, Robot, filters
from report import Report, options

from ial.bouncing.exports.c_source import c_header
from ial.bouncing.exports.c_tables import CTables
from ial.bouncing.exports.exported_filter import ExportedFilter
from ial.bouncing.exports.piece_source import PieceTables, c_piece_header
from ial.bouncing.filters.bounce_filter import BounceFilter
from ial.bouncing.filters.building import build_filter
from ial.bouncing.rays.piece_map import PieceMap
from ial.bouncing.rays.piece_model import PieceModel
from ial.bouncing.rays.real_robot import RealPose, RealRobot
from tests.bouncing.judged_runs import robots

ABOUT = """\
Table III of Alam et al. 2017 gives marks from ++ to − for memory, time and robustness. Here the same filters follow the same streams of the
same simulated robots. *State* is what changes with each observation, at most over all runs, in bytes; *map* is what does not, as arrays or
as tables of the C header. Times are per observation, as multiples of that of the exact filter's table in Python, in one process.

A filter makes a *claim* at each bump after which it says that the robot is localized: the exact one by its knowledge cycles, the others
when what they hold fits into a square of 1 m. A run is *wrong* if the robot was once more than 1 m away from what was claimed, else
*outside* if it was once not in it (by more than 1 mm), else *gone* if nothing was left, which is called lost for particles and a rejection
for sets, else *right* if there was a claim."""

WORDS = ("right", "outside", "wrong", "gone", "no claim")
TOUCH_M = 1e-3
TIMED = 20  # so many runs are timed


def runs(robot: Robot, exact: BounceFilter, count: int, legs: int) -> list[list[RealPose]]:
    """Return the poses of simulated robots after each observation."""
    if robot.from_centres:
        simulated = list(robots(HALL, exact, count))
    else:
        simulated = [RealRobot(HALL, robot.angle, robot.step, robot.radius, robot.bounds, seed) for seed in range(count)]
    return [[pose for _ in range(legs) for pose in each.leg()] for each in simulated]


def outcome(followed: Followed, seed: int, poses: list[RealPose]) -> tuple[str, int]:
    """Follow a run; return what became of it, and how many observations were taken until nothing was left, or all."""
    followed.start(seed)
    farthest, claims, taken = 0.0, 0, 0
    for pose in poses:
        taken += 1
        followed.update(pose.observation)
        if followed.gone():
            break
        if pose.observation:
            boxes = followed.claim()
            claims += bool(boxes)
            farthest = max(farthest, min((away(box, float(pose.x_m), float(pose.y_m)) for box in boxes), default=0.0))
    if farthest > GOAL_M:
        return "wrong", taken
    if farthest > TOUCH_M:
        return "outside", taken
    return "gone" if followed.gone() else "right" if claims else "no claim", taken


def seconds_each(followed: Followed, observations: list[list[int]]) -> float:
    """Return the seconds that an observation takes, in the best of three passes."""
    passes = []
    for _ in range(3):
        spent = 0.0
        for seed, stream in enumerate(observations):
            followed.start(seed)
            begun = time.perf_counter()
            for observation in stream:
                followed.update(observation)
            spent += time.perf_counter() - begun
        passes.append(spent)
    return min(passes) / sum(map(len, observations))


def away(box: Box, x: float, y: float) -> float:
    """Return how far a place is from a rectangle."""
    return float(np.hypot(max(box[0] - x, 0.0, x - box[2]), max(box[1] - y, 0.0, y - box[3])))


REPLAY = """\
#include <stdio.h>
#include <time.h>
#include "filter.h"
static unsigned char seen[1 << 24];
int main(void) {
    const size_t count = fread(seen, 1, sizeof seen, stdin);
    struct timespec begun, ended;
    size_t i, k;
    double least = 1e9;
    for (k = 0; k < 5; k++) {
        %(declared)s
        double seconds;
        clock_gettime(CLOCK_MONOTONIC, &begun);
        for (i = 0; i < count; i++) {
            if (seen[i] == 2) { if (k == 4) printf("%%lu\\n", (unsigned long)%(told)s); %(start)s; } else { %(update)s; }
        }
        clock_gettime(CLOCK_MONOTONIC, &ended);
        seconds = (double)(ended.tv_sec - begun.tv_sec) + 1e-9 * (double)(ended.tv_nsec - begun.tv_nsec);
        least = seconds < least ? seconds : least;
    }
    fprintf(stderr, "%%.9f", least);
    return 0;
}
"""
TABLE = {"declared": "bounce_state s = BOUNCE_START;", "start": "s = BOUNCE_START", "update": "s = bounce_step(s, seen[i])", "told": "s"}
PIECES = {
    "declared": "static bounce_filter f; bounce_start(&f);",
    "start": "bounce_start(&f)",
    "update": "bounce_update(&f, seen[i])",
    "told": "bounce_count(&f)",
}


def times(ratio: float) -> str:
    """Return a ratio with two digits."""
    return f"{float(f'{ratio:.2g}'):,.0f}" if ratio >= 10.0 else f"{ratio:.2g}"


def in_c(header: str, how: dict[str, str], every: list[list[RealPose]]) -> tuple[list[int], float]:
    """Return what a C header tells after each run, and the seconds that all runs took."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "filter.h").write_text(header)
        (folder / "replay.c").write_text(REPLAY % how)
        subprocess.run(["gcc", "-std=gnu99", "-O2", "replay.c", "-o", "replay"], cwd=folder, check=True)
        stream = b"".join(bytes([*(pose.observation for pose in poses), 2]) for poses in every)
        done = subprocess.run([folder / "replay"], input=stream, capture_output=True, check=True)
    return [int(each) for each in done.stdout.split()], float(done.stderr)


def rows(robot: Robot, count: int, legs: int, counts: list[int]) -> Iterator[tuple[str, ...]]:
    """Yield a row for each filter."""
    exact = build_filter({"hall": HALL}, robot.lattice, robot.cell, robot.radius)
    pieces = PieceMap.of(HALL, robot.angle, robot.step, robot.bounds, robot.part, robot.piece_headings, robot.radius)
    every = runs(robot, exact, count, legs)
    observations = sum(map(len, every))
    unit = 0.0
    for followed in filters(robot, exact, pieces, counts):
        found = [outcome(followed, seed, poses) for seed, poses in enumerate(every)]
        # What is gone takes no more observations; what is timed has been compiled.
        streams = [[pose.observation for pose in poses[:taken]] for poses, (_, taken) in zip(every[:TIMED], found, strict=False)]
        per = seconds_each(followed, streams)
        unit = unit or per
        words = Counter(word for word, _ in found)
        told = ["–"] * len(WORDS) if followed.name == "`BouncingModel`" else [str(words[word]) for word in WORDS]
        yield followed.name, f"{followed.state_bytes:,}", f"{followed.map_bytes:,}", times(per / unit), *told
    tables = PieceTables.of(pieces, "bounce")
    memory = f"{tables.ram_bytes:,}", f"{tables.flash_bytes:,}"
    held = CTables.of(ExportedFilter.of(exact), "bounce")
    expected = [exact.table.run([pose.observation for pose in poses])[-1] for poses in every]
    states, seconds = in_c(c_header(ExportedFilter.of(exact), "bounce"), TABLE, every)
    if states != expected:
        raise AssertionError("the exact filter in C ends in other states")
    yield (
        "exact filter, C header",
        f"{held.ram_bytes:,}",
        f"{held.flash_bytes:,}",
        times(seconds / observations / unit),
        *["–"] * len(WORDS),
    )
    model = PieceModel(pieces)
    left = []
    for poses in every:
        states_ = model.universe()
        for pose in poses:
            states_ = model.step(states_, None, pose.observation)
        left.append(len(states_))
    counts_, seconds = in_c(c_piece_header(pieces, "bounce"), PIECES, every)
    if counts_ != left:
        raise AssertionError("the set filter in C ends with other sets")
    yield "`PieceModel`, C header", *memory, times(seconds / observations / unit), *["–"] * len(WORDS)


def main() -> None:
    """Measure, print, and write."""
    parser = options(__doc__ or "")
    parser.add_argument("--runs", type=int, default=100, metavar="N", help="how many robots of each kind")
    parser.add_argument("--legs", type=int, default=30, metavar="N", help="how many bumps of each")
    parser.add_argument("--particles", type=int, nargs="+", default=[1_000, 10_000, 100_000], metavar="N", help="how many particles")
    chosen = parser.parse_args()
    if shutil.which("gcc") is None:
        sys.exit("gcc is needed; install it")
    report = Report("Filters of a bouncing robot beside a particle filter", ABOUT)
    for robot in (KEEPS, ERRS):
        report.say(f"{robot.name}. {chosen.runs} runs of {chosen.legs} bumps in the hall of 9 m × 7 m.\n")
        head = ("filter", "state, B", "map, B", "time", *WORDS)
        report.table(head, rows(robot, chosen.runs, chosen.legs, chosen.particles))
    report.write(chosen.out)


if __name__ == "__main__":
    main()
