"""`ial bounce calibrate`: the smallest bounds of errors that explain a log whose starts are known."""

import shlex
from collections.abc import Iterator, Mapping
from decimal import ROUND_CEILING, Context, Decimal
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ial.cli.bounce.options import Angle, EnvironmentPath, Radius, Resolution, Simplify, number
from ial.cli.shell.options import Json
from ial.cli.shell.terminal import say, say_json, shown

if TYPE_CHECKING:
    from ial.bouncing.calibration import LeastBound

_MARGIN = Fraction(5, 4)  # other runs err more than these
_DIGITS = 2


def calibrate(
    log: Annotated[Path, typer.Argument(metavar="LOG", help="Bumps with times (.csv, .jsonl); starts have x, y and heading.")],
    environment: EnvironmentPath,
    speed: Annotated[str, typer.Option(metavar="M/S", help="How fast the robot drives.")],
    angle: Angle = "90",
    step: Annotated[str, typer.Option(metavar="METRES", help="The step of the filter to build.")] = "1/4",
    radius: Radius = "0",
    turn_time: Annotated[str, typer.Option(metavar="S", help="How long a turn takes.")] = "0",
    clock_error: Annotated[str, typer.Option(metavar="S", help="Bound of the error of the time driven between bumps.")] = "0",
    start_error: Annotated[str, typer.Option(metavar="METRES", help="By how much x and y of a start may be wrong.")] = "0",
    heading_error: Annotated[str, typer.Option(metavar="DEG", help="By how much the heading of a start may be wrong.")] = "0",
    speed_error: Annotated[
        str | None, typer.Option(metavar="PART", help="Bound of the error of the speed for whole runs; the suggested one if left out.")
    ] = None,
    resolution: Resolution = None,
    simplify: Simplify = None,
    as_json: Json = False,
) -> None:
    """Find the bounds of errors for `ial bounce build`: which are refuted by what a robot has reported, and which explain it."""
    from ial.bouncing.bump_timing import BumpTiming
    from ial.bouncing.calibration import STEP_PART, TURN_DEG, Calibration
    from ial.bouncing.known_run import known_runs
    from ial.cli.bounce.log_run import log_events
    from ial.cli.bounce.surroundings import Surroundings

    timing = BumpTiming(number(speed, "--speed"), number(turn_time, "--turn-time"), number(clock_error, "--clock-error"))
    surroundings = Surroundings.read([environment], resolution, simplify, number(radius, "--radius"))
    (loaded,) = surroundings.environments.values()
    tolerances = number(start_error, "--start-error"), number(heading_error, "--heading-error")
    found = Calibration(loaded, number(angle, "--angle"), number(step, "--step"), timing, *tolerances, number(radius, "--radius"))
    with log_events(log) as events:
        runs = known_runs(events, timing)
    steps = found.step_bound(runs)
    suggested_step = _suggested(steps, STEP_PART) if speed_error is None else number(speed_error, "--speed-error")
    turns = found.turn_bound(runs, suggested_step)
    record = {
        "runs": len(runs),
        "bumps": sum(len(run.drives_s) for run in runs),
        "speed_error": _told(steps, suggested_step),
        "turn_error_deg": _told(turns, _suggested(turns, TURN_DEG)),
        "count_error": timing.count_error(found.step_m),
        "step_m": float(found.step_m),
        "build": "",
    }
    given = {"--radius": radius if number(radius, "--radius") else None, "--resolution": resolution, "--simplify": simplify}
    record["build"] = _command(environment, angle, step, given, record)
    if as_json:
        say_json({**record, "simplified": surroundings.record()})
        return
    for line in (*surroundings.lines(), *_lines(record)):
        say(line)


def _suggested(bound: "LeastBound", unit: Fraction) -> Fraction:
    """Return a bound with a margin, rounded up; an error of nothing at all is never suggested."""
    wanted = _MARGIN * max(bound.explained, unit)
    up = Context(prec=_DIGITS, rounding=ROUND_CEILING)
    return Fraction(up.divide(Decimal(wanted.numerator), Decimal(wanted.denominator)))


def _told(bound: "LeastBound", suggested: Fraction) -> dict[str, float | None]:
    refuted = None if bound.refuted is None else float(bound.refuted)
    return {"refuted": refuted, "explained": float(bound.explained), "suggested": float(suggested)}


def _command(environment: Path, angle: str, step: str, given: Mapping[str, str | None], record: Mapping[str, Any]) -> str:
    words = ["ial", "bounce", "build", str(shown(environment)), "--angle", angle, "--step", step]
    words += [word for name, text in given.items() if text is not None for word in (name, text)]
    words += ["--turn-error", f"{record['turn_error_deg']['suggested']:g}", "--step-error", f"{record['speed_error']['suggested']:g}"]
    words += ["--count-error", str(record["count_error"]), "--out", "filter.npz"]
    return shlex.join(words)


def _lines(record: Mapping[str, Any]) -> Iterator[str]:
    """Yield the lines to print."""
    runs, bumps = record["runs"], record["bumps"]
    yield f"{runs} run{'s' * (runs != 1)} from known starts, {bumps} bump{'s' * (bumps != 1)}"
    yield f"speed error, from first legs: {_words(record['speed_error'], '.5f', '')}"
    yield f"turn error, at that speed error: {_words(record['turn_error_deg'], '.3f', '°')}"
    yield f"build with: {record['build']}"
    yield (
        "what is refuted is too small for certain, for turns as long as that speed error holds; what explains these runs may be too small "
        "for others: take long runs, and many"
    )


def _words(bound: Mapping[str, float | None], digits: str, unit: str) -> str:
    refuted = "nothing is refuted" if bound["refuted"] is None else f"refuted up to {bound['refuted']:{digits}}{unit}"
    return f"{refuted}, explained at {bound['explained']:{digits}}{unit}; suggested {bound['suggested']:g}{unit}"
