"""`RosBag`: recordings of ROS 1 and ROS 2."""

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ial.datasets.bag_file import BagFile
from ial.datasets.info import Topic
from ial.datasets.odometry_buffer import OdometryBuffer
from ial.datasets.order import in_order_of_stamps
from ial.datasets.reader import Reader, Record
from ial.datasets.ros_frames import BASE_FRAMES, frame_name, mounting_of, odometry_from_tf, odometry_of, stamp_of, take_transforms
from ial.datasets.ros_messages import ERROR_TOPIC, ERROR_TYPE, LOOKED_UP_TOPIC, ODOMETRY_TYPE
from ial.datasets.scan import Mounting, last_beam_ns
from ial.datasets.tf_buffer import TransformBuffer
from ial.errors import RecordingError
from ial.pose import Pose

SCAN_TYPE = "sensor_msgs/msg/LaserScan"
TRANSFORM_TYPES = ("tf2_msgs/msg/TFMessage", "tf/msg/tfMessage")


@dataclass(frozen=True)
class _Robot:
    """What is known of the robot before its scans are read."""

    transforms: TransformBuffer
    odometry: OdometryBuffer
    base: str


class RosBag(Reader):
    """A ROS 1 ``.bag``, a ROS 2 bag folder, or a bare ``.db3`` or ``.mcap``.

    Stamps are those of the headers. The odometry of a scan is looked up at its stamp (`OdometryBuffer`); a scan outside is skipped.

    Parameters
    ----------
    path
        The file or folder.
    scan_topics
        The LaserScan topics; needed only if there are several. Several of them are several lidars, each with its own mounting.
    odom_topic
        The Odometry topic, needed only if there are several; ``/tf`` takes the transform odom → base_link instead.
    laser_pose
        Where the laser sits, ``T_base_laser``; without it, as tf says.
    """

    format = "ROS bag"

    def __init__(self, path: Path, scan_topics: Sequence[str] = (), odom_topic: str | None = None, laser_pose: Pose | None = None) -> None:
        super().__init__(str(path))
        self._path = path
        self._scan_topics = scan_topics
        self._odom_topic = odom_topic
        self._mounting = None if laser_pose is None else Mounting(laser_pose.x, laser_pose.y, laser_pose.theta)
        self._used_frames: dict[str, str] = {}

    def _topics(self) -> list[Topic]:
        with BagFile(self._path) as bag:
            self.format = bag.format
            return bag.topics

    def _frames(self) -> dict[str, str]:
        return self._used_frames  # filled while reading

    def _records(self) -> Iterator[Record]:
        with BagFile(self._path) as bag:
            topics = self._choose_scans(bag)
            robot = self._robot(bag)
            self._used_frames["base"] = robot.base
            yield from in_order_of_stamps(self._scans(bag, topics, robot), topics)

    def _scans(self, bag: BagFile, topics: Collection[str], robot: _Robot) -> Iterator[tuple[str, Record]]:
        """Yield the scans in the order of recording, each with its topic."""
        mountings: dict[str, Mounting] = {}
        for topic, message in bag.messages(topics):
            frame = frame_name(message.header.frame_id)
            if frame not in mountings:
                if self._mounting is not None and mountings:
                    raise RecordingError(
                        f"{self.name}: its scans come from several lidars ({', '.join(mountings)}, {frame}), which --laser-pose cannot "
                        "place; leave it out and let tf say where they sit, or choose one of them with --scan-topic"
                    )
                mountings[frame] = self._mounting or mounting_of(robot.transforms, robot.base, frame, self.name)
            yield topic, _record(message, robot.odometry, mountings[frame], frame)

    def _choose_scans(self, bag: BagFile) -> list[str]:
        """Return the topics of the scans."""
        named: list[str | None] = [*dict.fromkeys(self._scan_topics)]
        chosen = [self._choose(bag, SCAN_TYPE, name, "--scan-topic") for name in named or [None]]
        topics = [topic for topic in chosen if topic is not None]
        if not topics:
            raise RecordingError(f"{self.name}: no topic with laser scans ({SCAN_TYPE}); its topics are: {_listed(bag.topics)}")
        return topics

    def _choose(self, bag: BagFile, kind: str, named: str | None, option: str) -> str | None:
        """Return the topic of a type: the one that was named, or the only one, or None if there is none."""
        if named is not None:
            types = [topic.type for topic in bag.topics if topic.name == named]
            if types != [kind]:
                fault = f"has the type {', '.join(types)}, not {kind}" if types else "is not in the recording"
                raise RecordingError(f"{self.name}: topic {named} {fault}; its topics are: {_listed(bag.topics)}")
            return named
        topics = [topic for topic in bag.of_type(kind) if topic != LOOKED_UP_TOPIC]
        if len(topics) > 1:
            also = "; several lidars are used together if each is named" if kind == SCAN_TYPE else ""
            names = ", ".join(topics)
            raise RecordingError(f"{self.name}: several topics of type {kind}: {names}; choose one with {option} {topics[0]}{also}")
        return topics[0] if topics else None

    def _robot(self, bag: BagFile) -> _Robot:
        """Read the transforms and the odometry."""
        from_tf = self._odom_topic is not None and self._odom_topic in bag.of_type(*TRANSFORM_TYPES)
        topic = None if from_tf else self._choose(bag, ODOMETRY_TYPE, self._odom_topic, "--odom-topic")
        ours = set() if from_tf else {LOOKED_UP_TOPIC, ERROR_TOPIC}.intersection(bag.of_type(ODOMETRY_TYPE, ERROR_TYPE))
        wanted = {*bag.of_type(*TRANSFORM_TYPES), *ours, *([topic] if topic else [])}
        transforms = TransformBuffer()
        odometry = OdometryBuffer()
        base = ""
        for name, message in bag.messages(wanted):
            if name in (topic, LOOKED_UP_TOPIC):
                self._take_odometry(odometry, message, looked_up=name == LOOKED_UP_TOPIC)
                base = base or frame_name(message.child_frame_id)
            elif name == ERROR_TOPIC:
                odometry.limit(stamp_of(message), message.vector.x, message.vector.z)
            else:
                take_transforms(transforms, message)
        if topic is None and LOOKED_UP_TOPIC not in ours:
            return _Robot(transforms, *odometry_from_tf(transforms, self.name))
        return _Robot(transforms, odometry, _base_frame(base, transforms))

    def _take_odometry(self, buffer: OdometryBuffer, message: Any, looked_up: bool) -> None:
        odometry = odometry_of(message)
        if odometry.valid:
            (buffer.fix if looked_up else buffer.add)(stamp_of(message), odometry)
        else:
            self.repaired["odometry message that is not finite: left out"] += 1


def _base_frame(child: str, transforms: TransformBuffer) -> str:
    """Return the robot's frame: the one the odometry names, else the usual name that tf knows."""
    known = [frame for frame in BASE_FRAMES if frame in transforms.frames]
    return child or (known[0] if known else BASE_FRAMES[0])


def _record(message: Any, odometry: OdometryBuffer, mounting: Mounting, frame: str) -> Record:
    stamp = stamp_of(message)
    names = ("ranges", "angle_min", "angle_increment", "range_min", "range_max", "time_increment")
    scan = {name: getattr(message, name) for name in names}
    sweep = odometry.sweep(stamp, last_beam_ns(stamp, message.time_increment, len(message.ranges)))
    about = {**scan, "mounting": mounting, "frame_id": frame, "sweep": sweep}
    looked_up = not odometry.holds(stamp)
    return Record(stamp, odometry.at(stamp), about, messages=lambda since: odometry.between(since, stamp), looked_up=looked_up)


def _listed(topics: list[Topic]) -> str:
    return ", ".join(f"{topic.name} ({topic.type}, {topic.count})" for topic in topics) or "none"
