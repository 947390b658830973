"""`ial bounce simulate`: what a robot with real geometry observes, and where it was."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ial.cli.bounce.options import CountError, EnvironmentPath, Resolution, Simplify, StepError, TurnError, execution_bounds, number
from ial.cli.shell.options import Overwrite
from ial.cli.shell.outputs import check_outputs
from ial.cli.shell.terminal import say, shown
from ial.errors import ConfigError

if TYPE_CHECKING:
    from fractions import Fraction

    from ial.bouncing.bump_timing import BumpTiming


def simulate(
    environment: EnvironmentPath,
    out: Annotated[Path | None, typer.Option(metavar="STREAM", help="The text file of 0 and 1 to write.")] = None,
    log: Annotated[Path | None, typer.Option(metavar="FILE", help="The log of bumps with times to write, .csv or .jsonl.")] = None,
    angle: Annotated[str, typer.Option(metavar="DEGREES", help="The bouncing angle, counter-clockwise: 90, 22.5 or 45/2.")] = "90",
    step: Annotated[str, typer.Option(metavar="METRES", help="How far a step leads.")] = "1",
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
    resolution: Resolution = None,
    simplify: Simplify = None,
    overwrite: Overwrite = False,
) -> None:
    """Drive a bouncing robot through an environment, with real geometry and errors within bounds, and write down what it observes."""
    from itertools import islice

    from ial.bouncing.bump_log_file import log_form, write_log
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
    robot = RealRobot(loaded, number(angle, "--angle"), number(step, "--step"), number(radius, "--radius"), bounds, seed, place)
    (x_m, y_m, _), poses = robot.pose, list(islice(robot.run(), steps))
    bumps = sum(pose.observation for pose in poses)
    events = None
    if timing is not None:
        known = None if place is None else (place[0], place[1], place[2] * 360)
        events = simulated_log((x_m, y_m), poses, timing, seed, known)
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
