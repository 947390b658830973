"""`ial odometer show`: a picture of the localization of a simulated robot."""

from pathlib import Path
from typing import Annotated

import typer

from ial.cli.bounce.options import Resolution
from ial.cli.odometer.drive import DistanceError, Drive, EnvironmentPath, Seed, StartPose, TurnError
from ial.cli.shell.options import Overwrite
from ial.cli.shell.outputs import check_outputs
from ial.cli.shell.terminal import say, shown
from ial.errors import ConfigError


def show(
    out: Annotated[Path, typer.Option(metavar="PNG", help="The picture to write.")],
    environment: EnvironmentPath = None,
    start: StartPose = "2,1,70",
    distance_error: DistanceError = "0",
    turn_error: TurnError = "0",
    seed: Seed = 0,
    resolution: Resolution = None,
    overwrite: Overwrite = False,
) -> None:
    """Draw what a robot knows: its path, the candidates after its first motions, two of them laid upon each other, and the end."""
    check_outputs([out], [environment], overwrite)
    if out.suffix.lower() != ".png":
        raise ConfigError(f"{out}: the picture is a PNG; give a name that ends in .png")
    from ial.results.odometer.localization_picture import draw_localization

    drive = Drive(environment, start, distance_error, turn_error, seed, resolution)
    path = []

    class Watched:
        """The robot, with its path."""

        def execute(self, command):  # type: ignore[no-untyped-def]
            reading = drive.robot.execute(command)
            path.append((drive.robot.x, drive.robot.y))
            return reading

    from ial.odometer import localize

    found = localize(drive.polygons, Watched(), drive.bounds)
    draw_localization(out, drive.name, drive.polygons, found, [drive.start[:2], *path])
    say(f"picture in {shown(out)}")
