"""`ial bounce simulate`: what a robot with real geometry observes, and where it was."""

from pathlib import Path
from typing import Annotated

import typer

from ial.cli.bounce.options import CountError, EnvironmentPath, Resolution, Simplify, StepError, TurnError, execution_bounds, number
from ial.cli.shell.options import Overwrite
from ial.cli.shell.outputs import check_outputs
from ial.cli.shell.terminal import say, shown


def simulate(
    environment: EnvironmentPath,
    out: Annotated[Path, typer.Option(metavar="STREAM", help="The text file of 0 and 1 to write.")],
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
    truth: Annotated[Path | None, typer.Option(metavar="CSV", help="Where to write the pose after each observation.")] = None,
    resolution: Resolution = None,
    simplify: Simplify = None,
    overwrite: Overwrite = False,
) -> None:
    """Drive a bouncing robot through an environment, with real geometry and errors within bounds, and write down what it observes."""
    from itertools import islice

    from ial.bouncing.rays.real_robot import RealRobot
    from ial.bouncing.stream_file import write_stream, write_truth
    from ial.cli.bounce.surroundings import Surroundings

    check_outputs([out] if truth is None else [out, truth], [environment], overwrite)
    surroundings = Surroundings.read([environment], resolution, simplify, number(radius, "--radius"))
    (loaded,) = surroundings.environments.values()
    bounds = execution_bounds(turn_error, step_error, count_error)
    place = None
    if start is not None:
        x, y, heading = (number(text, "--start") for text in start)
        place = (x, y, heading / 360)
    robot = RealRobot(loaded, number(angle, "--angle"), number(step, "--step"), number(radius, "--radius"), bounds, seed, place)
    poses = list(islice(robot.run(), steps))
    write_stream((pose.observation for pose in poses), out)
    for line in surroundings.lines():
        say(line)
    say(f"{len(poses)} observations, {sum(pose.observation for pose in poses)} of them bumps, in {shown(out)}")
    if truth is not None:
        write_truth(poses, truth)
        say(f"the poses after them in {shown(truth)}")
