"""`Streaming`: what `ial stream` was asked to do, and the doing of it. Nothing here imports what only results and recordings need."""

import os
import signal
import sys
from collections import Counter
from collections.abc import Iterator
from contextlib import AbstractContextManager, ExitStack
from dataclasses import dataclass
from pathlib import Path
from types import FrameType, TracebackType
from typing import Any, BinaryIO

from ial.cli.terminal import remark
from ial.datasets.opening import open_recording
from ial.datasets.recording import Recording
from ial.datasets.scan_stream import ScanStream
from ial.errors import OutputError
from ial.lidar.checkpoint import Checkpoint, fingerprint
from ial.lidar.config import LocalizerConfig
from ial.lidar.localizer import Localizer
from ial.lidar.run import localize
from ial.lidar.warming import warm
from ial.maps.loading import load_map
from ial.maps.map_metadata import Semantics
from ial.pose import Pose
from ial.results.enclosures import enclosure_line
from ial.results.latencies import Latencies

_OPENING = b'{"stamp": '


class _EndError(Exception):
    """The process was asked to end while it waited for input."""


class _Ending(AbstractContextManager["_Ending"]):
    """Ends a loop on SIGTERM or SIGINT: at once while it waits, else after the scan at hand."""

    def __init__(self) -> None:
        self.wanted = False
        self._waits = False
        self._before: dict[int, Any] = {}

    def __enter__(self) -> "_Ending":
        for number in (signal.SIGTERM, signal.SIGINT):
            self._before[number] = signal.signal(number, self._asked)
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> bool:
        for number, handler in self._before.items():
            signal.signal(number, handler)
        return kind is _EndError

    def _asked(self, number: int, frame: FrameType | None) -> None:
        self.wanted = True
        if self._waits:
            raise _EndError

    def lines(self, file: BinaryIO) -> Iterator[bytes]:
        """Yield the lines of a file; waiting for one may be interrupted."""
        while not self.wanted:
            self._waits = True
            line = file.readline()
            self._waits = False
            if not line:
                return
            yield line


@dataclass(frozen=True)
class Streaming:
    """One run of the localizer over a stream.

    Parameters
    ----------
    recording
        A recording to read; standard input if there is none.
    map_path, semantics, map_topic
        As in `load_map`.
    config
        The configuration of the localizer.
    out
        The file to write to; standard output if there is none.
    state
        The file of the checkpoint, if one is kept.
    laser_pose
        As in `open_recording`.
    """

    recording: Path | None
    map_path: Path
    config: LocalizerConfig
    out: Path | None = None
    state: Path | None = None
    laser_pose: Pose | None = None
    semantics: Semantics = "nav2"
    map_topic: str | None = None

    def run(self) -> None:
        """Write one line for each scan until the input ends, or the process is asked to end.

        Raises
        ------
        IalError
            If an input cannot be used or the lines cannot be written.
        """
        if self.state is not None and not self.state.parent.is_dir():
            raise OutputError(f"{self.state}: there is no folder {self.state.parent} to keep the state in; make it, or choose another")
        times = Latencies()
        statuses: Counter[str] = Counter()
        with ExitStack() as stack:
            ending = stack.enter_context(_Ending())
            localizer = Localizer(load_map(self.map_path, self.semantics, self.map_topic), config=self.config)
            checkpoint = None if self.state is None else Checkpoint.load(self.state, localizer)
            if checkpoint is not None:
                localizer.resume(checkpoint.poses, same_start=True)
            file = self._opened(stack, checkpoint)
            warm(self.config)
            mine = fingerprint(localizer)
            if checkpoint is not None:
                remark("note", f"goes on behind scan {checkpoint.mark.index}, as {self.state} says", "cyan")
            source = self._source(ending)
            for step, estimate in localize(source, localizer, after=None if checkpoint is None else checkpoint.mark):
                self._write(file, enclosure_line(step, estimate, timed=False))
                if self.state is not None:
                    written = 0 if self.out is None else file.tell()
                    Checkpoint(step.mark, localizer.poses, written, mine).save(self.state)
                times.add(estimate.elapsed_s)
                statuses[estimate.status] += 1
                if ending.wanted:
                    break
        _close(source, statuses, times)

    def _source(self, ending: _Ending) -> Recording:
        if self.recording is not None:
            return open_recording(self.recording, laser_pose=self.laser_pose)
        return ScanStream(ending.lines(sys.stdin.buffer), "standard input", self.laser_pose)

    def _opened(self, stack: ExitStack, checkpoint: Checkpoint | None) -> BinaryIO:
        """Return the file to write to, cut to what the checkpoint knows of: a line behind that is written once more."""
        if self.out is None:
            return sys.stdout.buffer
        written = 0 if checkpoint is None else checkpoint.written
        if self.out.is_dir():
            raise OutputError(f"{self.out}: is a folder; name the file in it that shall hold the lines")
        try:
            held = self.out.stat().st_size if self.out.exists() else 0
            if held < written:
                raise OutputError(f"{self.out}: holds {held} bytes, but {self.state} knows of {written}; remove both to begin anew")
            if held and checkpoint is None and not (self.state is not None and _begun(self.out)):
                raise OutputError(f"{self.out}: exists already; give the --state it belongs to, or another file")
            file = stack.enter_context(self.out.open("r+b" if held else "w+b"))
            file.truncate(written)
            file.seek(written)
        except OSError as error:
            raise OutputError(f"{self.out}: cannot be written ({error.strerror or error}); choose another file") from None
        return file

    def _write(self, file: BinaryIO, line: str) -> None:
        try:
            file.write(line.encode())
            file.flush()
        except BrokenPipeError:
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # what closes at exit shall not fail again
            raise OutputError("nobody reads the lines any more; the state, if one is kept, is that before this line") from None
        except OSError as error:
            raise OutputError(
                f"{self.out or 'standard output'}: cannot be written ({error.strerror or error}); is the disk full?"
            ) from None


def _begun(path: Path) -> bool:
    """Return whether a file holds nothing but a first line, or its beginning: killed there, a run has not written its state yet."""
    with path.open("rb") as file:
        line = file.readline()
        return line[: len(_OPENING)] == _OPENING[: len(line)] and not file.read(1)


def _close(source: Recording, statuses: Counter[str], times: Latencies) -> None:
    """Say on stderr what came in, and how long it took."""
    for counts, kind in ((source.skipped, "skipped"), (source.repaired, "repaired")):
        for reason, count in counts.items():
            remark(kind, f"{count} × {reason}", "yellow")
    scans = sum(statuses.values())
    words = ", ".join(f"{count} {status}" for status, count in statuses.most_common())
    remark("note", f"{scans} scans: {words}; {times}" if scans else "no scan came", "cyan")
