"""`write_whole`: files that appear under their names only when all of them are complete."""

import errno
import os
from collections.abc import Mapping
from pathlib import Path

from ial.errors import OutputError


def write_whole(files: Mapping[Path, bytes], what: str) -> None:
    """Write files under temporary names, and rename them.

    Parameters
    ----------
    files
        The content of each.
    what
        What they hold, for the message of an error.

    Raises
    ------
    OutputError
        If one cannot be written, or is a folder. Then nothing is left of those that were begun.
    """
    temporary = {path: path.with_name(f".{path.name}.part") for path in files}
    path = next(iter(files))
    try:
        for path in files:
            if path.is_dir():  # known before others are renamed
                raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
        for path, content in files.items():
            temporary[path].write_bytes(content)
        for path, part in temporary.items():
            part.replace(path)
    except OSError as error:
        for part in temporary.values():
            if part.parent.is_dir():
                part.unlink(missing_ok=True)
        raise OutputError(f"{path}: {what} cannot be written ({error.strerror or error}); choose a folder that is writable") from None
