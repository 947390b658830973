"""The filter of a robot with real geometry, for `ial bounce build`."""

import shlex
from fractions import Fraction
from pathlib import Path

from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.filters.filter_file import write_filter
from ial.bouncing.filters.goal import Goal
from ial.bouncing.filters.piece_filter import PieceFilter
from ial.bouncing.rays.piece_map import PieceMap
from ial.bouncing.start import Start
from ial.cli.bounce.piece_report import about, lines
from ial.cli.bounce.surroundings import Surroundings
from ial.cli.shell.terminal import counting, say, say_json, shown
from ial.errors import ConfigError


def build_pieces(
    surroundings: Surroundings,
    robot: tuple[Fraction, Fraction, ExecutionBounds],
    grid: tuple[Fraction, int, Fraction],
    goal: Goal,
    start: Start,
    out: Path,
    as_json: bool,
) -> None:
    """Build the filter, write it, and say what it is.

    The robot is its bouncing angle, its step and the bounds of its errors; the grid the width of parts, the headings and the radius.
    """
    (name, environment) = next(iter(surroundings.environments.items()))
    x0, y0, x1, y1 = environment.bounds
    for room in goal.rooms:
        if room.x1 <= x0 or x1 <= room.x0 or room.y1 <= y0 or y1 <= room.y0:
            raise ConfigError(
                f"the room {room.name!r} lies outside of the environment, which is at x {float(x0):g} to {float(x1):g} m, "
                f"y {float(y0):g} to {float(y1):g} m; check its coordinates"
            )
    with counting("numbers of steps") as progress:
        map_ = PieceMap.of(environment, *robot, *grid, progress)
    made = PieceFilter(map_, name, *robot, goal, grid[-1]).starting(start)
    write_filter(made, out)
    if as_json:
        say_json({**about(made), "simplified": surroundings.record()})
        return
    for line in (*surroundings.lines(), *lines(about(made))):
        say(line)
    say(f"filter in {shown(out)}; use it with: ial bounce run {shlex.quote(str(shown(out)))} --stream 0010001")
