"""`ial compass verify`: whether a file holds a sequence that localizes."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ial.cli.bounce.options import Resolution
from ial.cli.compass.surroundings import read_polygon
from ial.cli.shell.options import Json
from ial.cli.shell.terminal import counting, say, say_json
from ial.errors import SequenceError

if TYPE_CHECKING:
    from ial.compass.sequence import Sequence
    from ial.maps.polygons.polygon import ExactRing, Polygon

SequencePath = Annotated[Path, typer.Argument(metavar="SEQUENCE", help="What `ial compass plan` has written.")]


OtherPath = Annotated[Path | None, typer.Argument(metavar="[ENV]", help="An environment; that of the sequence if left out.")]


def verify(sequence_path: SequencePath, environment: OtherPath = None, resolution: Resolution = None, as_json: Json = False) -> None:
    """Prove that a sequence localizes, by exact code that shares nothing with the planner; or say at which step it does not.

    With ENV, prove that it is a sequence of that environment, too.
    """
    from ial.compass.sequence_file import read_sequence

    sequence = read_sequence(sequence_path)
    if environment is not None or resolution is not None:
        polygon = read_polygon(environment, resolution)
        if not same_area(polygon, sequence.polygon):
            raise SequenceError(
                f"{sequence_path}: step 0: the sequence is one of another environment than {environment}; plan one for that"
            )
    prove(sequence, sequence_path)
    x, y = (float(each) for each in sequence.end)
    if as_json:
        say_json({"verified": True, "motions": len(sequence), "end_m": [x, y], "end": [str(each) for each in sequence.end]})
        return
    say(f"proved: after {len(sequence)} motions a robot is at x {x:g} m, y {y:g} m, wherever it started")


def prove(sequence: "Sequence", path: Path) -> None:
    """Verify a sequence that was read from a file.

    Raises
    ------
    SequenceError
        If it does not localize.
    """
    from ial.compass.verifier import verify as verified

    try:
        with counting("steps") as progress:
            verified(sequence, progress)
    except SequenceError as error:
        raise SequenceError(f"{path}: {error}; plan the sequence again") from None


def same_area(one: "Polygon", other: "Polygon") -> bool:
    """Return whether two polygons have the same rings, wherever these begin."""
    return _rings(one) == _rings(other)


def _rings(polygon: "Polygon") -> "tuple[ExactRing, frozenset[ExactRing]]":
    outer, *holes = (ring[(at := ring.index(min(ring))) :] + ring[:at] for ring in polygon.rings)
    return outer, frozenset(holes)
