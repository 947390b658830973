"""Answers that are localized and do not hold the reference: what betrays them, and how often the same is said of answers that do."""

import math
import statistics
from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from recordings import RUNS, Run, carmen
from report import Report, options

from ial.lidar.evidence.beams import scan_beams
from ial.lidar.localizer import Localizer
from ial.lidar.run import localize
from ial.lidar.vanishing import leeway
from ial.study.containment import Containment

ABOUT = """\
Every recording with a reference, default configuration, recursive. Only localized scans are looked at: the others are alarms already, or
say themselves that the robot may be elsewhere. A *miss* is an answer that does not hold the reference; a *far* one is off by more than
0.5 m. *False* are flags on answers that hold it. `vanishing` is what ial reports: less volume than the errors of the beams alone leave open
(the leeway); the other lines are what else was thought of. References are wrong themselves now and then."""
FAR_M = 0.5
RECENT, FEWEST = 15, 3  # accepted scans of which medians are taken

FURTHER = [
    carmen("orebro", "orebro-corrected.log.gz"),
    carmen("fhw", "fhw-corrected.log.gz"),
    carmen("acapulco", "acapulco-corrected.log.gz"),
    carmen("infinite_corridor", "infinite-corridor-corrected.log.gz"),
]


@dataclass(frozen=True)
class Answer:
    """What a localized scan has left.

    Parameters
    ----------
    missed, error_m
        Whether the reference is not in it, and how far the pose is from the reference.
    vanishing
        What ial says.
    volume, leeway, cell
        Its volume, that which errors alone leave open, and that of a cell of the precision (m² rad).
    half_width, error
        Half the width of the position, and the errors of range and map together (m).
    outliers, needed, margin, most
        q, the fewest bad beams anywhere in it, `outlier_margin` and `max_outliers` in beams.
    usual_outliers, usual_volume
        Medians of the accepted scans just before; None where they are too few.
    """

    missed: bool
    error_m: float
    vanishing: bool
    volume: float
    leeway: float
    cell: float
    half_width: float
    error: float
    outliers: int
    needed: int
    margin: int
    most: int
    usual_outliers: float | None
    usual_volume: float | None


CRITERIA: list[tuple[str, Callable[[Answer], bool]]] = [
    ("`vanishing`: volume below the leeway", lambda at: at.vanishing),
    ("volume below half the leeway", lambda at: at.volume < 0.5 * at.leeway),
    ("volume below twice the leeway", lambda at: at.volume < 2.0 * at.leeway),
    ("volume below 2 cells of the precision", lambda at: at.volume < 2.0 * at.cell),
    ("half-width below the errors of range and map", lambda at: at.half_width < at.error),
    ("volume below a tenth of the usual", lambda at: at.usual_volume is not None and at.volume < 0.1 * at.usual_volume),
    ("the margin does not fit under the limits", lambda at: at.outliers - at.needed < at.margin),
    ("q above 0.9 of `max_outliers`", lambda at: at.outliers >= 0.9 * at.most),
    ("q above the usual by more than the margin", lambda at: at.usual_outliers is not None and at.outliers > at.usual_outliers + at.margin),
    ("`vanishing`, or the margin does not fit", lambda at: at.vanishing or at.outliers - at.needed < at.margin),
]


def answers(run: Run) -> Iterator[Answer]:
    """Localize a recording; yield its localized scans with a reference."""
    recording, grid, truth = run.open()
    localizer = Localizer(grid)
    bounds = localizer.config.bounds
    cell = float(localizer.model.lattice.widths.prod())
    containment = Containment(localizer, truth, run.frame)
    recent: deque[tuple[int, float]] = deque(maxlen=RECENT)
    for step, estimate in localize(recording, localizer, start=int(run.odd), every=1 + run.odd):
        misses = len(containment.misses)
        containment.add(step, estimate)
        beams = scan_beams(step.scan, localizer.config)
        volume = sum(each.volume for each in estimate.hypotheses)
        usual = [statistics.median(each) for each in zip(*recent, strict=True)] if len(recent) >= FEWEST else [None, None]
        if estimate.status not in ("lost", "blind") and not estimate.uninformative:
            recent.append((estimate.outliers_allowed, volume))
        reference = containment.reference(step)
        if estimate.pose is None or reference is None or estimate.uninformative or estimate.limited:
            continue
        yield Answer(
            missed=len(containment.misses) > misses,
            error_m=math.hypot(estimate.pose.x - reference.x, estimate.pose.y - reference.y),
            vanishing=estimate.vanishing,
            volume=volume,
            leeway=leeway(beams),
            cell=cell,
            half_width=estimate.hypotheses[0].half_widths[0],
            error=bounds.of(step.scan.frame_id).range_error_m + bounds.map_error_m,
            outliers=estimate.outliers_allowed,
            needed=localizer.poses.fewest_bad,
            margin=beams.margin or 0,
            most=beams.outliers,
            usual_outliers=usual[0],
            usual_volume=usual[1],
        )


def cells(name: str, flagged: Callable[[Answer], bool], chosen: list[Answer]) -> Iterator[str]:
    """Yield the cells of a line: misses, far ones, false flags, and how many of the flags are right."""
    misses, held = [at for at in chosen if at.missed], [at for at in chosen if not at.missed]
    far = [at for at in misses if at.error_m > FAR_M]
    caught, false = sum(map(flagged, misses)), sum(map(flagged, held))
    yield name
    yield _share(caught, len(misses))
    yield _share(sum(map(flagged, far)), len(far))
    yield _share(false, len(held))
    yield _share(caught, caught + false)


def _share(part: int, whole: int) -> str:
    return f"{part} of {whole} ({100.0 * part / whole:.1f} %)" if whole else "–"


def main() -> None:
    """Measure, print, and write."""
    parser = options(__doc__ or "")
    parser.add_argument("--only", metavar="TEXT", default="", help="only the recordings whose name holds this")
    chosen = parser.parse_args()
    report = Report("Vanishing answers", ABOUT)
    every: list[Answer] = []

    def lines() -> Iterator[Iterator[str]]:
        for run in [*(run for run in RUNS if not run.static), *FURTHER]:
            if chosen.only in run.name:
                seen = list(answers(run))
                every.extend(seen)
                yield cells(run.name, lambda at: at.vanishing, seen)

    head = ["misses caught", "far ones caught", "false", "right, of the flags"]
    report.say("`vanishing`, by recording:\n")
    report.table(["recording", *head], lines())
    report.say("All of them together:\n")
    report.table(["flagged if", *head], (cells(name, flagged, every) for name, flagged in CRITERIA))
    report.write(chosen.out)


if __name__ == "__main__":
    main()
