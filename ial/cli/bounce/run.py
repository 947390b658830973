"""`ial bounce run`: where a robot is that has seen a stream of bumps."""

import sys
from pathlib import Path
from typing import Annotated, Any, Literal

import typer

from ial.cli.shell.options import Json
from ial.cli.shell.terminal import say, say_json
from ial.errors import StreamError

NEVER_LOCALIZED = 3
_MOST_PLACES = 12


def run(
    filter_path: Annotated[Path, typer.Argument(metavar="FILTER", help="What `ial bounce build` has written.")],
    stream: Annotated[str | None, typer.Option(metavar="BITS", help="The observations: 1 for a bump, 0 for a step without one.")] = None,
    file: Annotated[Path | None, typer.Option(metavar="FILE", help="A file with the observations; - for standard input.")] = None,
    world: Annotated[Literal["open", "closed"], typer.Option(help="May the robot be elsewhere? If closed, that is an error.")] = "open",
    restart: Annotated[bool, typer.Option("--restart", help="Begin anew after a rejection: the robot may have been carried.")] = False,
    as_json: Json = False,
) -> None:
    """Say where a robot is, or prove that it is in none of the environments."""
    if (stream is None) == (file is None):
        raise StreamError("give the observations either as --stream BITS or as --file FILE")
    from ial.bouncing.filters.filter_file import read_filter
    from ial.bouncing.filters.piece_filter import PieceFilter
    from ial.bouncing.stream import parse_stream
    from ial.cli.bounce import outcome, piece_outcome

    made = read_filter(filter_path)
    observations = parse_stream(_read(file) if stream is None else stream)
    record: dict[str, Any]
    if isinstance(made, PieceFilter):
        record = piece_outcome.outcome(made, observations, restart)
        if world == "closed" and record["rejected_at"]:
            raise StreamError(
                f"observation {record['rejected_at'][0]} of the stream fits no place of the environment, but the world is closed; check "
                "the map, the bouncing angle and the bounds of errors, or use the open world"
            )
        said = piece_outcome.lines(record)
    else:
        table = made.table.restarting() if restart else made.table
        record = outcome.outcome(made, table.run_closed(observations) if world == "closed" else table.run(observations))
        said = outcome.lines(record, _MOST_PLACES)
    if as_json:
        say_json(record)
    else:
        for line in said:
            say(line)
    if record["localized_at"] is None:
        raise typer.Exit(NEVER_LOCALIZED)


def _read(file: Path | None) -> str:
    if file is None or str(file) == "-":
        return sys.stdin.read()
    try:
        return file.read_text(encoding="ascii")
    except OSError as error:
        raise StreamError(f"{file}: the stream cannot be read ({error.strerror or error}); check the path") from None
    except UnicodeDecodeError:
        raise StreamError(f"{file}: the stream is no text; give a file of 0 and 1") from None
