"""`TrajectoryFile`: the poses of a localized robot, as a TUM file."""

from contextlib import AbstractContextManager
from pathlib import Path
from types import TracebackType

from ial.datasets.recording import Step
from ial.datasets.trajectory import Trajectory, write_tum
from ial.lidar.estimate import Estimate
from ial.pose import Pose


class TrajectoryFile(AbstractContextManager["TrajectoryFile"]):
    """The pose ``T_map_base`` of exactly those scans that have one: those at which the robot is localized.

    Parameters
    ----------
    path
        The file; empty if the robot was never localized.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        self._poses: list[tuple[int, Pose]] = []

    def add(self, step: Step, estimate: Estimate) -> None:
        """Take one scan."""
        if estimate.pose is not None:
            self._poses.append((step.stamp_ns, estimate.pose))

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        if kind is None:
            write_tum(Trajectory.of(self._poses), self._path)
