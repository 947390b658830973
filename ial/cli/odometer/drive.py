"""What the commands of `ial odometer` share: the environment, the robot in it, and its localization."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ial.cli.bounce.options import number
from ial.cli.shell.terminal import counting
from ial.errors import ConfigError, MapError

if TYPE_CHECKING:
    from fractions import Fraction

    from ial.maps.polygons.polygon import Polygon
    from ial.odometer import Localization

EnvironmentPath = Annotated[
    Path | None,
    typer.Argument(
        metavar="[ENV]",
        help="Polygons (.json, .wkt, .geojson, .svg), a map.yaml, or a picture (.png, .pgm, .jpg, .bmp); an embedded one if left out.",
    ),
]
StartPose = Annotated[str, typer.Option("--start", metavar="X,Y,DEGREES", help="Where the simulated robot starts: 1.5,2,30 or 3/2,2,30.")]
DistanceError = Annotated[
    str, typer.Option("--distance-error", metavar="PART", help="By which part of a distance its reading may be wrong: 1/100 or 1%.")
]
TurnError = Annotated[str, typer.Option("--turn-error", metavar="DEGREES", help="By how much each turn may be wrong.")]
Seed = Annotated[int, typer.Option("--seed", min=0, help="Draws the errors; the same seed gives the same run.")]


class Drive:
    """A simulated robot that is localized.

    Parameters
    ----------
    path
        The file of the environment; the embedded one if there is none.
    start
        x, y in metres and the heading in degrees, between commas.
    distance_error, turn_error
        The bounds of the errors, as typed.
    seed
        Draws the errors.
    resolution
        The width of a pixel in metres, if the file is a picture.

    Raises
    ------
    ConfigError
        If the start or a bound is no number, or the start is not free.
    MapError
        If the environment cannot be read.
    """

    def __init__(
        self, path: Path | None, start: str, distance_error: str = "0", turn_error: str = "0", seed: int = 0, resolution: str | None = None
    ) -> None:
        from ial.odometer import OdometerBounds, OdometerRobot

        if start.count(",") != 2:
            raise ConfigError(f"--start is {start!r}; give X,Y,DEGREES: metres and degrees between commas")
        x, y, heading = (number(each, "--start") for each in start.split(","))
        self.name = "the embedded environment" if path is None else path.stem
        self.bounds: OdometerBounds = OdometerBounds(float(_part(distance_error)), float(number(turn_error, "--turn-error")))
        parts = _polygons(path, resolution)
        self.start = float(x), float(y), float(heading)
        for polygon in parts:
            try:
                self.robot: OdometerRobot = OdometerRobot(polygon, x, y, heading, self.bounds, seed)
            except ConfigError:
                if polygon is parts[-1]:
                    raise
            else:
                break
        self.polygons = {f"part {at}" if len(parts) > 1 else self.name: each for at, each in enumerate(parts, 1)}

    def __repr__(self) -> str:
        return f"<Drive in {self.name}>"

    def localized(self) -> "Localization":
        """Drive the robot until it is localized; a bar on a terminal counts commands."""
        from ial.odometer import localize

        with counting("commands") as progress:
            return localize(self.polygons, self.robot, self.bounds, progress=progress)


def _part(text: str) -> "Fraction":
    return number(text[:-1], "--distance-error") / 100 if text.endswith("%") else number(text, "--distance-error")


def _polygons(path: Path | None, resolution: str | None) -> "tuple[Polygon, ...]":
    from ial.maps.polygons.environment import load_environment
    from ial.odometer.example import example_environment

    if path is None:
        if resolution is not None:
            raise MapError("--resolution is the width of a pixel, and no picture is given; leave it out, or give a picture")
        return (example_environment(),)
    return load_environment(path, None if resolution is None else number(resolution, "--resolution")).polygons
