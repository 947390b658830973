"""Options that several commands of `ial bounce` share, and what they mean."""

from collections.abc import Sequence
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

if TYPE_CHECKING:
    from ial.bouncing.execution_bounds import ExecutionBounds
    from ial.bouncing.filters.goal import Goal
    from ial.bouncing.start import Start
    from ial.maps.polygons.environment import Environment

_ENVIRONMENT = "Polygons (.json, .wkt, .geojson, .svg), a map.yaml, a picture (.png, .pgm, .jpg, .bmp), or sample, the embedded map"
EnvironmentPath = Annotated[Path, typer.Argument(metavar="ENV", help=f"{_ENVIRONMENT}.")]
EnvironmentPaths = Annotated[list[Path], typer.Argument(metavar="ENV", help=f"{_ENVIRONMENT}; several if it may be in any.")]
Resolution = Annotated[str | None, typer.Option("--resolution", metavar="METRES", help="The width of a pixel, if ENV is a picture.")]
Simplify = Annotated[
    str | None,
    typer.Option("--simplify", metavar="METRES", help="Use fewer walls, which move by so much at most; narrower parts are left out."),
]
Angle = Annotated[str, typer.Option("--angle", metavar="DEGREES", help="The bouncing angle, counter-clockwise: 90, 22.5 or 45/2.")]
Cell = Annotated[
    str | None, typer.Option("--cell", metavar="METRES", help="The width of a cell; that of the map if it is left out, or 1 for polygons.")
]
HeadingCount = Annotated[
    int | None, typer.Option("--headings", metavar="N", help="How many headings; as few as the angle needs if left out.")
]
Radius = Annotated[str, typer.Option("--radius", metavar="METRES", help="The radius of the robot; 0 for a point.")]
StepLength = Annotated[str | None, typer.Option("--step", metavar="METRES", help="How far a step leads; the width of a cell if left out.")]
FreeRule = Annotated[Literal["centre", "inside"], typer.Option("--rule", help="What of a cell must be free: its centre, or all of it.")]
CornerPolicy = Annotated[
    Literal["segment", "endpoint"], typer.Option("--corner", help="What of a step must be free: all of it, or the cell where it ends.")
]
TurnError = Annotated[str, typer.Option("--turn-error", metavar="DEGREES", help="Bound of the error of a turn.")]
StepError = Annotated[str, typer.Option("--step-error", metavar="PART", help="Bound of the error of a step, as a part of it: 0.02.")]
CountError = Annotated[int, typer.Option("--count-error", metavar="N", help="Bound of the error of the number of steps between bumps.")]
Region = Annotated[
    str | None, typer.Option("--region", metavar="X0,Y0,X1,Y1", help="Where it starts: a rectangle; anywhere if it is left out.")
]
HeadingsKnown = Annotated[
    list[str] | None,
    typer.Option("--heading", metavar="FROM,TO", help="In which headings it starts, in degrees counter-clockwise; may be repeated."),
]
MostStates = Annotated[int, typer.Option("--most-states", min=1, metavar="N", help="Give up at so many states.")]


def number(text: str, option: str) -> Fraction:
    """Return the exact value of an option.

    Raises
    ------
    ConfigError
        If it is no number.
    """
    from ial.errors import ConfigError, MapError
    from ial.maps.polygons.exact_number import exact_number

    try:
        return exact_number(text, option)
    except MapError as error:
        raise ConfigError(str(error)) from None


def cell_width(loaded: "dict[str, Environment]", cell: str | None) -> Fraction | None:
    """Return the width of a cell in metres, None where it is that of the grids the environments come from.

    Raises
    ------
    ConfigError
        If it is not positive.
    """
    from ial.errors import ConfigError

    known = None if all(each.cell for each in loaded.values()) else Fraction(1)
    width = known if cell is None else number(cell, "--cell")
    if width is not None and width <= 0:
        raise ConfigError(f"--cell is {cell}; give a width greater than 0, in metres")
    return width


def step_cells(step: str | None, loaded: "dict[str, Environment]", width: Fraction | None) -> Fraction:
    """Return how far a step leads, in widths of a cell."""
    one = width or next(each.cell for each in loaded.values() if each.cell)
    return Fraction(1) if step is None else number(step, "--step") / one


def execution_bounds(turn_error: str, step_error: str, count_error: int) -> "ExecutionBounds":
    """Return the bounds of the errors of a robot.

    Raises
    ------
    ConfigError
        If one cannot be meant.
    """
    from ial.bouncing.execution_bounds import ExecutionBounds

    return ExecutionBounds(number(turn_error, "--turn-error"), number(step_error, "--step-error"), count_error)


def goal(rooms: Sequence[str], within: str | None) -> "Goal":
    """Return when a robot counts as localized: in one of several rooms, or within a width, 1 m if neither is given.

    Raises
    ------
    ConfigError
        If a room cannot be read, or both are given.
    """
    from ial.bouncing.filters.goal import Goal, Room
    from ial.errors import ConfigError

    read = []
    for text in rooms:
        name, _, corners = text.partition("=")
        if corners.count(",") != 3:
            raise ConfigError(f"--room is {text!r}; give NAME=X0,Y0,X1,Y1: a name, and the least and the greatest coordinates in metres")
        x0, y0, x1, y1 = (number(part, "--room") for part in corners.split(","))
        read.append(Room(name, x0, y0, x1, y1))
    width = None if read and within is None else number("1" if within is None else within, "--within")
    return Goal(tuple(read), width)


def start(region: str | None, headings: Sequence[str] | None) -> "Start":
    """Return what is known of the start of a robot.

    Raises
    ------
    ConfigError
        If one of the options cannot be read or meant.
    """
    from ial.bouncing.start import Start
    from ial.errors import ConfigError

    place = None
    if region is not None:
        if region.count(",") != 3:
            raise ConfigError(f"--region is {region!r}; give X0,Y0,X1,Y1: the least and the greatest coordinates in metres")
        x0, y0, x1, y1 = (number(part, "--region") for part in region.split(","))
        place = (x0, y0, x1, y1)
    known = []
    for text in headings or []:
        if text.count(",") != 1:
            raise ConfigError(f"--heading is {text!r}; give FROM,TO in degrees, counter-clockwise")
        low, high = (number(part, "--heading") for part in text.split(","))
        known.append((low, high))
    return Start(place, tuple(known))
