"""Tests of the reader of L and O lines."""

from pathlib import Path

import numpy as np
import pytest

from ial.datasets.beesoft import BeesoftLog
from ial.errors import RecordingError


@pytest.mark.parametrize(("number", "count"), [(1, 713), (4, 600)])
def test_the_real_logs_agree_with_their_arrays(data_folder: Path, number: int, count: int) -> None:
    log = BeesoftLog(data_folder / "wean_hall" / "original" / f"robotdata{number}.log.gz")
    readings = list(log.readings())
    assert len(readings) == count
    mounting = readings[0].scan.mounting
    assert (mounting.x, mounting.y, mounting.yaw) == pytest.approx((0.25, 0.0, 0.0), abs=1e-6)
    with np.load(data_folder / "wean_hall" / f"robotdata{number}.npz") as arrays:
        for reading, ranges, pose, invalid in zip(readings, arrays["ranges"], arrays["odom"], arrays["invalid"], strict=True):
            assert (reading.scan.ranges == ranges).all()
            assert ((reading.scan.classes() != 0) == invalid).all()
            assert (reading.odometry.x, reading.odometry.y) == pytest.approx(pose[:2])


def test_units_are_metres_and_faults_are_counted(tmp_path: Path) -> None:
    path = tmp_path / "test.log"
    path.write_text("O 0 0 0 0.1\nL 100 200 0 125 200 0 150 8183 0.5\nL 1 2\nL x 0 0 0 0 0 1 1 2.0\nL 0 0 0 0 0 0 3.0\nL 0 0 0 1")
    log = BeesoftLog(path)
    (reading,) = log.readings()
    assert (reading.odometry.x, reading.odometry.y, reading.stamp_ns) == (1.0, 2.0, 500_000_000)
    assert reading.scan.mounting.x == 0.25
    assert reading.scan.ranges.tolist() == [1.5, float(np.float32(81.83))]
    assert reading.scan.classes().tolist() == [0, 1]
    assert sum(log.skipped.values()) == 4
    assert log.skipped["scan without beams"] == 1


def test_a_log_without_scans_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "test.log"
    path.write_text("O 0 0 0 0.1\n")
    with pytest.raises(RecordingError, match="no scan"):
        list(BeesoftLog(path).readings())
