"""`ial compass plan`: motions after which a robot with a compass knows where it is."""

from pathlib import Path
from typing import Annotated, Literal

import typer

from ial.cli.bounce.options import Resolution
from ial.cli.compass.surroundings import EnvironmentPath, read_polygon
from ial.cli.shell.options import Json, Overwrite
from ial.cli.shell.outputs import check_outputs
from ial.cli.shell.terminal import counting, say, say_json, shown


def plan(
    environment: EnvironmentPath = None,
    out: Annotated[Path, typer.Option(metavar="JSON", help="The sequence to write, with its certificate.")] = ...,  # type: ignore[assignment]
    order: Annotated[
        Literal["greedy", "paper"], typer.Option(help="Which walls and points come first: what leaves least, or what the paper takes.")
    ] = "greedy",
    resolution: Resolution = None,
    as_json: Json = False,
    overwrite: Overwrite = False,
) -> None:
    """Plan a localizing sequence: directions, each driven until a wall is there, that lead from everywhere to one place."""
    from ial.compass.planning import localizing_sequence
    from ial.compass.sequence_file import write_sequence

    check_outputs([out], [environment], overwrite)
    polygon = read_polygon(environment, resolution)
    with counting("motions") as progress:
        sequence = localizing_sequence(polygon, order, lambda done, sizes: progress(done))
    write_sequence(sequence, out)
    x, y = (float(each) for each in sequence.end)
    pieces = [pieces for pieces, _ in sequence.sizes]
    if as_json:
        say_json(
            {
                "file": str(out),
                "corners": sum(map(len, polygon.rings)),
                "holes": len(polygon.holes),
                "order": order,
                "motions": len(sequence),
                "motions_along_walls": pieces.index(0),
                "direction_bits": sequence.bits,
                "end_m": [x, y],
                "end": [str(each) for each in sequence.end],
            }
        )
        return
    holes = f" and {len(polygon.holes)} hole{'s' * (len(polygon.holes) != 1)}" if polygon.holes else ""
    say(f"environment of {sum(map(len, polygon.rings))} corners{holes}: {len(sequence)} motions, the first {pieces.index(0)} along walls")
    say(f"from everywhere they lead to one place: x {x:g} m, y {y:g} m (exact)")
    say(f"directions have at most {sequence.bits} bits; they must not be rounded")
    say(f"sequence in {shown(out)}")
