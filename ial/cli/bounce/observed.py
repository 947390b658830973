"""What a robot has observed, from an option, a file or standard input."""

import sys
from pathlib import Path
from typing import Annotated

import typer

from ial.errors import StreamError

StreamBits = Annotated[
    str | None, typer.Option("--stream", metavar="BITS", help="The observations: 1 for a bump, 0 for a step without one.")
]
StreamFile = Annotated[Path | None, typer.Option("--file", metavar="FILE", help="A file with the observations; - for standard input.")]


def observations(stream: str | None, file: Path | None) -> list[int]:
    """Return the observations of `--stream`, else of `--file`, else of standard input.

    Raises
    ------
    StreamError
        If they cannot be read, or there is another symbol.
    """
    from ial.bouncing.stream import parse_stream

    return parse_stream(_read(file) if stream is None else stream)


def _read(file: Path | None) -> str:
    if file is None or str(file) == "-":
        return sys.stdin.read()
    try:
        return file.read_text(encoding="ascii")
    except OSError as error:
        raise StreamError(f"{file}: the stream cannot be read ({error.strerror or error}); check the path") from None
    except UnicodeDecodeError:
        raise StreamError(f"{file}: the stream is no text; give a file of 0 and 1") from None
