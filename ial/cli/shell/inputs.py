"""`Inputs`: the recording and the map that a command reads, as its options name them."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from ial.datasets.opening import open_recording
from ial.datasets.recording import Recording
from ial.datasets.sample import sample_map_path, sample_recording_path
from ial.maps.grids.loading import load_map
from ial.maps.grids.map_metadata import Semantics
from ial.maps.grids.occupancy_grid import OccupancyGrid
from ial.pose import Pose


@dataclass(frozen=True)
class Inputs:
    """Where the recording and the map are, and how to read them.

    Parameters
    ----------
    recording, map_path
        Their paths; the embedded sample and its map where None.
    scan_topics, odom_topic
        As in `open_recording`.
    laser_pose
        x, y (m) and yaw (rad) of `open_recording`'s.
    semantics, map_topic
        As in `load_map`.
    """

    recording: Path | None = None
    map_path: Path | None = None
    scan_topics: Sequence[str] | None = None
    odom_topic: str | None = None
    laser_pose: Sequence[float] | None = None
    semantics: Semantics = "nav2"
    map_topic: str | None = None

    @property
    def paths(self) -> tuple[Path, Path]:
        """Where the recording and the map are."""
        return self.recording or sample_recording_path(), self.map_path or sample_map_path()

    @property
    def mounting(self) -> Pose | None:
        """``T_base_laser``, if it is given in place of what the recording says."""
        return None if self.laser_pose is None else Pose(*self.laser_pose)

    def source(self) -> Recording:
        """Open the recording.

        Raises
        ------
        RecordingError
            If it cannot be read.
        """
        return open_recording(self.paths[0], self.scan_topics or (), self.odom_topic, self.mounting)

    def grid(self) -> OccupancyGrid:
        """Read the map.

        Raises
        ------
        MapError
            If it cannot be read.
        """
        return load_map(self.paths[1], self.semantics, self.map_topic)
