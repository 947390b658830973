"""The one rule about what commands write: nothing that exists is replaced unless the user asks for it, and nothing that is read ever is.

Every command asks here before it does any work. The exception is the folder of an earlier run: its files are replaced together, as long as
they are still what that run has written (`ial.results.lidar.result_folder.written_by_a_run`).
"""

import os
import stat
from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from pathlib import Path

from ial.cli.shell.terminal import shown
from ial.errors import MapError, OutputError

Place = Path | int
"""A file: by its path, or open, by its number."""

STDIN, STDOUT = 0, 1


def check_outputs(outputs: Sequence[Path], inputs: Iterable[Place | None], overwrite: bool) -> None:
    """Refuse to write files that exist, unless they may be overwritten; and those that `check_places` refuses.

    Parameters
    ----------
    outputs
        The files that are to be written.
    inputs
        What is read, see `check_places`.
    overwrite
        Whether the user has allowed that files are replaced.

    Raises
    ------
    OutputError
        If one must not be written; nothing has changed then.
    """
    check_places(outputs, inputs)
    for out in outputs:
        if os.path.lexists(out) and not overwrite:  # a link that leads nowhere is something, too
            raise OutputError(f"{out}: exists already; choose another file, or let it be replaced with --overwrite")


def check_places(outputs: Sequence[Place], inputs: Iterable[Place | None]) -> None:
    """Refuse to write where nothing can be written, and where something else would be lost that the command reads or writes.

    Parameters
    ----------
    outputs
        What is to be written.
    inputs
        What is read: files, recordings that are folders, maps with their images; None is passed over.

    Raises
    ------
    OutputError
        If an output is no file, lies in no folder that can be written, is an input under any name, or is another output.
    """
    read = [file for each in inputs if each is not None for file in _files(each)]
    for number, out in enumerate(outputs):
        if isinstance(out, Path):
            _check_file(out)
        if any(_same(out, each) for each in read):
            raise OutputError(f"{_name(out)}: this is an input of the command, which its output would replace; give another file")
        if any(_same(out, each) for each in outputs[:number]):
            raise OutputError(f"{_name(out)}: is to be written twice; give each output a file of its own")


def check_folder(folder: Path, names: Sequence[str], inputs: Iterable[Place | None], overwrite: bool) -> bool:
    """Refuse a folder with files that a run would replace, unless they are those of an earlier run, or may be overwritten.

    Parameters
    ----------
    folder
        Where the results are to be written; it need not exist.
    names
        The files of the results, the record of the run first.
    inputs, overwrite
        As in `check_outputs`.

    Returns
    -------
    bool
        Whether there are files that will be replaced.

    Raises
    ------
    OutputError
        If the folder must not be used; nothing has changed then.
    """
    from ial.results.lidar.result_folder import written_by_a_run

    present = [name for name in names if os.path.lexists(folder / name)]
    check_places([folder / name for name in present], inputs)
    own = written_by_a_run(folder, names) if present and not overwrite else set()
    foreign = [name for name in present if name not in own]
    if foreign and not overwrite:
        raise OutputError(
            f"{folder}: {', '.join(foreign)} there {'is' if len(foreign) == 1 else 'are'} not, or not any more, what a run of this command "
            "has written; choose another folder, or let it be replaced with --overwrite"
        )
    return bool(present)


def _check_file(out: Path) -> None:
    """Refuse what is no plain file, and folders in which none can be made."""
    try:
        if not out.name or out.is_dir():
            raise OutputError(f"{out}: is a folder; name the file in it that shall be written")
        if not out.parent.is_dir():
            raise OutputError(f"{out}: cannot be written, since there is no folder {out.parent}; make it, or choose another folder")
        if out.exists() and not out.is_file():
            raise OutputError(f"{out}: is a device or a pipe; choose a file")
        if not os.access(out.parent, os.W_OK | os.X_OK):
            raise OutputError(f"{out}: cannot be written, since nothing may be written in its folder; choose another folder")
    except OSError as error:
        raise OutputError(f"{out}: cannot be written ({error.strerror or error}); choose another file") from None


def _files(place: Place) -> Iterator[Place]:
    """Yield the files that are read with one: those in a folder, and the image beside a map."""
    yield place
    if isinstance(place, int):
        return
    with suppress(OSError, MapError):  # a configuration is no map; what cannot be read is refused where it is read
        if place.is_dir():
            yield from place.iterdir()
        elif place.suffix in (".yaml", ".yml"):
            from ial.maps.grids.map_metadata import read_metadata

            yield read_metadata(place).image


def _same(one: Place, other: Place) -> bool:
    """Return whether two places are the same file, under whatever names: links of both kinds, and paths with `..`."""
    if isinstance(one, Path) and isinstance(other, Path) and os.path.realpath(one) == os.path.realpath(other):
        return True
    try:
        first, second = os.stat(one), os.stat(other)  # noqa: PTH116 - of open files as well
    except OSError:  # one does not exist, or is closed
        return False
    return stat.S_ISREG(first.st_mode) and os.path.samestat(first, second)


def _name(place: Place) -> str:
    return shown(place) if isinstance(place, Path) else "standard output"
