"""`ial odometer run`: a simulated robot with two odometers is driven until it is localized."""

import math
from decimal import ROUND_UP, Decimal, localcontext
from typing import TYPE_CHECKING, Any

import typer

from ial.cli.bounce.options import Resolution
from ial.cli.odometer.drive import DistanceError, Drive, EnvironmentPath, Seed, StartPose, TurnError
from ial.cli.shell.options import Json
from ial.cli.shell.terminal import say, say_json
from ial.contractors.margins import ABOVE

if TYPE_CHECKING:
    from ial.odometer import Hypothesis, Localization, OdometerRobot

NEVER_LOCALIZED = 3
_MOST_PLACES = 12


def run(
    environment: EnvironmentPath = None,
    start: StartPose = "2,1,70",
    distance_error: DistanceError = "0",
    turn_error: TurnError = "0",
    seed: Seed = 0,
    resolution: Resolution = None,
    as_json: Json = False,
) -> None:
    """Drive a simulated robot that does not know where it starts, and say what it has found out.

    It measures by how much it turns and how far it drives, and nothing else. Rotations of the environment upon itself cannot be told apart.
    """
    drive = Drive(environment, start, distance_error, turn_error, seed, resolution)
    found = drive.localized()
    if as_json:
        say_json(_record(found, drive.robot))
    else:
        for line in _lines(found, drive.robot):
            say(line)
    if found.status in ("ambiguous", "rejected"):
        raise typer.Exit(NEVER_LOCALIZED)


def _record(found: "Localization", robot: "OdometerRobot") -> dict[str, Any]:
    """Return everything as plain values that JSON can hold."""
    narrowest = found.narrowest
    return {
        "status": found.status,
        "candidates": found.candidates,
        "commands": [
            {
                "turn_deg": float(step.command.turn_deg),
                "ahead_m": step.command.ahead_m if math.isfinite(step.command.ahead_m) else None,
                "reading_m": step.reading,
                "hypotheses": step.hypotheses,
                "reason": step.reason,
            }
            for step in found.steps
        ],
        "hypotheses": [_place(each) for each in found.hypotheses],
        "narrowest": None if narrowest is None else _place(narrowest),
        "truth": {"x_m": robot.x, "y_m": robot.y, "heading_deg": robot.heading_deg},
    }


def _place(each: "Hypothesis") -> dict[str, Any]:
    return {
        "environment": each.world,
        "x_m": each.x,
        "y_m": each.y,
        "heading_deg": math.degrees(each.heading_rad) % 360.0,
        "width_m": each.width_m,
        "width_deg": math.degrees(each.width_rad) * ABOVE,
    }


def _lines(found: "Localization", robot: "OdometerRobot") -> list[str]:
    """Return the lines to print."""
    lines = []
    for number, step in enumerate(found.steps, 1):
        left = "" if step.hypotheses is None else f", {_count(step.hypotheses)} left"
        lines.append(f"{number:>3}  {step.command}: came {step.reading:.6g} m{left} ({step.reason})")
    if found.candidates is not None:
        lines.append(f"the first two measured drives left {_count(found.candidates)}")
    count = len(found.hypotheses)
    worlds = len({each.world for each in found.hypotheses})
    lines.append(
        {
            "localized": f"localized with {len(found.steps)} commands:",
            "symmetric": f"localized up to symmetry with {len(found.steps)} commands: no motion can tell these {count} apart:",
            "ambiguous": f"not localized: {_count(count)} left after {len(found.steps)} commands, and no command helps",
            "rejected": "no place of the environment explains the readings: the map or a bound of the errors is wrong",
        }[found.status]
    )
    for each in found.hypotheses[:_MOST_PLACES]:
        place = _place(each)
        where = f"{each.world}: " if worlds > 1 else ""
        lines.append(
            f"     {where}x {each.x:.6g} m, y {each.y:.6g} m, heading {place['heading_deg']:.6g}°; the box around it is "
            f"{_up(each.width_m)} m across and {_up(place['width_deg'])}° wide"
        )
    if count > _MOST_PLACES:
        lines.append(f"     and {count - _MOST_PLACES} more")
    x, y = (round(each, 12) + 0.0 for each in (robot.x, robot.y))  # + 0.0: no negative zero
    lines.append(f"the simulated robot is at x {x:.6g} m, y {y:.6g} m, heading {robot.heading_deg:.6g}°")
    return lines


def _count(number: int) -> str:
    return f"{number} hypothes{'is' if number == 1 else 'es'}"


def _up(width: float) -> str:
    """Return a width with two digits, rounded up."""
    with localcontext() as context:
        context.rounding, context.prec = ROUND_UP, 2
        return f"{float(+Decimal(width)):g}"
