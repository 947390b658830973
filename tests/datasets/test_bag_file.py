import sqlite3
from pathlib import Path

import numpy as np
import pytest
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

from ial.datasets.opening import open_recording
from ial.errors import RecordingError
from ial.pose import Pose


@pytest.mark.parametrize("kept", [0.02, 0.3, 0.7, 0.99])
def test_a_truncated_bag_is_refused(bag, kept: float) -> None:  # type: ignore[no-untyped-def]
    with bag:
        bag.mounting()
        for stamp in range(1, 200):
            bag.odometry(float(stamp))
            bag.scan(float(stamp))
    data = bag.path.read_bytes()
    bag.path.write_bytes(data[: int(kept * len(data))])
    with pytest.raises(RecordingError, match=r"truncated.*reindex"):
        list(open_recording(bag.path).readings())


@pytest.mark.slow
def test_damage_in_the_middle_never_escapes_as_another_error(bag) -> None:  # type: ignore[no-untyped-def]
    with bag:
        bag.mounting()
        for stamp in range(1, 20):
            bag.odometry(float(stamp))
            bag.scan(float(stamp))
    data = bag.path.read_bytes()
    random = np.random.default_rng(3)
    for _ in range(25):
        at = int(random.integers(20, len(data) - 20))
        bag.path.write_bytes(data[:at] + random.bytes(12) + data[at + 12 :])
        try:
            readings = list(open_recording(bag.path).readings())
        except RecordingError:
            continue
        assert all(len(reading.scan) for reading in readings)


def _old_bag(folder: Path, kind: str = "sensor_msgs/msg/LaserScan") -> Path:
    """Write a ROS 2 bag in SQLite, then remove the definitions of its messages, as bags were before ROS 2 Iron."""
    store = get_typestore(Stores.ROS2_JAZZY)
    types = store.types
    stamp = types["builtin_interfaces/msg/Time"](sec=1, nanosec=0)
    header = types["std_msgs/msg/Header"](stamp=stamp, frame_id="laser")
    empty = np.empty(0, dtype=np.float32)
    scan = types["sensor_msgs/msg/LaserScan"](header, -0.5, 0.5, 0.5, 0.0, 0.0, 0.1, 10.0, np.ones(3, dtype=np.float32), empty)
    shift, turn = types["geometry_msgs/msg/Vector3"](1.0, 2.0, 0.0), types["geometry_msgs/msg/Quaternion"](0.0, 0.0, 0.0, 1.0)
    transform = types["geometry_msgs/msg/Transform"](shift, turn)
    odom = types["std_msgs/msg/Header"](stamp=stamp, frame_id="odom")
    tf = types["tf2_msgs/msg/TFMessage"]([types["geometry_msgs/msg/TransformStamped"](odom, "base_link", transform)])
    path = folder / "old"
    with Writer(path, version=8, storage_plugin=StoragePlugin.SQLITE3) as writer:
        for topic, name, message in (("/scan", "sensor_msgs/msg/LaserScan", scan), ("/tf", "tf2_msgs/msg/TFMessage", tf)):
            connection = writer.add_connection(topic, name, typestore=store)
            writer.write(connection, 10**9, store.serialize_cdr(message, name))
    (file,) = path.glob("*.db3")
    database = sqlite3.connect(file)
    database.execute("DELETE FROM message_definitions")
    if kind != "sensor_msgs/msg/LaserScan":
        database.execute("UPDATE topics SET type = ? WHERE name = '/tf'", (kind,))
    database.commit()
    database.close()
    return file


def test_old_bags_without_definitions_get_the_usual_ones(tmp_path: Path) -> None:
    path = _old_bag(tmp_path)
    for each in (path, path.parent):
        (reading,) = open_recording(each, laser_pose=Pose()).readings()
        assert (reading.odometry.x, reading.odometry.y) == (1.0, 2.0)


def test_a_truncated_database_is_refused(tmp_path: Path) -> None:
    path = _old_bag(tmp_path)
    path.write_bytes(path.read_bytes()[:-4096])
    for each in (path, path.parent):
        with pytest.raises(RecordingError, match=r"truncated.*reindex"):
            list(open_recording(each).readings())


def test_a_database_that_was_not_closed_is_refused(tmp_path: Path) -> None:
    path = _old_bag(tmp_path)
    path.with_name(path.name + "-wal").write_bytes(b"x")
    with pytest.raises(RecordingError, match="not closed"):
        list(open_recording(path).readings())


def test_a_bag_whose_index_promises_more_is_refused(tmp_path: Path) -> None:
    metadata = _old_bag(tmp_path).with_name("metadata.yaml")
    metadata.write_text(metadata.read_text().replace("message_count: 1", "message_count: 5"))
    with pytest.raises(RecordingError, match="promises 5 messages"):
        list(open_recording(metadata.parent, laser_pose=Pose()).readings())


def test_an_unknown_message_type_is_named(tmp_path: Path) -> None:
    from ial.datasets.bag_file import BagFile

    path = _old_bag(tmp_path, "robot_msgs/msg/Bumper")
    with BagFile(path) as bag, pytest.raises(RecordingError, match=r"robot_msgs/msg/Bumper on /tf.*record the bag with definitions"):
        list(bag.messages(["/tf"]))
    with pytest.raises(RecordingError, match="no odometry"):
        list(open_recording(path).readings())
