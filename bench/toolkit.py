"""The contractor toolkit beside codac 2.1.2: set inversion, systems of equations, localization with outliers, polar coordinates."""

import dataclasses
import math
import sys
from collections.abc import Iterator
from typing import Any

import numpy as np
from codac_process import VERSION, CodacMissingError, codac, install
from formulas import SYSTEMS, System, disc, distance, equations
from report import Report, options
from timing import timed

from ial.contractors import Boxes, Interval, Paving, Polar, Separator, mean_value, pave, relaxed, set_threads, variables
from ial.contractors.expressions import functions
from ial.contractors.threads import available_threads

ABOUT = f"""\
The same problems at the same precision, codac {VERSION} in a process of its own. codac paves in C++, on one thread, called once through
Python; ial on one thread and on all. Each time is the least of up to five runs, kernels compiled beforehand. *Nodes* are boxes contracted;
*error* is the area or volume of the boxes that are neither proved inside nor outside (for a contractor alone: of all boxes, less that of
the set where it is known). Where codac can use its centred form, both ways are measured; beside it stands `mean_value`."""
PRECISIONS = {"test": (0.1, 0.01, 0.001), "separator": (0.01, 1e-3, 1e-4, 1e-5), "contractor": (0.1, 0.01, 0.003)}
FORMS = {"test": "sivia", "separator": "SepInverse", "contractor": "CtcInverse"}
BEACONS, WRONG, RANGE_ERROR_M, FIELD_M = 15, 3, 0.5, 50.0
POLAR_BOXES = 20_000


@dataclasses.dataclass(frozen=True)
class Result:
    """How long a paving took, and what it is like."""

    seconds: float
    nodes: int
    boxes: int
    error: float

    @property
    def speed(self) -> float:
        """Nodes per second."""
        return self.nodes / self.seconds


def volume(boxes: Boxes) -> float:
    """Return the sum of the volumes of some boxes, to a few digits."""
    return float((boxes.upper - boxes.lower).prod(axis=1).sum())


def ours(constraint: Any, start: Boxes, precision: float, known: float = 0.0) -> Result:
    """Pave with ial; the error is less what is known to be the volume of the set."""
    pave(constraint, start, precision)  # compiles what is not compiled yet
    elapsed, paving = timed(lambda: pave(constraint, start, precision, max_boxes=100_000_000))
    assert isinstance(paving, Paving)
    return Result(elapsed, paving.nodes, len(paving.boundary), volume(paving.boundary) - known)


def theirs(task: str, known: float = 0.0, **arguments: Any) -> Result:
    """Pave with codac."""
    answer = codac(task, **arguments)
    return Result(answer["seconds"], answer["nodes"], answer["boxes"], answer["volume"] - known)


def on_threads(constraint: Any, start: Boxes, precision: float, known: float = 0.0) -> tuple[Result, Result]:
    """Pave on one thread and on all."""
    results = []
    for count in (1, None):
        set_threads(count)
        results.append(ours(constraint, start, precision, known))
    return results[0], results[1]


HEAD = [
    "codac: nodes",
    "s",
    "nodes/s",
    "error",
    "ial: nodes",
    "s, 1 thread",
    "s, all",
    "nodes/s, best",
    "error",
    "nodes/s: ratio",
    "time: ratio",
]


def beside(other: Result, one: Result, every: Result) -> Iterator[str]:
    """Yield the cells under `HEAD`; the ratios take the faster of one thread and all."""
    best = min(one, every, key=lambda result: result.seconds)
    yield f"{other.nodes:,}"
    yield f"{other.seconds:.2g}"
    yield f"{other.speed:,.0f}"
    yield f"{other.error:.2g}"
    yield f"{every.nodes:,}"
    yield f"{one.seconds:.2g}"
    yield f"{every.seconds:.2g}"
    yield f"{best.speed:,.0f}"
    yield f"{every.error:.2g}"
    yield f"**{best.speed / other.speed:.1f}**"
    yield f"{other.seconds / best.seconds:.1f}"


