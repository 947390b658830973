import math

import pytest

from ial.datasets.opening import open_recording
from ial.errors import RecordingError
from ial.pose import Pose

HALF = math.sqrt(0.5)


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
