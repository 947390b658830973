"""`ial bounce build`: the filter of a bouncing robot, compiled from its environments."""

from pathlib import Path
from typing import Annotated, Literal

import typer

from ial.cli.options import Json
from ial.cli.terminal import say, say_json, shown


def build(
    environments: Annotated[
        list[Path],
        typer.Argument(metavar="ENV", help="Polygons (.json, .wkt, .geojson, .svg) or a map.yaml; several if it may be in any."),
    ],
    out: Annotated[Path, typer.Option(metavar="FILTER", help="The filter to write (.npz).")],
    angle: Annotated[str, typer.Option(metavar="DEGREES", help="The bouncing angle, counter-clockwise: 90, 22.5 or 45/2.")] = "90",
    cell: Annotated[
        str | None, typer.Option(metavar="METRES", help="The width of a cell; that of the map if it is left out, or 1 for polygons.")
    ] = None,
    headings: Annotated[int | None, typer.Option(metavar="N", help="How many headings; as few as the angle needs if left out.")] = None,
    radius: Annotated[str, typer.Option(metavar="METRES", help="The radius of the robot; 0 for a point.")] = "0",
    step: Annotated[str | None, typer.Option(metavar="METRES", help="How far a step leads; the width of a cell if left out.")] = None,
    rule: Annotated[Literal["inside", "centre"], typer.Option(help="What of a cell must be free: all of it, or its centre.")] = "inside",
    corner: Annotated[
        Literal["segment", "endpoint"], typer.Option(help="What of a step must be free: all of it, or the cell where it ends.")
    ] = "segment",
    most_states: Annotated[int, typer.Option(min=1, metavar="N", help="Give up at so many states.")] = 2**24,
    as_json: Json = False,
) -> None:
    """Build the filter that tells from bumps where a robot is, up to what it cannot tell apart."""
    from fractions import Fraction

    from ial.bouncing.building import build_filter
    from ial.bouncing.filter_file import write_filter
    from ial.bouncing.headings import Headings
    from ial.cli.bounce_report import about, lines
    from ial.errors import ConfigError, MapError
    from ial.maps.environment import load_environment
    from ial.maps.exact_number import exact_number

    def number(text: str, option: str) -> Fraction:
        try:
            return exact_number(text, option)
        except MapError as error:
            raise ConfigError(str(error)) from None

    if len({path.stem for path in environments}) < len(environments):
        raise ConfigError("two environments have the same name; give each file a name of its own, since the filter tells them by it")
    loaded = {path.stem: load_environment(path) for path in environments}
    known = None if all(each.cell for each in loaded.values()) else Fraction(1)
    width = known if cell is None else number(cell, "--cell")
    if width is not None and width <= 0:
        raise ConfigError(f"--cell is {cell}; give a width greater than 0, in metres")
    one = width or next(each.cell for each in loaded.values() if each.cell)
    moved = Fraction(1) if step is None else number(step, "--step") / one
    robot = Headings.of_angle(number(angle, "--angle"), headings, moved)
    made = build_filter(loaded, robot, width, number(radius, "--radius"), rule, corner, most_states)
    write_filter(made, out)
    if as_json:
        say_json(about(made))
        return
    for line in lines(about(made)):
        say(line)
    say(f"filter in {shown(out)}; use it with: ial bounce run {shown(out)} --stream 0010001")
