"""The robots that hardly sense anything: sequences of the compass robot, and localizations of the odometer robot, in figures."""

import math
import random
import sys
import time
from collections import Counter
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path
from statistics import median

from report import Report, options

sys.path.append(str(Path(__file__).parents[1]))  # the environments are those of the tests

from ial.compass import CompassRobot, Sequence, localizing_sequence, verify
from ial.compass.primitive import bits
from ial.compass.rounding import rounded_share
from ial.compass.verifier import follow
from ial.errors import MapError
from ial.maps.polygons.polygon import ExactPoint, Polygon
from ial.odometer import OdometerBounds, OdometerModel
from ial.odometer.localization import Session
from ial.odometer.model import Chord
from tests.maps.polygons import known_polygons as known
from tests.maps.polygons.random_polygons import random_polygon, rectilinear_polygon
from tests.odometer import worlds

ABOUT = """\
Compass: sequences are planned, then proved by the verifier, which shares no code with the planner; then robots are driven from many starts
by the verifier's own exact rays. Odometer: simulated robots start at random, at corners, on walls and towards corners; after each command
the set must hold the robot, and at the end be one orbit of the symmetries of the environment. The compilation of kernels is not counted."""


def named() -> dict[str, Polygon]:
    """Return environments of a known form."""
    made = {"square": known.SQUARE, "L": known.L_SHAPE, "spikes": known.SPIKES, "Z (a bitangent)": known.Z_SHAPE}
    made |= {"comb of 4": known.comb(4), "comb of 8": known.comb(8), "irregular comb of 6": known.comb(6, irregular=True)}
    made |= {"serpentine of 6": known.serpentine(6), "columns of 8": rectilinear_polygon(8, 1), "columns of 12": rectilinear_polygon(12, 2)}
    return made


def starts(polygon: Polygon, count: int) -> Iterator[ExactPoint]:
    """Yield all corners, then points on walls and inside."""
    chooser = random.Random(5)
    yield from polygon.outer
    x0, y0, x1, y1 = polygon.bounds
    left = count - len(polygon.outer)
    while left > 0:
        at = chooser.randrange(len(polygon.outer))
        (ax, ay), (bx, by) = polygon.outer[at - 1], polygon.outer[at]
        part = Fraction(chooser.randrange(1, 256), 256)
        inside = tuple(low + Fraction(chooser.randrange(257), 256) * (high - low) for low, high in ((x0, x1), (y0, y1)))
        place = chooser.choice([(ax + part * (bx - ax), ay + part * (by - ay)), inside])
        try:
            CompassRobot(polygon, place)
        except MapError:
            continue  # outside
        left -= 1
        yield place


def planned(polygon: Polygon, order: str) -> tuple[Sequence, float]:
    """Return a proved sequence, and how long the plan took."""
    begun = time.perf_counter()
    sequence = localizing_sequence(polygon, order)  # type: ignore[arg-type]
    took = time.perf_counter() - begun
    verify(sequence)
    return sequence, took


def gathered(sequences: list[Sequence], count: int) -> str:
    """Return from how many starts, so many in each environment, robots end in the one place."""
    ends = [follow(each.polygon, start, each.directions)[-1] == each.end for each in sequences for start in starts(each.polygon, count)]
    return f"{sum(ends):,} of {len(ends):,}"


def compass_rows(count: int) -> Iterator[tuple[object, ...]]:
    """Yield what becomes of environments of a known form."""
    for name, polygon in named().items():
        greedy, took = planned(polygon, "greedy")
        paper, _ = planned(polygon, "paper")
        share = rounded_share(greedy, list(starts(polygon, 40)))
        yield name, len(polygon.outer), len(greedy), len(paper), f"{took:.2f}", gathered([greedy], count), f"{100 * share:.0f} %"


def random_rows(sizes: dict[int, int], count: int) -> Iterator[tuple[object, ...]]:
    """Yield what becomes of random polygons, by the number of their corners."""
    for corners, seeds in sizes.items():
        made = [
            (planned(random_polygon(corners, seed), "greedy"), planned(random_polygon(corners, seed), "paper")) for seed in range(seeds)
        ]
        greedy, paper = ([pair[at] for pair in made] for at in (0, 1))
        steps = [[len(sequence) for sequence, _ in each] for each in (greedy, paper)]
        less = median(1.0 - one / other for one, other in zip(*steps, strict=True))
        widest = max(bits(direction) for sequence, _ in greedy for direction in sequence.directions)
        alike = gathered([sequence for sequence, _ in greedy], count)
        share = median(rounded_share(sequence, list(starts(sequence.polygon, 20))) for sequence, _ in greedy[:3])
        seconds = [took for _, took in greedy]
        yield (
            corners, seeds, f"{median(steps[0]):g} ({min(steps[0])} to {max(steps[0])})", f"{median(steps[1]):g}", f"{100 * less:.0f} %",
            f"{median(seconds):.2f} ({max(seconds):.2f})", widest, alike, f"{100 * share:.0f} %",
        )  # fmt: skip


