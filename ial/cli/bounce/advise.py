"""`ial bounce advise`: what filters of a robot come to, and which to build."""

import shlex
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ial.cli.bounce.options import (
    Angle,
    CountError,
    EnvironmentPaths,
    Radius,
    Resolution,
    Simplify,
    StepError,
    StepLength,
    TurnError,
    execution_bounds,
    number,
)
from ial.cli.shell.options import Json
from ial.cli.shell.terminal import counting, say, say_json

if TYPE_CHECKING:
    from ial.bouncing.planning.advice import Advice


def advise(
    environments: EnvironmentPaths,
    angle: Angle = "90",
    radius: Radius = "0",
    step: StepLength = None,
    turn_error: TurnError = "0",
    step_error: StepError = "0",
    count_error: CountError = 0,
    flash: Annotated[int, typer.Option(min=0, metavar="BYTES", help="Of filters of rays, take the finest that fits into so much.")] = 64
    * 1024,
    most_states: Annotated[int, typer.Option("--most-states", min=1, metavar="N", help="Give up an exact filter at so many states.")] = 2
    ** 17,
    resolution: Resolution = None,
    simplify: Simplify = None,
    as_json: Json = False,
) -> None:
    """Compute what filters come to for a few choices of cells, parts of walls and headings, and say which one to build."""
    from ial.bouncing.planning.advice import advise as advice_of
    from ial.cli.bounce.advice_report import about, lines
    from ial.cli.bounce.surroundings import Surroundings

    size = number(radius, "--radius")
    surroundings = Surroundings.read(environments, resolution, simplify, size)
    bounds = execution_bounds(turn_error, step_error, count_error)
    given = None if step is None else number(step, "--step")
    with counting("choices") as progress:
        advice = advice_of(surroundings.environments, number(angle, "--angle"), given, size, bounds, flash, most_states, progress)
    said = {"--angle": angle, "--step": step, "--resolution": resolution, "--simplify": simplify}
    errors = {"--turn-error": turn_error, "--step-error": step_error, "--count-error": str(count_error)}
    command = _command(environments, advice, said, {name: text for name, text in errors.items() if number(text, name)}, radius)
    if as_json:
        say_json({"simplified": surroundings.record(), **about(advice), "command": command})
        return
    for line in surroundings.lines():
        say(line)
    for line in lines(advice):
        say(line)
    if command:
        say(command)


def _command(paths: Sequence[Path], advice: "Advice", said: dict[str, str | None], errors: dict[str, str], radius: str) -> str | None:
    """Return the command that builds what is advised."""
    from ial.bouncing.planning.cell_choice import CellChoice

    best = advice.best
    if best is None:
        return None
    words = ["ial", "bounce", "build", *map(str, paths)]
    size = radius if number(radius, "--radius") else None
    if isinstance(best, CellChoice):
        options = {**said, "--cell": str(best.cell_m), "--headings": str(best.headings), "--radius": size}
    else:
        options = {**said, **errors, "--radius": size, "--part": str(best.part_m), "--headings": str(best.headings)}
        words += ["--rays"] * (not errors)
    words += [word for name, text in options.items() if text is not None for word in (name, text)]
    return shlex.join([*words, "--out", f"{'-'.join(path.stem for path in paths)}.npz"])
