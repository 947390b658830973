"""`ial compass verify`: whether a file holds a sequence that localizes."""

from pathlib import Path
from typing import Annotated

import typer

from ial.cli.bounce.options import Resolution
from ial.cli.compass.surroundings import EnvironmentPath, read_polygon
from ial.cli.shell.options import Json
from ial.cli.shell.terminal import counting, say, say_json
from ial.errors import SequenceError

SequencePath = Annotated[Path, typer.Argument(metavar="SEQUENCE", help="What `ial compass plan` has written.")]


def verify(sequence_path: SequencePath, environment: EnvironmentPath = None, resolution: Resolution = None, as_json: Json = False) -> None:
    """Prove that a sequence localizes, by exact code that shares nothing with the planner; or say at which step it does not.

    With ENV, prove that it is a sequence of that environment, too.
    """
    from ial.compass.sequence_file import read_sequence
    from ial.compass.verifier import verify as verified

    sequence = read_sequence(sequence_path)
    if environment is not None or resolution is not None:
        polygon = read_polygon(environment, resolution)
        if polygon != sequence.polygon:
            raise SequenceError(
                f"{sequence_path}: step 0: the sequence is one of another environment than {environment}; plan one for that"
            )
    try:
        with counting("steps") as progress:
            verified(sequence, progress)
    except SequenceError as error:
        raise SequenceError(f"{sequence_path}: {error}; plan the sequence again") from None
    x, y = (float(each) for each in sequence.end)
    if as_json:
        say_json({"verified": True, "motions": len(sequence), "end_m": [x, y], "end": [str(each) for each in sequence.end]})
        return
    say(f"proved: after {len(sequence)} motions a robot is at x {x:g} m, y {y:g} m, wherever it started")
