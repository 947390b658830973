"""`TrajectoryFile`: the poses of a localized robot, as a TUM file."""

from contextlib import AbstractContextManager
from pathlib import Path
from types import TracebackType

from ial.datasets.recording import Step
from ial.datasets.trajectory import tum_line
from ial.lidar.estimate import Estimate


class TrajectoryFile(AbstractContextManager["TrajectoryFile"]):
    """The pose ``T_map_base`` of exactly those scans that have one: those at which the robot is localized.

    Parameters
    ----------
    path
        The file; empty if the robot was never localized.
    """

    def __init__(self, path: Path) -> None:
        self._file = path.open("w", encoding="utf-8")

    def __repr__(self) -> str:
        return f"<TrajectoryFile: {self._file.name}>"

    def add(self, step: Step, estimate: Estimate) -> None:
        """Take one scan."""
        if estimate.pose is not None:
            self._file.write(tum_line(step.stamp_ns, estimate.pose))

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self._file.close()
