"""Text logs, plain or compressed with gzip, read line by line."""

import gzip
import zlib
from collections.abc import Iterator
from pathlib import Path
from typing import IO, cast

from ial.errors import RecordingError

_GZIP = b"\x1f\x8b"


def open_text(path: Path) -> IO[bytes]:
    """Open a text file, compressed or not, for reading bytes."""
    with path.open("rb") as file:
        compressed = file.read(2) == _GZIP
    return cast(IO[bytes], gzip.open(path, "rb")) if compressed else path.open("rb")


def lines(path: Path) -> Iterator[bytes]:
    """Yield the lines of a text file, compressed or not, with their line ends.

    Raises
    ------
    RecordingError
        If the file cannot be read, or if its compressed data are damaged or end too early.
    """
    try:
        with open_text(path) as file:
            yield from file
    except (EOFError, zlib.error, gzip.BadGzipFile) as error:
        raise RecordingError(
            f"{path}: its gzip data are truncated or damaged ({error}); copy the file again, or unpack what can be saved "
            "with `gzip -dc` and read that"
        ) from None
    except OSError as error:
        raise RecordingError(f"{path}: cannot be read ({error.strerror or error})") from None
