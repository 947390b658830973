"""Reference poses for the scans of a recording: those of a trajectory, or those that the localizer finds itself."""

from collections.abc import Iterator
from typing import Literal, Protocol

from ial.datasets.recording import Recording, Step, steps
from ial.datasets.trajectory import Trajectory
from ial.lidar.configuration.config import LocalizerConfig
from ial.lidar.localizer import Localizer
from ial.lidar.run import localize
from ial.maps.grids.occupancy_grid import OccupancyGrid
from ial.pose import Pose

TruthFrame = Literal["base", "laser"]
"""Whose poses a reference trajectory holds."""


class Truth(Protocol):
    """Poses over time: a trajectory, or one that grows while a robot drives."""

    def at(self, stamp_ns: int) -> Pose | None:
        """Return the pose at a time in nanoseconds, None where there is none."""
        ...


def reference_poses(
    recording: Recording,
    truth: Trajectory,
    frame: TruthFrame,
    config: LocalizerConfig,
    start: int = 0,
    stop: int | None = None,
    every: int = 1,
) -> Iterator[tuple[Step, Pose | None]]:
    """Yield each scan with ``T_map_base`` of a reference trajectory, or None where it has none."""
    for step in steps(recording, config.bounds.motion, start, stop, every):
        yield step, base_pose(truth, frame, step)


def base_pose(truth: Truth, frame: TruthFrame, step: Step) -> Pose | None:
    """Return ``T_map_base`` of a reference at a scan, None where it has none."""
    pose = truth.at(step.stamp_ns)
    return pose if pose is None or frame == "base" else pose @ step.scan.mounting.pose.inverse()


def own_poses(
    recording: Recording, grid: OccupancyGrid, config: LocalizerConfig, start: int = 0, stop: int | None = None, every: int = 1
) -> Iterator[tuple[Step, Pose | None]]:
    """Yield each scan with the pose at which it is localized, or None.

    What is measured with these is circular: a scan that breaks its bounds is not localized, or at another place, so beams look better than
    they are; and the poses are middles of hypotheses, which makes motions look worse.
    """
    for step, estimate in localize(recording, Localizer(grid, config=config), start=start, stop=stop, every=every):
        yield step, estimate.pose
