"""`ial bounce build`: the filter of a bouncing robot, compiled from its environments."""

import shlex
from pathlib import Path
from typing import Annotated

import typer

from ial.cli.bounce.options import (
    Angle,
    Cell,
    CornerPolicy,
    CountError,
    EnvironmentPaths,
    FreeRule,
    HeadingCount,
    HeadingsKnown,
    MostStates,
    Radius,
    Region,
    Resolution,
    Simplify,
    StepError,
    StepLength,
    TurnError,
    cell_width,
    execution_bounds,
    number,
    step_cells,
)
from ial.cli.bounce.options import goal as read_goal
from ial.cli.bounce.options import start as read_start
from ial.cli.shell.options import Json, Overwrite
from ial.cli.shell.outputs import check_outputs
from ial.cli.shell.terminal import counting, remark, say, say_json, shown
from ial.errors import ConfigError

_HEADINGS = 72


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
    rays: Annotated[bool, typer.Option("--rays", help="For real geometry; --step is 1/4 and --headings 72 if left out.")] = False,
    turn_error: TurnError = "0",
    step_error: StepError = "0",
    count_error: CountError = 0,
    part: Annotated[str | None, typer.Option(metavar="METRES", help="With --rays: the width of pieces of walls; 1/4 if left out.")] = None,
    rooms: Annotated[
        list[str] | None,
        typer.Option("--room", metavar="NAME=X0,Y0,X1,Y1", help="With --rays: who is in a rectangle is localized; may be repeated."),
    ] = None,
    within: Annotated[
        str | None,
        typer.Option(metavar="METRES", help="With --rays, no rooms: who is in a square so wide is localized; 1 if left out."),
    ] = None,
    region: Region = None,
    headings_known: HeadingsKnown = None,
    resolution: Resolution = None,
    simplify: Simplify = None,
    overwrite: Overwrite = False,
    as_json: Json = False,
) -> None:
    """Build the filter that tells from bumps where a robot is, up to what it cannot tell apart.

    Without --rays or an error, it is for a robot that is put back to the centre of its cell at each step; an error means --rays.
    """
    from ial.bouncing.cells.headings import Headings
    from ial.bouncing.execution_bounds import ExecutionBounds
    from ial.bouncing.filters.building import build_filter
    from ial.bouncing.filters.filter_file import write_filter
    from ial.cli.bounce.piece_build import build_pieces
    from ial.cli.bounce.report import about, lines
    from ial.cli.bounce.surroundings import Surroundings

    check_outputs([out], environments, overwrite)
    surroundings = Surroundings.read(environments, resolution, simplify, number(radius, "--radius"))
    loaded = surroundings.environments
    bounds = execution_bounds(turn_error, step_error, count_error)
    if rays or bounds != ExecutionBounds():
        if (cell, rule, corner, most_states) != (None, "centre", "segment", 2**24):
            raise ConfigError("--cell, --rule, --corner and --most-states are for filters of cells; leave them out with --rays or an error")
        if len(loaded) > 1:
            raise ConfigError("a filter with --rays or errors is for one environment; give one, or build a filter for each")
        goal = read_goal(rooms or [], within)
        robot = number(angle, "--angle"), number("1/4" if step is None else step, "--step"), bounds
        grid = number("1/4" if part is None else part, "--part"), _HEADINGS if headings is None else headings, number(radius, "--radius")
        build_pieces(surroundings, robot, grid, goal, read_start(region, headings_known), out, as_json)
        return
    if rooms or within is not None or part is not None:
        raise ConfigError("--room, --within and --part are for robots with real geometry; give --rays or an error, too")
    width, start = cell_width(loaded, cell), read_start(region, headings_known)
    if start.region is not None and len(loaded) > 1:
        raise ConfigError("--region is a place in one environment; give one")
    lattice = Headings.of_angle(number(angle, "--angle"), headings, step_cells(step, loaded, width))
    with counting("states") as progress:
        made = build_filter(loaded, lattice, width, number(radius, "--radius"), rule, corner, most_states, start, progress)
    write_filter(made, out)
    if width is None:
        said = f"cells are {float(made.setting.cell):g} m wide, as those of the map; ial bounce advise shows what other widths come to"
        remark("note", said, "cyan")
    if as_json:
        say_json({**about(made), "simplified": surroundings.record()})
        return
    for line in (*surroundings.lines(), *lines(about(made))):
        say(line)
    say(f"filter in {shown(out)}; use it with: ial bounce run {shlex.quote(str(shown(out)))} --stream 0010001")
