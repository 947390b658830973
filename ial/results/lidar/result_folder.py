"""`ResultFolder`: the folder of a run, whose files appear together when the run is complete, and how it is known again."""

import contextlib
import hashlib
import json
import shutil
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, ExitStack, contextmanager
from pathlib import Path
from types import TracebackType
from typing import Any

from ial.datasets.recording import Step
from ial.errors import OutputError
from ial.lidar.estimate import Estimate
from ial.results.lidar.sink import Sink
from ial.whole_file import check_names, give_names


class ResultFolder(AbstractContextManager["ResultFolder"]):
    """A folder to write into, and the sinks that write there.

    Files are written in a hidden subfolder and get their names when the block ends without an error. Otherwise nothing changes: a file of
    an earlier run keeps its content, and folders that were made for this run are removed. A file that has come into being meanwhile is
    not replaced; the error says where the results are then.

    Parameters
    ----------
    path
        The folder; made if it does not exist, with its parents.

    Raises
    ------
    OutputError
        If nothing can be written there. This is found out at once, before any work is done.

    Examples
    --------
    >>> import tempfile
    >>> from ial.datasets import sample_grid, sample_recording
    >>> from ial.lidar.localizer import Localizer
    >>> from ial.lidar.run import localize
    >>> from ial.results import ResultFolder, TrajectoryFile
    >>> with tempfile.TemporaryDirectory() as out, ResultFolder(out) as folder:
    ...     folder.attach(TrajectoryFile(folder.place("trajectory.tum")))
    ...     for step, estimate in localize(sample_recording(), Localizer(sample_grid()), stop=3):
    ...         folder.add(step, estimate)
    """

    def __init__(self, path: str | Path) -> None:
        self.path = Path(path)
        self._made = [each for each in (self.path, *self.path.parents) if not each.exists()]
        self._sinks: list[Sink] = []
        self._record: str | None = None
        self._kept = False
        self._stack = ExitStack()
        try:
            self.path.mkdir(parents=True, exist_ok=True)
            self._before = {each.name for each in self.path.iterdir()}
            self._hidden = Path(tempfile.mkdtemp(prefix=".unfinished-", dir=self.path))
        except OSError as error:
            self._remove_made()
            raise OutputError(
                f"{self.path}: results cannot be written there ({error.strerror or error}); choose another folder with --out"
            ) from None

    def __repr__(self) -> str:
        return f"<ResultFolder: {self.path}, {len(self._sinks)} files fed scan by scan>"

    def place(self, name: str) -> Path:
        """Return where to write a file that will be called so."""
        return self._hidden / name

    def attach(self, *sinks: Sink) -> None:
        """Feed these sinks from now on, and close them at the end."""
        for sink in sinks:
            self.keep(sink)
            self._sinks.append(sink)

    def keep(self, *files: AbstractContextManager[Any]) -> None:
        """Close these files at the end; they are fed otherwise, within `writing`."""
        for file in files:
            self._stack.enter_context(file)

    def add(self, step: Step, estimate: Estimate) -> None:
        """Hand one scan to every sink.

        Raises
        ------
        OutputError
            If one cannot write.
        """
        with self.writing():
            for sink in self._sinks:
                sink.add(step, estimate)

    def write(self, name: str, text: str) -> None:
        """Write a whole file.

        Raises
        ------
        OutputError
            If it cannot be written.
        """
        with self.writing():
            self.place(name).write_text(text, encoding="utf-8")

    def conclude(self, name: str, record: Mapping[str, Any]) -> dict[str, Any]:
        """Write the record of the run, after all other files are complete, and return it as written.

        It gets its name last, and that of an earlier run is removed first: where a record is, the files beside it are those of one run.

        Parameters
        ----------
        name
            The file.
        record
            Plain values that JSON can hold; ``files`` is added: the SHA-256 of every other file, by which `written_by_a_run` knows them.

        Raises
        ------
        OutputError
            If it cannot be written.
        """
        with self.writing():
            whole = {**record, "files": {file.name: _sha256(file) for file in sorted(self._hidden.iterdir())}}
        self.write(name, json.dumps(whole, indent=2, allow_nan=False, ensure_ascii=False) + "\n")
        self._record = name
        return whole

    def close(self) -> None:
        """Let every sink complete its file; the files get their names at the end of the block.

        Raises
        ------
        OutputError
            If one cannot write.
        """
        with self.writing():
            self._stack.close()
        self._sinks.clear()

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        try:
            with self.writing():
                self._stack.__exit__(kind, error, trace)
                if kind is None:
                    self._name_files()
        finally:
            if not self._kept:
                shutil.rmtree(self._hidden, ignore_errors=True)
            if not any(self.path.iterdir()):
                self._remove_made()

    def _name_files(self) -> None:
        files = sorted(self._hidden.iterdir(), key=lambda file: (file.name == self._record, file.name))
        named = [(file, self.path / file.name, file.name not in self._before) for file in files]
        try:
            check_names(named)
            if self._record is not None:
                (self.path / self._record).unlink(missing_ok=True)
            give_names(named)
        except OutputError:  # something has come into being there meanwhile: the results stay where they are
            self._kept = True
            raise

    def _remove_made(self) -> None:
        for folder in self._made:
            with contextlib.suppress(OSError):
                folder.rmdir()

    @contextmanager
    def writing(self) -> Iterator[None]:
        """Write into the folder within the block, by hand.

        Raises
        ------
        OutputError
            In place of an `OSError` of the block.
        """
        try:
            yield
        except OSError as error:
            raise OutputError(f"{self.path}: the results cannot be written ({error.strerror or error}); is the disk full?") from None


def written_by_a_run(folder: Path, names: Sequence[str]) -> set[str]:
    """Return which files in a folder are still what a run has written there.

    Parameters
    ----------
    folder
        The folder.
    names
        The files of a run's results, its record first (`ResultFolder.conclude`). Without such a record no file is known.
    """
    record, *others = names
    try:
        files = json.loads((folder / record).read_text(encoding="utf-8"))["files"]
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        return set()
    if not isinstance(files, dict) or sorted(files) != sorted(others):
        return set()
    with contextlib.suppress(OSError):
        return {record, *(name for name in others if (folder / name).is_file() and _sha256(folder / name) == files[name])}
    return set()


def _sha256(path: Path) -> str:
    digest = hashlib.sha256()
    with path.open("rb") as file:
        while part := file.read(1 << 20):
            digest.update(part)
    return digest.hexdigest()
