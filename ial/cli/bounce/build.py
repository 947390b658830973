"""`ial bounce build`: the filter of a bouncing robot, compiled from its environments."""

import shlex
from pathlib import Path
from typing import Annotated

import typer

from ial.cli.bounce.options import (
    Angle,
    Cell,
    CornerPolicy,
    EnvironmentPaths,
    FreeRule,
    HeadingCount,
    MostStates,
    Radius,
    StepLength,
    cell_width,
    number,
    step_cells,
)
from ial.cli.bounce.options import environments as read_environments
from ial.cli.shell.options import Json, Overwrite
from ial.cli.shell.outputs import check_outputs
from ial.cli.shell.terminal import say, say_json, shown


def build(
    environments: EnvironmentPaths,
    out: Annotated[Path, typer.Option(metavar="FILTER", help="The filter to write (.npz).")],
    angle: Angle = "90",
    cell: Cell = None,
    headings: HeadingCount = None,
    radius: Radius = "0",
    step: StepLength = None,
    rule: FreeRule = "centre",
    corner: CornerPolicy = "segment",
    most_states: MostStates = 2**24,
    overwrite: Overwrite = False,
    as_json: Json = False,
) -> None:
    """Build the filter that tells from bumps where a robot is, up to what it cannot tell apart."""
    from ial.bouncing.cells.headings import Headings
    from ial.bouncing.filters.building import build_filter
    from ial.bouncing.filters.filter_file import write_filter
    from ial.cli.bounce.report import about, lines

    check_outputs([out], environments, overwrite)
    loaded = read_environments(environments)
    width = cell_width(loaded, cell)
    robot = Headings.of_angle(number(angle, "--angle"), headings, step_cells(step, loaded, width))
    made = build_filter(loaded, robot, width, number(radius, "--radius"), rule, corner, most_states)
    write_filter(made, out)
    if as_json:
        say_json(about(made))
        return
    for line in lines(about(made)):
        say(line)
    say(f"filter in {shown(out)}; use it with: ial bounce run {shlex.quote(str(shown(out)))} --stream 0010001")
