"""Tests of the ROS reader: topics, odometry, mounting, and every kind of bad input."""

import math
import sqlite3
from pathlib import Path

import numpy as np
import pytest
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

from ial.datasets.conversion import convert
from ial.datasets.opening import open_recording
from ial.datasets.scan import BeamClass
from ial.errors import RecordingError
from ial.pose import Pose

OLIN = "olin_mac_tb4/original/macfirst_floor_take_2"
HALF = math.sqrt(0.5)


def test_the_real_bag_agrees_with_its_arrays(data_folder: Path) -> None:
    recording = open_recording(data_folder / OLIN)
    readings = list(recording.readings())
    assert dict(recording.skipped) == {"no odometry": 3}
    with np.load(data_folder / "olin_mac_tb4" / "scans.npz") as file:
        arrays = dict(file)
    for reading in readings:
        assert abs(arrays["t"][reading.index] * 1e9 - reading.stamp_ns) < 1000
        hits = reading.scan.classes() == BeamClass.HIT
        assert (hits == ~(arrays["invalid"][reading.index] | (arrays["ranges"][reading.index] >= 12.0))).all()
        assert (reading.scan.ranges[hits] == arrays["ranges"][reading.index][hits]).all()
        assert (reading.odometry.x, reading.odometry.y) == pytest.approx(arrays["odom"][reading.index][:2], abs=1e-6)
    mounting = readings[0].scan.mounting
    assert (mounting.x, mounting.y, mounting.yaw) == pytest.approx((0.00393584, 0.0, math.pi / 2))


def test_a_folder_and_its_bare_file_are_the_same(data_folder: Path, canonical_steps) -> None:  # type: ignore[no-untyped-def]
    folder = data_folder / OLIN
    (file,) = folder.glob("*.db3")
    assert canonical_steps(open_recording(folder)) == canonical_steps(open_recording(file))


def test_scans_get_the_odometry_of_their_stamp(bag) -> None:  # type: ignore[no-untyped-def]
    with bag:
        bag.mounting(translation=(0.3, 0.1, 0.2))
        for tenth in range(5):
            bag.odometry(1.0 + 0.1 * tenth, x=float(tenth))
        for stamp in (0.95, 1.0, 1.15, 1.4, 1.45):
            bag.scan(stamp)
    recording = open_recording(bag.path)
    readings = list(recording.readings())
    assert [reading.index for reading in readings] == [1, 2, 3]
    assert [reading.odometry.x for reading in readings] == pytest.approx([0.0, 1.5, 4.0])
    assert [reading.odometry.error_m for reading in readings] == pytest.approx([0.0, 0.5, 0.0])
    assert dict(recording.skipped) == {"no odometry": 2}
    assert (readings[0].scan.mounting.x, readings[0].scan.mounting.y) == (0.3, 0.1)


def test_odometry_may_come_from_tf(bag) -> None:  # type: ignore[no-untyped-def]
    with bag:
        bag.mounting()
        bag.transform(1.0, "/odom", "/base_link", (1.0, 2.0, 0.0), (0.0, 0.0, HALF, HALF))
        bag.scan(1.0)
    (reading,) = open_recording(bag.path).readings()
    assert reading.odometry.pose == Pose(1.0, 2.0, pytest.approx(math.pi / 2))


def test_tf_can_be_preferred(bag) -> None:  # type: ignore[no-untyped-def]
    with bag:
        bag.mounting()
        bag.odometry(1.0, x=5.0)
        bag.transform(1.0, "odom", "base_link", (1.0, 2.0, 0.0))
        bag.scan(1.0)
    assert next(open_recording(bag.path).readings()).odometry.x == 5.0
    assert next(open_recording(bag.path, odom_topic="/tf").readings()).odometry.x == 1.0


def test_the_mounting_may_be_a_chain_and_may_come_on_tf(bag) -> None:  # type: ignore[no-untyped-def]
    with bag:
        bag.transform(0.0, "base_link", "plate", (0.2, 0.0, 0.1), (0.0, 0.0, HALF, HALF), "/tf_static")
        for stamp in (1.0, 2.0):
            bag.transform(stamp, "plate", "laser", (0.1, 0.0, 0.0), (0.0, 0.0, HALF, HALF))
            bag.odometry(stamp)
            bag.scan(stamp)
    mounting = next(open_recording(bag.path).readings()).scan.mounting
    assert (mounting.x, mounting.y, abs(mounting.yaw)) == pytest.approx((0.2, 0.1, math.pi))
    assert not mounting.upside_down


