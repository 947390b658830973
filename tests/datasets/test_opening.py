"""Tests of recognizing a recording by what it holds."""

import gzip
from pathlib import Path

import pytest

from ial.datasets.beesoft import BeesoftLog
from ial.datasets.carmen import CarmenLog
from ial.datasets.opening import open_recording
from ial.datasets.ros import RosBag
from ial.errors import RecordingError
from ial.pose import Pose

CARMEN = b"# a comment\n\nPARAM robot_width 0.4 1 host 1\nODOM 0 0 0 0 0 0 1 host 1\n"


@pytest.mark.parametrize(
    ("data", "kind"),
    [
        (CARMEN, CarmenLog),
        (gzip.compress(CARMEN, mtime=0), CarmenLog),
        (b"ROBOTLASER1 0 1\n", CarmenLog),
        (b"O 1 2 3 0.1\nL 1 2 3\n", BeesoftLog),
        (b"#ROSBAG V2.0\n", RosBag),
        (b"SQLite format 3\x00", RosBag),
        (b"\x89MCAP0\r\n", RosBag),
    ],
)
def test_the_content_decides(tmp_path: Path, data: bytes, kind: type) -> None:
    path = tmp_path / "recording.xyz"
    path.write_bytes(data)
    assert isinstance(open_recording(path), kind)


def test_a_folder_is_a_ros_2_bag_even_if_its_name_says_otherwise(tmp_path: Path) -> None:
    folder = tmp_path / "run.bag"
    folder.mkdir()
    (folder / "metadata.yaml").write_text("")
    assert isinstance(open_recording(str(folder)), RosBag)


@pytest.mark.parametrize("data", [b"hello\n", b"\x00\x01\x02", bytes(range(256)) * 5000, b"a" * 3_000_000, b"\xff\xfe"])
def test_other_files_are_refused(tmp_path: Path, data: bytes) -> None:
    path = tmp_path / "recording.log"
    path.write_bytes(data)
    with pytest.raises(RecordingError, match="not a recording of a known kind"):
        open_recording(path)


def test_what_is_missing_or_empty_is_refused(tmp_path: Path) -> None:
    with pytest.raises(RecordingError, match="no such file"):
        open_recording(tmp_path / "nothing.bag")
    (tmp_path / "empty.bag").touch()
    with pytest.raises(RecordingError, match="empty"):
        open_recording(tmp_path / "empty.bag")
    with pytest.raises(RecordingError, match=r"not a ROS 2 bag"):
        open_recording(tmp_path)
    (tmp_path / "a.db3").touch()
    with pytest.raises(RecordingError, match="ros2 bag reindex"):
        open_recording(tmp_path)


def test_a_truncated_gzip_file_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "log.gz"
    path.write_bytes(gzip.compress(CARMEN)[:20])
    with pytest.raises(RecordingError, match="gzip"):
        open_recording(path)


def test_the_laser_pose_is_handed_on(tmp_path: Path) -> None:
    path = tmp_path / "test.log"
    path.write_text("ODOM 0 0 0 0 0 0 1 host 1\nFLASER 2 1 2 0 0 0 0 0 0 1 host 1\n")
    mounting = next(open_recording(path, laser_pose=Pose(0.1, 0.2, 0.3)).readings()).scan.mounting
    assert (mounting.x, mounting.y, mounting.yaw) == pytest.approx((0.1, 0.2, 0.3))
