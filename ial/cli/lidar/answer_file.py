"""`AnswerFile`: the file of `ial stream --out`, to which lines are added and in which nothing is ever changed."""

import os
from contextlib import AbstractContextManager
from io import FileIO
from pathlib import Path
from types import TracebackType

from ial.errors import OutputError
from ial.lidar.output_end import KEPT, OutputEnd


class AnswerFile(AbstractContextManager["AnswerFile"]):
    """A file of one run, which knows it again after a stop.

    Before each line the state is told what the file holds and what comes next (`before`); then the line is written (`append`). Wherever a
    run is killed, its file is as the last state says, and after that a beginning of the line that the state holds. Any other file is
    refused. The file itself is made with the first line.

    Parameters
    ----------
    path
        The file.
    known
        What the state of an earlier run says about it; None if there is no such run.
    overwrite
        Whether a file that is there before the first line may be replaced.

    Raises
    ------
    OutputError
        If it is not the file that the state knows. Nothing has changed then: nothing does before the block is entered.
    """

    def __init__(self, path: Path, known: OutputEnd | None, overwrite: bool) -> None:
        self._path = path
        self._name = os.path.realpath(path)
        self._file: FileIO | None = None
        self._length, self._end, self._missing = 0, b"", b""
        self._exists = False
        self._replaces = overwrite and (known is None or known.length == 0)
        if known is not None:
            self._recognize(known)

    def __enter__(self) -> "AnswerFile":
        """Write what is missing of the line at which a run was killed."""
        if self._missing:
            self.append(self._missing)
        return self

    def before(self, line: str) -> OutputEnd:
        """Return what a state has to know before a line is written."""
        return OutputEnd.of(self._name, self._length, self._end, line)

    def append(self, content: bytes) -> None:
        """Write at the end.

        Raises
        ------
        OutputError
            If it cannot be written, or if something else has written to the file or has cut it.
        """
        try:
            file = self._file = self._file or self._opened()
            size = os.fstat(file.fileno()).st_size
            if size != self._length:
                raise OutputError(f"{self._path}: holds {size} bytes, and this run has written {self._length}: something else changes it")
            left = memoryview(content)
            while left:
                left = left[file.write(left) :]
        except OSError as error:
            raise OutputError(f"{self._path}: cannot be written ({error.strerror or error}); is the disk full?") from None
        self._length += len(content)
        self._end = (self._end + content)[-KEPT:]

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        if self._file is not None:
            self._file.close()

    def _recognize(self, known: OutputEnd) -> None:
        if self._name != known.path:
            raise OutputError(f"{self._path}: the state belongs to {known.path}; give that as --out, or this file a --state of its own")
        try:
            with self._path.open("rb") as file:
                file.seek(max(0, known.length - KEPT))
                end = file.read(KEPT + len(known.line.encode()) + 1)
            self._exists = True
        except FileNotFoundError:
            end = b""
        except OSError as error:
            raise OutputError(f"{self._path}: cannot be read ({error.strerror or error}); it is needed to go on after its end") from None
        missing = known.rest(end)
        if missing is not None:
            self._replaces = False
            self._length, self._end = known.length + len(known.line.encode()) - len(missing), end
            self._missing = missing
        elif self._replaces:
            self._missing = known.line.encode()
        else:
            raise OutputError(
                f"{self._path}: is not, or not any more, what the run of the state has written, which holds {known.length} bytes; "
                "put that back, or begin anew with another --out and --state"
            )

    def _opened(self) -> FileIO:
        if self._replaces:
            self._path.unlink(missing_ok=True)
        elif self._exists:
            file = self._path.open("r+b", buffering=0)
            file.seek(0, os.SEEK_END)
            return file
        return self._path.open("xb", buffering=0)
