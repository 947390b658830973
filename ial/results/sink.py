"""`Sink`: one file of a result, fed scan by scan."""

from contextlib import AbstractContextManager
from typing import Protocol

from ial.datasets.recording import Step
from ial.lidar.estimate import Estimate


class Sink(AbstractContextManager["Sink"], Protocol):
    """A file that is complete when its block ends without an error, and may be left half otherwise.

    The name and the final place of the file are the business of `ResultFolder`.
    """

    def add(self, step: Step, estimate: Estimate) -> None:
        """Take one processed scan and what it left of the possible poses."""
        ...
