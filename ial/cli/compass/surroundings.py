"""The environment of a command of `ial compass`, which is one polygon, and places in it."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ial.errors import ConfigError, MapError

if TYPE_CHECKING:
    from ial.maps.polygons.polygon import ExactPoint, Polygon

EnvironmentPath = Annotated[
    Path | None,
    typer.Argument(
        metavar="[ENV]",
        help="A polygon (.json, .wkt, .geojson, .svg), a map.yaml, or a picture (.png, .pgm, .jpg, .bmp); an embedded one if left out.",
    ),
]


def read_polygon(path: Path | None, resolution: str | None) -> "Polygon":
    """Return the one polygon of a file, or the embedded one.

    Raises
    ------
    ConfigError
        If the resolution is no number.
    MapError
        If the file cannot be read, or holds several polygons.
    """
    from ial.cli.bounce.options import number
    from ial.compass.example import example_polygon
    from ial.maps.polygons.environment import load_environment

    if path is None:
        if resolution is not None:
            raise MapError("--resolution is the width of a pixel, and no picture is given; leave it out, or give a picture")
        return example_polygon()
    environment = load_environment(path, None if resolution is None else number(resolution, "--resolution"))
    if len(environment.polygons) > 1:
        raise MapError(
            f"{path}: {len(environment.polygons)} polygons that are apart; a robot with a compass cannot tell in which one it is, so give "
            "one of them"
        )
    return environment.polygons[0]


def place(text: str) -> "ExactPoint":
    """Return the place that an option --start names, in metres.

    Raises
    ------
    ConfigError
        If it is no pair of numbers.
    """
    from ial.cli.bounce.options import number

    if text.count(",") != 1:
        raise ConfigError(f"--start is {text!r}; give X,Y in metres")
    x, y = (number(each, "--start") for each in text.split(","))
    return x, y
