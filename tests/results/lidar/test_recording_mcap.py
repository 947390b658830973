import math
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from rosbags.highlevel import AnyReader
from rosbags.interfaces import QosDurability
from rosbags.typesys import Stores, get_typestore

from ial.datasets.opening import open_recording
from ial.datasets.sample import sample_grid, sample_recording
from ial.maps.grids.grid_message import read_map_topic
from ial.maps.grids.occupancy_grid import OccupancyGrid
from ial.pose import Pose
from ial.results.lidar.recording_mcap import RecordingFile

BOX = [(1.0, 1.6), (3.0, 3.4), (0.1, 0.2)]


def written(path: Path, grid: OccupancyGrid, run: list[Any]) -> Path:
    with RecordingFile(path, grid) as file:
        for step, estimate in run:
            file.add(step, estimate)
    return path


def messages(path: Path) -> list[tuple[str, int, Any]]:
    """Every message, which must also serialize to the very bytes that it was read from."""
    read = []
    with AnyReader([path], default_typestore=get_typestore(Stores.ROS2_JAZZY)) as reader:
        for connection, stamp, data in reader.messages():
            message = reader.deserialize(data, connection.msgtype)
            assert bytes(reader.typestore.serialize_cdr(message, connection.msgtype)) == bytes(data)
            read.append((connection.topic, stamp, message))
    return read


def pose_of(transform: Any) -> Pose:
    shift, turn = transform.transform.translation, transform.transform.rotation
    return Pose.from_quaternion(shift.x, shift.y, turn.z, turn.w)


def stamp_of(header: Any) -> int:
    return int(header.stamp.sec) * 10**9 + int(header.stamp.nanosec)


@pytest.fixture(scope="module")
def sample_file(sample_run: list[Any], tmp_path_factory: pytest.TempPathFactory) -> Path:
    return written(tmp_path_factory.mktemp("mcap") / "result.mcap", sample_grid(), sample_run)


def test_every_message_reads_back_at_the_stamps_of_the_scans(sample_file: Path, sample_run: list[Any]) -> None:
    read = messages(sample_file)
    stamps = [step.stamp_ns for step, _ in sample_run]
    localized = sum(estimate.pose is not None for _, estimate in sample_run)
    counts = Counter(topic for topic, _, _ in read)
    assert counts["/scan"] == counts["/tf"] == counts["/enclosures"] == len(sample_run)
    assert (counts["/map"], counts["/tf_static"], counts["/pose"]) == (1, 1, localized)
    assert {stamp for _, stamp, _ in read} == set(stamps)
    assert [stamp_of(message.header) for topic, _, message in read if topic == "/scan"] == stamps


def test_map_and_mounting_reach_late_subscribers(sample_file: Path) -> None:
    with AnyReader([sample_file]) as reader:
        for connection in reader.connections:
            durability = {profile.durability for profile in connection.ext.offered_qos_profiles}  # type: ignore[union-attr]
            assert (durability == {QosDurability.TRANSIENT_LOCAL}) is (connection.topic in ("/map", "/tf_static"))


def test_transforms_compose_to_the_pose(sample_file: Path, sample_run: list[Any]) -> None:
    trees = [message.transforms for topic, _, message in messages(sample_file) if topic == "/tf"]
    for transforms, (step, estimate) in zip(trees, sample_run, strict=True):
        edges = {(each.header.frame_id, each.child_frame_id): pose_of(each) for each in transforms}
        assert (edges[("odom", "base_link")].x, edges[("odom", "base_link")].y) == (step.odometry.x, step.odometry.y)
        assert (("map", "odom") in edges) is (estimate.pose is not None)
        if estimate.pose is not None:
            pose = edges[("map", "odom")] @ edges[("odom", "base_link")]
            assert math.dist((pose.x, pose.y), (estimate.pose.x, estimate.pose.y)) < 1e-9
            assert abs(math.remainder(pose.theta - estimate.pose.theta, 2.0 * math.pi)) < 1e-9


def test_the_last_path_holds_all_poses(sample_file: Path, sample_run: list[Any]) -> None:
    *_, path = (message for topic, _, message in messages(sample_file) if topic == "/path")
    positions = [(pose.pose.position.x, pose.pose.position.y) for pose in path.poses]
    assert positions == [(estimate.pose.x, estimate.pose.y) for _, estimate in sample_run if estimate.pose is not None]


def test_the_file_is_a_recording_of_the_same_scans_with_its_map(sample_file: Path) -> None:
    recorded = {reading.stamp_ns: reading for reading in sample_recording().readings()}
    for reading in open_recording(sample_file).readings():
        assert reading.scan.ranges.tobytes() == recorded[reading.stamp_ns].scan.ranges.tobytes()
        assert reading.scan.mounting == recorded[reading.stamp_ns].scan.mounting
    assert (read_map_topic(sample_file).cells == sample_grid().cells).all()


def test_markers_show_boxes_hulls_and_what_is_only_predicted(estimate_of: Callable[..., Any], grid: OccupancyGrid, tmp_path: Path) -> None:
    run = [estimate_of(1, BOX), estimate_of(2, BOX, status="blind", unconfirmed=True), estimate_of(3, status="blind")]
    arrays = [message for topic, _, message in messages(written(tmp_path / "a.mcap", grid, run)) if topic == "/enclosures"]
    shown = [{marker.ns for marker in array.markers if marker.action == 0} for array in arrays]
    assert shown == [{"boxes", "hypotheses"}, {"prediction", "predicted hypotheses"}, set()]
    assert all({marker.ns for marker in array.markers} == shown[0] | shown[1] for array in arrays)
    boxes = next(marker for marker in arrays[0].markers if marker.ns == "boxes")
    corners = np.array([(point.x, point.y) for point in boxes.points])
    assert (corners.min(axis=0).tolist(), corners.max(axis=0).tolist()) == ([1.0, 3.0], [1.6, 3.4])
    assert (boxes.pose.position.x, boxes.pose.position.y) == (grid.origin.x, grid.origin.y)


def test_an_upside_down_lidar_stays_upside_down(estimate_of: Callable[..., Any], grid: OccupancyGrid, tmp_path: Path) -> None:
    step, estimate = estimate_of(1, BOX)
    (reading,) = open_recording(written(tmp_path / "a.mcap", grid, [(step, estimate)])).readings()
    assert reading.scan.mounting == step.scan.mounting


def test_an_interrupted_run_leaves_no_file(grid: OccupancyGrid, estimate_of: Callable[..., Any], tmp_path: Path) -> None:
    def run() -> None:
        with RecordingFile(tmp_path / "result.mcap", grid) as file:
            file.add(*estimate_of(1, BOX))
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run()
    assert list(tmp_path.iterdir()) == []
