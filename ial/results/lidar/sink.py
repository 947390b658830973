"""`Sink`: one file of a result, fed scan by scan."""

from types import TracebackType
from typing import Any, Protocol

from ial.datasets.recording import Step
from ial.lidar.estimate import Estimate


class Sink(Protocol):
    """A context manager whose file is complete when the block ends without an error, and may be left half otherwise.

    The name and the final place of the file are the business of `ResultFolder`.
    """

    def __enter__(self) -> Any: ...

    def add(self, step: Step, estimate: Estimate) -> None:
        """Take one processed scan and what it left of the possible poses."""
        ...

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None: ...