def around_error(constraint: Any, start: Boxes, precision: float, known: float, error: float) -> tuple[Result, Result]:
    """Return ial's results at two neighbouring precisions, the error of one of them at least, of the other below a given one.

    Halving makes the error a staircase, of 1/16 octave in the precision here.
    """
    coarse: Result | None = None
    for factor in 2.0 ** np.arange(2.0, -2.0, -1 / 16):
        paving = pave(constraint, start, factor * precision, max_boxes=100_000_000)
        fine = Result(0.0, paving.nodes, len(paving.boundary), volume(paving.boundary) - known)
        if fine.error < error and coarse is not None:
            return coarse, dataclasses.replace(fine, seconds=ours(constraint, start, factor * precision, known).seconds)
        coarse = fine
    raise RuntimeError(f"no precision near {precision} brings an error of {error}")


def rings(report: Report) -> None:
    """Invert x² + y² ∈ [1, 2] on [−3, 3]²."""
    x = variables("x[2]")
    constraint = disc(functions, x) == Interval(1, 2)
    start = Boxes.of([(-3, 3)] * 2)
    results: list[tuple[str, float, Any, float, Result]] = []

    def lines() -> Iterator[list[str]]:
        for form, precisions in PRECISIONS.items():
            known = math.pi if form == "contractor" else 0.0
            own = constraint if form == "contractor" else Separator.of(constraint)
            for precision in precisions:
                ways = (True,) if form == "test" else (False, True)
                other = min(
                    (theirs("ring", known, form=form, centred=way, precision=precision) for way in ways), key=lambda way: way.seconds
                )
                results.append((FORMS[form], precision, own, known, other))
                yield [FORMS[form], f"{precision:g}", *beside(other, *on_threads(own, start, precision, known))]

    report.say("## x² + y² ∈ [1, 2]\n\nThe faster of codac's two forms, with and without its centred form.\n")
    report.table(("codac's form", "precision", *HEAD), lines())
    report.say(
        "At the same area error: as the precision becomes finer, nodes and error of ial move in steps; given are the last step at or above "
        "codac's error and the first below. *nodes: ratio* interpolates between them (in logarithms), *at most* takes the latter.\n"
    )

    def equals() -> Iterator[list[str]]:
        for form, precision, own, known, other in results:
            above, below = around_error(own, start, precision, known, other.error)
            nodes = np.interp(-math.log(other.error), [-math.log(above.error), -math.log(below.error)], np.log([above.nodes, below.nodes]))
            steps = [text for step in (above, below) for text in (f"{step.error:.3g}", f"{step.nodes:,}")]
            ratios = [math.exp(nodes) / other.nodes, below.nodes / other.nodes, other.seconds / below.seconds]
            cells = [f"{other.error:.3g}", f"{other.nodes:,}", *steps]
            yield [form, f"{precision:g}", *cells, f"**{ratios[0]:.2f}**", f"{ratios[1]:.2f}", f"{ratios[2]:.1f}"]

    head = "codac's form|precision|codac: error|nodes|ial: error|nodes|error below|nodes|nodes: ratio|at most|time: ratio"
    report.table(head.split("|"), equals())


def systems(report: Report) -> None:
    """Pave the solutions of systems of equations by forward–backward contraction."""
    report.say("## Systems of equations\n")

    def lines() -> Iterator[list[str]]:
        for system in SYSTEMS:
            for centred in (False, True):
                other = theirs("system", **dataclasses.asdict(system), centred=centred)
                one, every = on_threads(contractor(system, centred), Boxes.of([system.side] * system.dimension), system.precision)
                form = "centred" if centred else "HC4"
                yield [f"{system.name}, {system.dimension}-D", form, f"{system.precision:g}", *beside(other, one, every)]

    report.table(("system", "form", "precision", *HEAD), lines())


def contractor(system: System, centred: bool) -> Any:
    """Return a system's equations as one constraint."""
    x = variables(f"x[{system.dimension}]")
    first, *others = (left == 0.0 for left in equations(system.name, functions, x))
    for other in others:
        first = first & other
    return mean_value(first) if centred else first


