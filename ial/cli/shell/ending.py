"""`Ending`: how a command that waits for input is asked to end, and does so between two pieces of work."""

import os
import signal
import time
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager
from types import FrameType, TracebackType
from typing import Any, BinaryIO, TypeVar

from ial.errors import StreamError

Result = TypeVar("Result")

_PAUSE_S = 0.1  # between two looks at a file that grows


class _EndError(Exception):
    """The process was asked to end while it waited for input."""


class Ending(AbstractContextManager["Ending"]):
    """Ends a loop on SIGTERM or SIGINT: at once while it waits, else after the work at hand."""

    def __init__(self) -> None:
        self.wanted = False
        self._waits = False
        self._before: dict[int, Any] = {}

    def __enter__(self) -> "Ending":
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

    def _wait(self, work: Callable[[], Result]) -> Result:
        self._waits = True
        try:
            return work()
        finally:
            self._waits = False

    def lines(self, file: BinaryIO) -> Iterator[bytes]:
        """Yield the lines of a file; waiting for one may be interrupted."""
        while not self.wanted:
            line = self._wait(file.readline)
            if not line:
                return
            yield line

    def growing_lines(self, file: BinaryIO, name: str) -> Iterator[bytes]:
        """Yield the lines of a file that still grows, each when it is complete, until the process is asked to end.

        Raises
        ------
        StreamError
            If the file becomes shorter: something else writes it anew.
        """
        begun = b""
        while not self.wanted:
            begun += self._wait(file.readline)
            if begun.endswith(b"\n"):
                yield begun
                begun = b""
            elif os.fstat(file.fileno()).st_size < file.tell():
                raise StreamError(f"{name}: the file has become shorter while it was read; follow a file to which lines are only added")
            else:
                self._wait(lambda: time.sleep(_PAUSE_S))
