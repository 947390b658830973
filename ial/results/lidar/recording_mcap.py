"""`RecordingFile`: a run as a ROS 2 recording, to look at in Foxglove or RViz."""

from contextlib import AbstractContextManager
from pathlib import Path
from types import TracebackType

from ial.datasets import ros_messages as ros
from ial.datasets.bag_writer import BagWriter
from ial.datasets.recording import Step
from ial.lidar.estimate import Estimate
from ial.maps.grids.occupancy_grid import OccupancyGrid
from ial.pose import Pose
from ial.results.lidar.markers import enclosure_markers
from ial.results.lidar.thinning import thinned

MAP, ODOM, BASE = "map", "odom", "base_link"
_GROWTH = 1.03  # a path is written again when it has grown by this factor, so that the file grows with the run, not with its square
_TF = "tf2_msgs/msg/TFMessage"


class RecordingFile(AbstractContextManager["RecordingFile"]):
    """``result.mcap``: all messages carry the stamps of the scans.

    ===============  ==================================  =============================================================================
    topic            type                                content
    ===============  ==================================  =============================================================================
    ``/map``         nav_msgs/OccupancyGrid              the map, once, for late subscribers too
    ``/scan``        sensor_msgs/LaserScan               each processed scan
    ``/tf_static``   tf2_msgs/TFMessage                  base_link → laser
    ``/tf``          tf2_msgs/TFMessage                  odom → base_link as recorded, and map → odom while the robot is localized: a
                                                         localizer corrects the odometry, REP-105
    ``/enclosures``  visualization_msgs/MarkerArray      every pose that the data allow, as boxes and hulls
    ``/pose``        geometry_msgs/PoseStamped           the pose of base_link in the map, while localized
    ``/path``        nav_msgs/Path                       the poses so far, of a long run a selection
    ===============  ==================================  =============================================================================

    Parameters
    ----------
    path
        The file, whose name ends in ``.mcap``.
    grid
        The map.
    """

    def __init__(self, path: Path, grid: OccupancyGrid) -> None:
        self._bag = BagWriter(path)
        self._grid = grid
        self._frames: set[str] = set()
        self._path: list[tuple[int, Pose]] = []
        self._poses = self._written = 0
        self._last_ns = 0

    def __repr__(self) -> str:
        return f"<RecordingFile: {self._bag.path}>"

    def add(self, step: Step, estimate: Estimate) -> None:
        """Write the messages of one scan."""
        bag, stamp = self._bag, step.stamp_ns
        if not self._frames:
            bag.write("/map", "nav_msgs/msg/OccupancyGrid", stamp, ros.map_message(bag, stamp, MAP, self._grid), latched=True)
        if step.scan.frame_id not in self._frames:
            self._write_mounting(step)
        self._last_ns = stamp
        transforms = [ros.transform(bag, stamp, ODOM, BASE, step.odometry.pose)]
        if estimate.pose is not None:
            transforms.append(ros.transform(bag, stamp, MAP, ODOM, estimate.pose @ step.odometry.pose.inverse()))
        bag.write("/tf", _TF, stamp, ros.transforms_message(bag, transforms))
        bag.write("/scan", "sensor_msgs/msg/LaserScan", stamp, ros.scan_message(bag, step.scan))
        markers = enclosure_markers(bag, stamp, MAP, self._grid, estimate)
        bag.write("/enclosures", "visualization_msgs/msg/MarkerArray", stamp, markers)
        if estimate.pose is not None:
            bag.write("/pose", "geometry_msgs/msg/PoseStamped", stamp, ros.stamped_pose(bag, stamp, MAP, estimate.pose))
            self._path.append((stamp, estimate.pose))
            self._path = thinned(self._path)
            self._poses += 1
            if self._poses >= _GROWTH * self._written:
                self._write_path()

    def _write_mounting(self, step: Step) -> None:
        bag, stamp, frame = self._bag, step.stamp_ns, step.scan.frame_id
        mounting = ros.mounting_transform(bag, stamp, BASE, frame, step.scan.mounting)
        bag.write("/tf_static", _TF, stamp, ros.transforms_message(bag, [mounting]), latched=True)
        self._frames.add(frame)

    def _write_path(self) -> None:
        poses = [ros.stamped_pose(self._bag, stamp, MAP, pose) for stamp, pose in self._path]
        self._bag.write("/path", "nav_msgs/msg/Path", self._last_ns, ros.path_message(self._bag, self._last_ns, MAP, poses))
        self._written = self._poses

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        if kind is None and self._written < self._poses:
            self._write_path()
        self._bag.__exit__(kind, error, trace)