def localization(report: Report) -> None:
    """Localize from ranges to beacons, of which some are wrong."""
    rng = np.random.default_rng(1)
    places = rng.uniform(-FIELD_M, FIELD_M, (BEACONS, 2))
    truth = np.array([12.0, -7.0])
    reading = np.hypot(*(places - truth).T) + rng.uniform(-RANGE_ERROR_M, RANGE_ERROR_M, BEACONS)
    reading[:WRONG] += rng.uniform(5.0, 20.0, WRONG)
    low, high = reading - RANGE_ERROR_M, reading + RANGE_ERROR_M
    x = variables("x[2]")
    family = distance(functions, x, places.T) == Boxes(low[:, None], high[:, None])
    start = Boxes.of([(-FIELD_M, FIELD_M)] * 2)
    report.say(
        f"## {BEACONS} beacons, {WRONG} of them wrong\n\nRanges within ±{RANGE_ERROR_M} m; `CtcQInter` of `CtcInverse` beside `relaxed`.\n"
    )

    def lines() -> Iterator[list[str]]:
        arguments = {"places": places.tolist(), "ranges": np.stack([low, high], axis=1).tolist(), "outliers": WRONG}
        for precision in (0.1, 0.01, 0.001):
            ways = [theirs("beacons", **arguments, side=[-FIELD_M, FIELD_M], precision=precision, centred=way) for way in (False, True)]
            other = min(ways, key=lambda way: way.seconds)
            yield [f"{precision:g} m", *beside(other, *on_threads(relaxed([family], outliers=WRONG), start, precision))]

    report.table(("precision", *HEAD), lines())


def polar(report: Report) -> None:
    """Contract boxes by the equations of polar coordinates."""
    rng = np.random.default_rng(2)
    angle, length = rng.uniform(-math.pi, math.pi, POLAR_BOXES), rng.uniform(0.1, 10.0, POLAR_BOXES)
    points = np.stack([length * np.cos(angle), length * np.sin(angle), length, angle], axis=1)
    boxes = Boxes(points - rng.uniform(0.0, 1.0, points.shape), points + rng.uniform(0.0, 1.0, points.shape))
    answer = codac("polar", boxes=np.stack([boxes.lower, boxes.upper], axis=2).tolist())
    contract = Polar().contract
    contract(boxes)
    seconds = []
    for count in (1, None):
        set_threads(count)
        elapsed, narrowed = timed(lambda: contract(boxes))
        seconds.append(elapsed)
    other = np.array([[[math.nan] * 2] * 4 if row is None else row for row in answer["boxes"]])
    widths, wider = narrowed.width(), other[..., 1] - other[..., 0]
    each = [1e9 * elapsed / POLAR_BOXES for elapsed in (answer["seconds"], *seconds)]
    report.say("## Polar coordinates\n\nOne call for each box is all that codac's Python offers; the time holds the cost of the call.\n")
    head = ("boxes", "codac, ns a box", "ial, ns a box, 1 thread", "all", "ratio", "empty: codac", "ial", "summed widths, ial / codac")
    cells = [f"{POLAR_BOXES:,}", *(f"{time:,.0f}" for time in each), f"**{each[0] / each[2]:.0f}**"]
    both = ~np.isnan(wider).any(axis=1) & ~narrowed.empty
    cells += [f"{np.isnan(wider).any(axis=1).sum():,}", f"{narrowed.empty.sum():,}", f"{widths[both].sum() / wider[both].sum():.6f}"]
    report.table(head, [cells])


def main() -> None:
    """Measure, print, and write."""
    chosen = options(__doc__ or "").parse_args()
    try:
        install()
        report = Report(f"Beside codac {VERSION}", ABOUT)
        report.say(f"ial on {available_threads()} threads at most.\n")
        for part in (rings, systems, localization, polar):
            part(report)
    except CodacMissingError as error:
        sys.exit(str(error))
    report.write(chosen.out)


if __name__ == "__main__":
    main()
