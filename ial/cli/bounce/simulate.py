"""`ial bounce simulate`: what a robot with real geometry, or one of cells, observes, and where it was."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ial.cli.bounce.options import (
    CornerPolicy,
    CountError,
    EnvironmentPath,
    FreeRule,
    Resolution,
    Simplify,
    StepError,
    TurnError,
    execution_bounds,
    number,
    step_cells,
)
from ial.cli.shell.options import Overwrite
from ial.cli.shell.outputs import check_outputs
from ial.cli.shell.terminal import say, shown
from ial.errors import ConfigError

if TYPE_CHECKING:
    from fractions import Fraction

    from ial.bouncing.bump_timing import BumpTiming
    from ial.bouncing.cells.cell_robot import CellRobot
    from ial.bouncing.cells.corner import Corner
    from ial.maps.polygons.environment import Environment
    from ial.maps.polygons.raster import Rule


def simulate(
    environment: EnvironmentPath,
    out: Annotated[Path | None, typer.Option(metavar="STREAM", help="The text file of 0 and 1 to write.")] = None,
    log: Annotated[Path | None, typer.Option(metavar="FILE", help="The log of bumps with times to write, .csv or .jsonl.")] = None,
    angle: Annotated[str, typer.Option(metavar="DEGREES", help="The bouncing angle, counter-clockwise: 90, 22.5 or 45/2.")] = "90",
    step: Annotated[str | None, typer.Option(metavar="METRES", help="How far a step leads; 1 if left out.")] = None,
    radius: Annotated[str, typer.Option(metavar="METRES", help="The radius of the robot; 0 for a point.")] = "0",
    seed: Annotated[int, typer.Option(min=0, help="The same seed gives the same run.")] = 0,
    steps: Annotated[int, typer.Option(min=1, metavar="N", help="How many observations.")] = 200,
    turn_error: TurnError = "0",
    step_error: StepError = "0",
    count_error: CountError = 0,
    start: Annotated[
        tuple[str, str, str] | None, typer.Option(metavar="X Y DEGREES", help="Where to start; at random if it is left out.")
    ] = None,
    speed: Annotated[str | None, typer.Option(metavar="M/S", help="With --log: how fast it drives, up to the error of a step.")] = None,
    turn_time: Annotated[str | None, typer.Option(metavar="S", help="With --log: how long a turn takes; 0 if left out.")] = None,
    clock_error: Annotated[
        str | None, typer.Option(metavar="S", help="With --log: bound of the error of the time driven between bumps.")
    ] = None,
    truth: Annotated[Path | None, typer.Option(metavar="CSV", help="Where to write the pose after each observation.")] = None,
    cell: Annotated[
        str | None,
        typer.Option(metavar="METRES", help="Put it back to the centre of a cell so wide at each step; --step is that if left out."),
    ] = None,
    headings: Annotated[int | None, typer.Option(metavar="N", help="With --cell: how many headings; as few as the angle needs.")] = None,
    rule: FreeRule = "centre",
    corner: CornerPolicy = "segment",
    resolution: Resolution = None,
    simplify: Simplify = None,
    overwrite: Overwrite = False,
) -> None:
    """Drive a bouncing robot through an environment, with real geometry and errors within bounds, and write down what it observes.

    With --cell it is the robot that filters of cells are exact for; build one with the same --cell, --step, --headings and --rule.
    """
    from itertools import islice

    from ial.bouncing.bump_log_file import log_form, write_log
    from ial.bouncing.execution_bounds import ExecutionBounds
    from ial.bouncing.rays.real_robot import RealRobot
    from ial.bouncing.simulated_log import simulated_log
    from ial.bouncing.stream_file import write_stream, write_truth
    from ial.cli.bounce.surroundings import Surroundings

    if out is None and log is None:
        raise ConfigError("nothing is to be written; give --out STREAM, --log FILE, or both")
    check_outputs([each for each in (out, log, truth) if each is not None], [environment], overwrite)
    surroundings = Surroundings.read([environment], resolution, simplify, number(radius, "--radius"))
    (loaded,) = surroundings.environments.values()
    bounds = execution_bounds(turn_error, step_error, count_error)
    timing = _timing(log, speed, turn_time, clock_error, bounds.step)
    if log is not None:
        log_form(log)
    place = None
    if start is not None:
        x, y, heading = (number(text, "--start") for text in start)
        place = (x, y, heading / 360)
    events = None
    if cell is not None:
        if log is not None or bounds != ExecutionBounds():
            raise ConfigError("--log and errors are for robots with real geometry; leave --cell out, or these")
        robot_of_cells = _cell_robot(loaded, (angle, cell, step, radius), headings, (rule, corner), seed, place)
        poses = list(islice(robot_of_cells.run(), steps))
    else:
        if (headings, rule, corner) != (None, "centre", "segment"):
            raise ConfigError("--headings, --rule and --corner are for a robot of cells; give --cell, too")
        robot = RealRobot(loaded, number(angle, "--angle"), number(step or "1", "--step"), number(radius, "--radius"), bounds, seed, place)
        (x_m, y_m, _), poses = robot.pose, list(islice(robot.run(), steps))
        if timing is not None:
            known = None if place is None else (place[0], place[1], place[2] * 360)
            events = simulated_log((x_m, y_m), poses, timing, seed, known)
    bumps = sum(pose.observation for pose in poses)
    for line in surroundings.lines():
        say(line)
    if out is not None:
        write_stream((pose.observation for pose in poses), out)
        say(f"{len(poses)} observations, {bumps} of them bumps, in {shown(out)}")
    if log is not None and events is not None:
        write_log(events, log)
        say(f"a start and {bumps} bumps in {float(events[-1].time_s):.3f} s, in {shown(log)}")
    if truth is not None:
        write_truth(poses, truth)
        say(f"the poses after the observations in {shown(truth)}" if out is None else f"the poses after them in {shown(truth)}")


def _cell_robot(
    environment: "Environment",
    lengths: tuple[str, str, str | None, str],
    headings: int | None,
    choices: "tuple[Rule, Corner]",
    seed: int,
    place: "tuple[Fraction, Fraction, Fraction] | None",
) -> "CellRobot":
    """Return a robot of cells, of its angle, cell, step and radius, and of the rule and the corner policy."""
    from ial.bouncing.cells.cell_map import CellMap
    from ial.bouncing.cells.cell_robot import CellRobot
    from ial.bouncing.cells.headings import Headings
    from ial.bouncing.filters.building import free_cells

    (angle, cell, step, radius), (rule, corner), loaded = lengths, choices, {"": environment}
    width = number(cell, "--cell")
    raster = free_cells(environment, width, number(radius, "--radius"), rule)
    lattice = Headings.of_angle(number(angle, "--angle"), headings, step_cells(step, loaded, width))
    return CellRobot(CellMap(raster, lattice, corner), seed, place)


def _timing(
    log: Path | None, speed: str | None, turn_time: str | None, clock_error: str | None, speed_part: "Fraction"
) -> "BumpTiming | None":
    """Return how a log gets its times; None if there is none."""
    from ial.bouncing.bump_timing import BumpTiming

    if log is None:
        if any(each is not None for each in (speed, turn_time, clock_error)):
            raise ConfigError("--speed, --turn-time and --clock-error are for a --log with times; give --log FILE, too")
        return None
    if speed is None or clock_error is None:
        raise ConfigError("a log has times; give --speed in metres per second, and --clock-error in seconds")
    return BumpTiming(number(speed, "--speed"), number(turn_time or "0", "--turn-time"), number(clock_error, "--clock-error"), speed_part)