class OdometerRuns:
    """Runs of robots in many environments.

    Parameters
    ----------
    bounds
        What their odometers may do wrong; None for nothing.
    """

    def __init__(self, bounds: OdometerBounds | None) -> None:
        self.bounds = bounds
        self.environments = dict(worlds.WORLDS)
        self.environments |= {f"random {seed}": random_polygon(6 + seed % 12, seed) for seed in range(30)}
        self.environments |= {f"columns {seed}": rectilinear_polygon(4 + seed % 5, seed) for seed in range(12)}
        if bounds is not None:
            del self.environments["cardan"]  # its curves stay wide
        self.models = {name: OdometerModel(polygon, bounds) for name, polygon in self.environments.items()}
        self.runs = self.checked = self.lost = self.wrong = 0
        self.ends: Counter[str] = Counter()
        self.commands: list[int] = []
        self.seconds: list[float] = []
        self.widths: list[tuple[float, float]] = []

    def until(self, deadline: float, most: int) -> None:
        """Run robots, one in each environment in turn, until a time or a number of runs."""
        seed = 0
        while True:
            seed += 1
            for name, model in self.models.items():
                if time.time() > deadline or self.runs >= most:
                    return
                self._run(name, model, seed)

    def _run(self, name: str, model: OdometerModel, seed: int) -> None:
        robot = worlds.robot(self.environments[name], seed, self.bounds)
        held: list[bool] = []

        def watched(commands: int) -> None:
            states = session.states[name]
            if not isinstance(states, Chord):
                held.append(states.holds(robot.x, robot.y, robot.heading_rad))

        session = Session({name: model}, robot, 60 if self.bounds is None else 30, watched)
        begun = time.perf_counter()
        found = session.run()
        self.seconds.append(time.perf_counter() - begun)
        self.runs += 1
        self.checked += len(held)
        self.lost += not all(held)
        self.ends[found.status] += 1
        self.commands.append(len(found.steps))
        if self.bounds is None:
            self.wrong += found.status in ("ambiguous", "rejected") or len(found.hypotheses) != len(model.symmetries)
        if found.narrowest is not None:
            self.widths.append((found.narrowest.width_m / model.walls.size, math.degrees(found.narrowest.width_rad)))

    def row(self) -> tuple[object, ...]:
        """Return the figures."""
        ends = ", ".join(f"{count:,} {status}" for status, count in self.ends.most_common())
        narrow = (
            f"{100 * median(w for w, _ in self.widths):.2g} % of the map, {median(a for _, a in self.widths):.2g}°" if self.widths else ""
        )
        return (
            "none" if self.bounds is None else "±1 %, ±0.5°", len(self.environments), f"{self.runs:,}", f"{self.checked:,}", self.lost,
            self.wrong if self.bounds is None else "", ends, f"{median(self.commands):g} ({max(self.commands)})",
            f"{1e3 * median(self.seconds):.1f} ({1e3 * max(self.seconds):.0f})", narrow,
        )  # fmt: skip


def speed_rows(runs: int) -> Iterator[tuple[object, ...]]:
    """Yield how long it takes in random polygons, by the number of their corners."""
    for corners in (10, 20, 50):
        candidates, commands, seconds = [], [], []
        for seed in range(runs):
            polygon = random_polygon(corners, 100 + seed)
            model = OdometerModel(polygon, None)
            session = Session({"": model}, worlds.robot(polygon, seed), 60)
            begun = time.perf_counter()
            found = session.run()
            if seed:  # the first one loads kernels
                seconds.append(time.perf_counter() - begun)
                candidates += [] if found.candidates is None else [found.candidates]
                commands.append(len(found.steps))
        yield (
            corners,
            runs - 1,
            f"{median(candidates):g} ({max(candidates)})",
            f"{median(commands):g} ({max(commands)})",
            f"{1e3 * median(seconds):.1f}",
        )


def main() -> None:
    """Measure, print, and write."""
    parser = options(__doc__ or "")
    parser.add_argument("--starts", type=int, default=1_000, metavar="N", help="of the compass robot, in each environment")
    parser.add_argument("--runs", type=int, default=10_000, metavar="N", help="of the odometer robot")
    parser.add_argument("--with-errors", type=int, default=1_000, metavar="N", help="of the odometer robot with errors")
    parser.add_argument("--seconds", type=float, default=3_600.0, metavar="S", help="end either after so long")
    chosen = parser.parse_args()
    report = Report("Robots that hardly sense anything", ABOUT)
    head = ("environment", "corners", "motions", "in the paper's order", "s", "starts that end in one point", "with directions as doubles")
    report.table(head, compass_rows(chosen.starts))
    report.say("Random polygons: the median of several (least and greatest, or greatest); doubles were tried in the first three.\n")
    head = ("corners", "polygons", "motions", "in the paper's order", "fewer", "s", "bits", "starts that end in one point", "with doubles")
    report.table(head, random_rows({10: 18, 30: 12, 50: 12, 100: 5, 200: 3}, chosen.starts))
    report.say("The odometer robot in random polygons.\n")
    report.table(("corners", "runs", "candidates", "commands", "ms"), speed_rows(30))
    report.say("The odometer robot in environments with holes, parallel walls, Cardan triples and symmetries.\n")
    head = (
        "errors",
        "environments",
        "runs",
        "sets checked",
        "runs that lost the truth",
        "wrong ends",
        "ends",
        "commands",
        "ms",
        "narrowest",
    )
    done = []
    for bounds, most in ((None, chosen.runs), (OdometerBounds(0.01, 0.5), chosen.with_errors)):
        runs = OdometerRuns(bounds)
        runs.until(time.time() + chosen.seconds, most)
        done.append(runs.row())
    report.table(head, done)
    report.write(chosen.out)


if __name__ == "__main__":
    main()
