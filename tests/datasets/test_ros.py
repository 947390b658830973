"""Tests of the ROS reader: topics, odometry, mounting, and every kind of bad input."""

import math
from pathlib import Path

import numpy as np
import pytest

from ial.datasets.conversion import convert
from ial.datasets.opening import open_recording
from ial.datasets.scan import BeamClass
from ial.errors import RecordingError
from ial.pose import Pose

OLIN = "olin_mac_tb4/original/macfirst_floor_take_2"


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


@pytest.mark.slow
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