def test_a_laser_may_hang_upside_down(bag) -> None:  # type: ignore[no-untyped-def]
    yaw = 0.7
    with bag:
        bag.mounting(quaternion=(math.cos(yaw / 2), math.sin(yaw / 2), 1e-5, 0.0))
        bag.odometry(1.0)
        bag.scan(1.0)
    scan = next(open_recording(bag.path).readings()).scan
    assert scan.mounting.upside_down
    assert scan.mounting.yaw == pytest.approx(yaw, abs=1e-4)
    assert scan.bearings()[0][0] == pytest.approx(0.5)


@pytest.mark.parametrize(("degrees", "fits"), [(1.9, True), (2.1, False), (178.1, True), (90.0, False)])
def test_a_tilt_is_refused_with_its_value(bag, degrees: float, fits: bool) -> None:  # type: ignore[no-untyped-def]
    half = math.radians(degrees) / 2
    with bag:
        bag.mounting(quaternion=(0.0, math.sin(half), 0.0, math.cos(half)))
        bag.odometry(1.0)
        bag.scan(1.0)
    recording = open_recording(bag.path)
    if fits:
        assert next(recording.readings()).scan.mounting.upside_down == (degrees > 90.0)
    else:
        with pytest.raises(RecordingError, match=f"tilted by {degrees:.2f}°"):
            list(recording.readings())


def test_without_a_mounting_the_option_is_named(bag) -> None:  # type: ignore[no-untyped-def]
    with bag:
        bag.odometry(1.0)
        bag.scan(1.0)
    with pytest.raises(RecordingError, match="--laser-pose X Y YAW"):
        list(open_recording(bag.path).readings())
    mounting = next(open_recording(bag.path, laser_pose=Pose(0.1, 0.2, 0.3)).readings()).scan.mounting
    assert (mounting.x, mounting.y, mounting.yaw) == pytest.approx((0.1, 0.2, 0.3))


def test_no_scan_topic_lists_the_topics(bag) -> None:  # type: ignore[no-untyped-def]
    with bag:
        bag.odometry(1.0)
    with pytest.raises(RecordingError, match=r"no topic with laser scans.*/odom \(nav_msgs/msg/Odometry, 1\)"):
        list(open_recording(bag.path).readings())


def test_of_two_scan_topics_one_must_be_chosen(bag) -> None:  # type: ignore[no-untyped-def]
    with bag:
        bag.mounting()
        bag.odometry(1.0)
        bag.scan(1.0, "/front")
        bag.scan(1.0, "/rear", range_max=5.0)
    with pytest.raises(RecordingError, match=r"/front, /rear; choose one with --scan-topic"):
        list(open_recording(bag.path).readings())
    assert next(open_recording(bag.path, ["/rear"]).readings()).scan.range_max == 5.0
    with pytest.raises(RecordingError, match="/side is not in the recording"):
        list(open_recording(bag.path, ["/side"]).readings())
    with pytest.raises(RecordingError, match="/odom has the type nav_msgs/msg/Odometry"):
        list(open_recording(bag.path, ["/odom"]).readings())
    assert any("--scan-topic" in fault for fault in open_recording(bag.path).info().missing)


def test_several_lidars_follow_one_another_by_their_stamps(bag) -> None:  # type: ignore[no-untyped-def]
    with bag:
        bag.mounting(child="front", translation=(0.3, 0.0, 0.2))
        bag.mounting(child="rear", translation=(-0.3, 0.0, 0.2), quaternion=(0.0, 0.0, 1.0, 0.0))
        for tenth in range(6):
            bag.odometry(1.0 + 0.1 * tenth, x=float(tenth))
        for stamp in (1.0, 1.2, 1.4):  # recorded in another order than that of the stamps
            bag.scan(stamp + 0.1, "/rear", "rear")
            bag.scan(stamp, "/front", "front")
    recording = open_recording(bag.path, ["/front", "/rear"])
    readings = list(recording.readings())
    assert [reading.scan.frame_id for reading in readings] == ["front", "rear"] * 3
    assert [reading.odometry.x for reading in readings] == pytest.approx([0.0, 1.0, 2.0, 3.0, 4.0, 5.0])
    assert [reading.scan.mounting.x for reading in readings[:2]] == [0.3, -0.3]
    assert not recording.repaired
    assert set(recording.info().mountings) == {"front", "rear"}
    with pytest.raises(RecordingError, match=r"several lidars .*which --laser-pose cannot place"):
        list(open_recording(bag.path, ["/front", "/rear"], laser_pose=Pose()).readings())


