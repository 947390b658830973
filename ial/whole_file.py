"""Files that have their names only when they are complete."""

import errno
import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

from ial.errors import OutputError


@contextmanager
def whole_files(*paths: str | Path, what: str = "the file") -> Iterator[tuple[Path, ...]]:
    """Lend a new, empty file beside each of the paths; they get those names together when the block ends without an error.

    Until then whatever has one of those names is left alone. If the block ends with an error, that stays, and the lent files are removed.
    Their own names are made up, so they replace nothing either. A file that has come by one of the names meanwhile is not replaced: what
    was to be there keeps its made-up name, which the error tells.

    Parameters
    ----------
    paths
        The names.
    what
        What the files hold, for the message of an error.

    Raises
    ------
    OutputError
        If one cannot be written.
    """
    wanted = [Path(path) for path in paths]
    path = wanted[0]
    lent: list[Path] = []
    free = [not os.path.lexists(each) for each in wanted]
    try:
        for path in wanted:
            if path.is_dir():  # known before any other is renamed
                raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
            part = path.with_name(f".{path.name}-{os.urandom(4).hex()}.part")
            part.open("xb").close()
            lent.append(part)
        yield tuple(lent)
        give_names(list(zip(lent, wanted, free, strict=True)))
    except OutputError:
        lent.clear()
        raise
    except OSError as error:
        raise OutputError(
            f"{path}: {what} cannot be written ({error.strerror or error}); choose another folder, or make room in this one"
        ) from None
    finally:
        for part in lent:
            with suppress(OSError):
                part.unlink(missing_ok=True)


def give_names(files: Sequence[tuple[Path, Path, bool]]) -> None:
    """Give files their names, in order.

    Parameters
    ----------
    files
        Each file, its name, and whether nothing had that name when the work began; nothing is replaced then.

    Raises
    ------
    OutputError
        If something has such a name by now.
    OSError
        If a file cannot be renamed.
    """
    check_names(files)
    for part, path, free in files:
        if not free or not _linked(part, path):
            part.replace(path)


def check_names(files: Sequence[tuple[Path, Path, bool]]) -> None:
    """Raise as `give_names` does, and change nothing."""
    for part, path, free in files:
        if free and os.path.lexists(path):
            raise _come(path, part)


def _come(path: Path, part: Path) -> OutputError:
    return OutputError(f"{path}: has come into being while this was at work, and is left alone; the result is in {part}")


def _linked(part: Path, path: Path) -> bool:
    """Give a file a second name that nothing has, in one step; return whether the file system can."""
    try:
        path.hardlink_to(part)
    except FileExistsError:
        raise _come(path, part) from None
    except OSError:
        return False
    part.unlink()
    return True


def rewrite(path: Path, content: bytes | memoryview, what: str) -> None:
    """Replace a file that is replaced often; a process that is killed meanwhile leaves the one before.

    It may leave half a file, too. So that these do not gather, they have one name (`unfinished`), which the next call takes again.

    Raises
    ------
    OutputError
        If it cannot be written.
    """
    part = unfinished(path)
    try:
        part.unlink(missing_ok=True)  # were it a link, its target would be written to
        with part.open("xb") as file:
            file.write(content)
        part.replace(path)
    except OSError as error:
        with suppress(OSError):
            part.unlink(missing_ok=True)
        raise OutputError(f"{path}: {what} cannot be written ({error.strerror or error}); is the disk full?") from None


def unfinished(path: Path) -> Path:
    """Return the name under which `rewrite` writes."""
    return path.with_name(f".{path.name}.ial-part")
