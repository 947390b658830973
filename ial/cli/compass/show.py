"""`ial compass show`: pictures of a localizing sequence."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from ial.cli.compass.surroundings import place
from ial.cli.compass.verify import SequencePath, prove
from ial.cli.shell.options import Overwrite
from ial.cli.shell.outputs import check_outputs
from ial.cli.shell.terminal import say, shown
from ial.errors import ConfigError

if TYPE_CHECKING:
    from ial.maps.polygons.polygon import ExactPoint, Polygon

_STARTS = 6


def show(
    sequence_path: SequencePath,
    out: Annotated[Path, typer.Option(metavar="PNG", help="The picture to write.")],
    what: Annotated[
        Literal["states", "traces"],
        typer.Option(help="Where a robot can be after each motion, or the ways of robots from several starts."),
    ] = "states",
    start: Annotated[
        list[str] | None,
        typer.Option(metavar="X,Y", help="With --what traces: where a robot starts, in metres; repeated, some corners if left out."),
    ] = None,
    overwrite: Overwrite = False,
) -> None:
    """Verify a sequence, and draw what it does."""
    from ial.compass.sequence_file import read_sequence

    check_outputs([out], [sequence_path], overwrite)
    if out.suffix.lower() != ".png":
        raise ConfigError(f"{out}: the picture is a PNG; give a name that ends in .png")
    if start and what != "traces":
        raise ConfigError("--start is for --what traces; leave it out, or draw traces")
    sequence = read_sequence(sequence_path)
    prove(sequence, sequence_path)
    if what == "states":
        from ial.results.compass.state_picture import draw_states

        draw_states(out, sequence, sequence_path.stem)
    else:
        from ial.results.compass.trace_picture import draw_traces

        draw_traces(out, sequence, [place(each) for each in start] if start else _corners(sequence.polygon), sequence_path.stem)
    say(f"picture in {shown(out)}")


def _corners(polygon: "Polygon") -> "list[ExactPoint]":
    """Return corners that are spread over the outer ring."""
    count = len(polygon.outer)
    return [polygon.outer[at * count // min(_STARTS, count)] for at in range(min(_STARTS, count))]