def test_scans_of_two_lidars_may_have_one_stamp(bag, tmp_path: Path, canonical_steps) -> None:  # type: ignore[no-untyped-def]
    with bag:
        bag.mounting(child="front")
        bag.mounting(child="rear", translation=(-0.3, 0.0, 0.2))
        for second in (1.0, 1.1):
            bag.odometry(second)
            bag.scan(second, "/front", "front")
            bag.scan(second, "/rear", "rear")
    recording = open_recording(bag.path, ["/rear", "/front"])
    readings = list(recording.readings())
    assert readings[1].stamp_ns - readings[0].stamp_ns == 1
    assert not recording.repaired
    for name in ("again.mcap", "again.bag"):
        convert(recording, tmp_path / name)
        assert canonical_steps(open_recording(tmp_path / name)) == canonical_steps(recording)


def test_of_two_odometry_topics_one_must_be_chosen(bag) -> None:  # type: ignore[no-untyped-def]
    with bag:
        bag.mounting()
        bag.odometry(1.0, x=1.0)
        bag.odometry(1.0, x=2.0, topic="/odom_filtered")
        bag.scan(1.0)
    with pytest.raises(RecordingError, match="--odom-topic"):
        list(open_recording(bag.path).readings())
    assert next(open_recording(bag.path, odom_topic="/odom_filtered").readings()).odometry.x == 2.0


def test_scans_without_odometry_are_an_error_that_says_what_to_record(bag) -> None:  # type: ignore[no-untyped-def]
    with bag:
        bag.mounting()
        bag.scan(1.0)
    with pytest.raises(RecordingError, match=r"no odometry.*record /odom or /tf"):
        list(open_recording(bag.path).readings())


def test_stamps_that_repeat_or_go_back_are_repaired(bag) -> None:  # type: ignore[no-untyped-def]
    with bag:
        bag.mounting()
        bag.odometry(0.5)
        bag.odometry(1.0)
        for stamp in (0.8, 0.8, 0.6, 0.9):
            bag.scan(stamp)
    recording = open_recording(bag.path)
    assert [reading.stamp_ns // 10**6 for reading in recording.readings()] == [800, 801, 802, 900]
    assert sum(recording.repaired.values()) == 2


def test_scans_that_make_no_sense_are_skipped_and_counted(bag) -> None:  # type: ignore[no-untyped-def]
    with bag:
        bag.mounting()
        bag.odometry(0.5)
        bag.odometry(1.0)
        bag.scan(0.6, ranges=np.empty(0, dtype=np.float32))
        bag.scan(0.7, angle_increment=0.0)
        bag.scan(0.8, angle_min=math.nan)
        bag.scan(0.9, ranges=np.array([math.nan, math.inf, -math.inf, 1.0], dtype=np.float32))
    recording = open_recording(bag.path)
    (reading,) = recording.readings()
    assert reading.scan.classes().tolist() == [BeamClass.INVALID, BeamClass.NO_RETURN, BeamClass.TOO_NEAR, BeamClass.HIT]
    assert sum(recording.skipped.values()) == 3


def test_odometry_that_is_no_number_is_left_out(bag) -> None:  # type: ignore[no-untyped-def]
    with bag:
        bag.mounting()
        bag.odometry(1.0, x=math.nan)
        bag.odometry(1.1)
        bag.scan(1.0)
        bag.scan(1.1)
    recording = open_recording(bag.path)
    assert [reading.index for reading in recording.readings()] == [1]
    assert sum(recording.repaired.values()) == 1


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


def test_info_lists_what_is_there(bag) -> None:  # type: ignore[no-untyped-def]
    with bag:
        bag.mounting()
        for stamp in (1.0, 1.5, 2.0):
            bag.odometry(stamp, x=stamp)
            bag.scan(stamp)
    info = open_recording(bag.path).info()
    assert (info.scans, info.beams, info.duration_s, info.scan_rate_hz, info.path_m) == (3, [3], 1.0, 2.0, 1.0)
    assert info.frames == {"base": "base_link", "laser": "laser"}
    assert {topic.name for topic in info.topics} == {"/scan", "/odom", "/tf_static"}
    assert info.missing == []
