"""Tests of the CARMEN reader: on real logs, on faults, and on noise."""

import gzip
import math
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from ial.datasets.carmen import CarmenLog
from ial.datasets.odometry import Odometry
from ial.datasets.recording import Reading
from ial.datasets.scan import BeamClass
from ial.datasets.trajectory import read_tum
from ial.errors import RecordingError
from ial.pose import Pose

LOGS = {
    "intel_lab": ("intel-corrected.log.gz", 910, 81.83, 4),
    "freiburg_079": ("freiburg-079-corrected.log.gz", 4791, 80.99, 0),
    "aces_austin": ("aces-corrected.log.gz", 440, 50.0, 0),
}


def flaser(ranges: list[object], laser: object = "0 0 0", robot: object = "0 0 0", stamp: object = 1.0) -> str:
    """Return a FLASER line."""
    return f"FLASER {len(ranges)} {' '.join(map(str, ranges))} {laser} {robot} {stamp} host {stamp}\n"


def odom(pose: object, stamp: object = 1.0) -> str:
    """Return an ODOM line."""
    return f"ODOM {pose} 0 0 0 {stamp} host {stamp}\n"


def robotlaser(ranges: list[object], stamp: object = 1.0, laser: object = "0 0 0", step: object = 0.5) -> str:
    """Return a ROBOTLASER1 line with two remission values."""
    sensor = f"0 -1.0 2.0 {step} 20.0 0.01 0"
    return f"ROBOTLASER1 {sensor} {len(ranges)} {' '.join(map(str, ranges))} 2 7 8 {laser} 0 0 0 0 0 0.1 0.2 0.3 {stamp} host {stamp}\n"


def _log(folder: Path, *lines: str) -> CarmenLog:
    path = folder / "test.log"
    path.write_text("".join(lines))
    return CarmenLog(path)


def _steps(poses: list[Pose]) -> list[Pose]:
    return [before.inverse() @ after for before, after in pairwise(poses)]


@pytest.mark.slow
@pytest.mark.parametrize("name", LOGS)
def test_real_logs_agree_with_their_references(name: str, data_folder: Path) -> None:
    file, count, range_max, repaired = LOGS[name]
    recording = CarmenLog(data_folder / name / file)
    readings = list(recording.readings())
    reference = read_tum(data_folder / name / "odom.tum")
    assert len(readings) == count
    assert [reading.stamp_ns for reading in readings] == reference.stamps_ns.tolist()
    assert [reading.stamp_ns for reading in readings] == read_tum(data_folder / name / "gt.tum").stamps_ns.tolist()
    assert sum(recording.repaired.values()) == repaired
    assert not recording.skipped
    assert readings[0].scan.range_max == float(np.float32(range_max))
    assert readings[0].scan.mounting.pose == Pose()
    with np.load(data_folder / name / "scans.npz") as arrays:
        assert all((reading.scan.ranges == row).all() for reading, row in zip(readings, arrays["ranges"], strict=True))
    for ours, theirs in zip(
        _steps([reading.odometry.pose for reading in readings]), _steps([reference[row] for row in range(count)]), strict=True
    ):
        assert math.hypot(ours.x - theirs.x, ours.y - theirs.y) < 1e-4
        assert abs(math.remainder(ours.theta - theirs.theta, 2.0 * math.pi)) < 1e-4


@pytest.mark.parametrize(("beams", "degrees"), [(180, 1.0), (360, 0.5), (361, 0.5), (181, 1.0)])
def test_beams_of_flaser_span_the_half_circle(tmp_path: Path, beams: int, degrees: float) -> None:
    scan = next(_log(tmp_path, odom("0 0 0"), flaser([1] * beams)).readings()).scan
    assert scan.angle_min == float(np.float32(-math.pi / 2))
    assert scan.angle_increment == float(np.float32(math.radians(degrees)))


def test_robotlaser_says_its_own_geometry(tmp_path: Path) -> None:
    (reading,) = _log(tmp_path, odom("1 2 0.5"), robotlaser([1, 2, 20, 3], laser="0.1 0 0")).readings()
    scan = reading.scan
    assert (scan.angle_min, scan.angle_increment, scan.range_max) == (-1.0, 0.5, 20.0)
    assert scan.ranges.tolist() == [1.0, 2.0, 20.0, 3.0]
    assert scan.mounting.x == 0.1
    assert reading.odometry.pose.theta == pytest.approx(0.5)


def test_the_parameter_says_what_no_return_is(tmp_path: Path) -> None:
    parameter = "PARAM robot_front_laser_max 80.99 1 host 1\n"
    scan = next(_log(tmp_path, parameter, odom("0 0 0"), flaser([81.91, 80.99, 80.98])).readings()).scan
    assert scan.classes().tolist() == [BeamClass.NO_RETURN, BeamClass.NO_RETURN, BeamClass.HIT]


@pytest.mark.parametrize(
    ("ranges", "expected"),
    [([50, 50, 50, 1], 50.0), ([50, 50, 1, 2], math.inf), ([81.91, 81.91, 81.91, 81.83], 81.83), ([0, 0, 0, 0], math.inf)],
)
def test_a_largest_reading_that_repeats_is_no_return(tmp_path: Path, ranges: list[float], expected: float) -> None:
    scan = next(_log(tmp_path, odom("0 0 0"), flaser(ranges)).readings()).scan
    assert scan.range_max == float(np.float32(expected))


def test_odometry_is_the_last_line_before_in_file_order(tmp_path: Path) -> None:
    log = _log(
        tmp_path,
        odom("1 0 0", 9),
        odom("2 0 0", 5),
        flaser([1, 2], robot="8 8 0", laser="8 8 0", stamp=1),
        odom("3 0 0", 1),
        flaser([1, 2], stamp=2),
    )
    assert [reading.odometry.x for reading in log.readings()] == [2.0, 3.0]


def test_a_raw_log_whose_robot_stands_still_is_not_taken_for_a_corrected_one(tmp_path: Path) -> None:
    log = _log(
        tmp_path,
        odom("1 0 0"),
        flaser([1, 2], "2 0 0", "2 0 0"),
        odom("2 0 0", 1.5),
        flaser([1, 2], "2 0 0", "2 0 0", 2),
        odom("2 0 0", 2.5),
    )
    assert [reading.odometry.x for reading in log.readings()] == [1.0, 2.0]


def test_a_corrected_log_rebases_its_odometry_after_each_scan(tmp_path: Path) -> None:
    log = _log(
        tmp_path,
        odom("1 0 0"),
        flaser([1, 2], "5 5 1.5", "5 5 1.5", 1),
        odom("5 5 1.5", 0),
        odom("5 6 1.5"),
        flaser([1, 2], "7 7 0", "7 7 0", 2),
        odom("7 7 0", 1e-40),
        flaser([1, 2], "9 9 0", "9 9 0", 3),
    )
    poses = [reading.odometry.pose for reading in log.readings()]
    first, second = _steps(poses)
    assert (first.x, first.y, first.theta) == pytest.approx((math.sin(1.5), math.cos(1.5), 0.0), abs=1e-12)
    assert (second.x, second.y, second.theta) == pytest.approx((0.0, 0.0, 0.0), abs=1e-12)


def test_the_two_poses_of_the_first_scan_give_the_mounting(tmp_path: Path) -> None:
    log = _log(tmp_path, odom("0 0 0"), flaser([1, 2], laser=f"1 2.25 {math.pi / 2}", robot=f"1 2 {math.pi / 2}"))
    mounting = next(log.readings()).scan.mounting
    assert (mounting.x, mounting.y, mounting.yaw) == pytest.approx((0.25, 0.0, 0.0), abs=1e-12)


def test_stamps_that_repeat_or_go_back_become_a_millisecond_later(tmp_path: Path) -> None:
    log = _log(tmp_path, odom("0 0 0"), *(flaser([1, 2], stamp=stamp) for stamp in (5, 5, 4, 5.0015, 6)))
    assert [reading.stamp_ns for reading in log.readings()] == [5_000_000_000, 5_001_000_000, 5_002_000_000, 5_003_000_000, 6_000_000_000]
    assert sum(log.repaired.values()) == 3


def test_faulty_lines_are_counted_and_keep_their_index(tmp_path: Path) -> None:
    log = _log(
        tmp_path,
        flaser([1, 2], stamp=0),
        odom("0 0 0"),
        flaser(["x", 2], stamp=1),
        flaser([1, 2], stamp=2),
        flaser([], stamp=3),
        flaser(["nan", "inf"], stamp=4),
        "ODOM nan 0 0 0 0 0 1 host 1\n",
        flaser([1, 2], stamp=5),
        odom("0 0 0"),
        flaser([1, 2], stamp=6),
        flaser([1, 2], stamp=7)[:20],
    )
    readings = list(log.readings())
    assert [reading.index for reading in readings] == [2, 4, 6]
    assert dict(log.skipped) == {
        "no odometry": 2,
        "FLASER line that cannot be read": 1,
        "scan without beams": 1,
        "FLASER line that cannot be read (the log ends within it)": 1,
    }
    assert readings[1].scan.classes().tolist() == [BeamClass.INVALID, BeamClass.NO_RETURN]
    assert len(list(log.readings())) == 3
    assert sum(log.skipped.values()) == 5, "reading twice must not count twice"


def test_an_increment_of_zero_is_skipped(tmp_path: Path) -> None:
    log = _log(tmp_path, odom("0 0 0"), robotlaser([1, 2], step=0), robotlaser([1, 2], 2.0))
    assert len(list(log.readings())) == 1
    assert log.skipped["scan with an angle increment of zero"] == 1


@pytest.mark.parametrize(
    ("lines", "message"),
    [
        ([odom("0 0 0")], "no FLASER or ROBOTLASER1 lines"),
        ([flaser([1, 2])], "no odometry"),
        ([odom("0 0 0"), flaser([])], "without beams"),
        ([odom("0 0 0"), flaser([1]), robotlaser([1])], "--scan-topic FLASER"),
    ],
)
def test_logs_without_a_usable_scan_are_refused(tmp_path: Path, lines: list[str], message: str) -> None:
    with pytest.raises(RecordingError, match=message):
        list(_log(tmp_path, *lines).readings())


def test_of_two_kinds_of_scans_one_can_be_chosen(tmp_path: Path) -> None:
    _log(tmp_path, odom("0 0 0"), flaser([1, 2, 3]), robotlaser([1, 2]))
    path = tmp_path / "test.log"
    assert len(next(CarmenLog(path, ["FLASER"]).readings()).scan) == 3
    assert len(next(CarmenLog(path, ["ROBOTLASER1"]).readings()).scan) == 2
    with pytest.raises(RecordingError, match="FLASER, ROBOTLASER1"):
        list(CarmenLog(path, ["RLASER"]).readings())
    with pytest.raises(RecordingError, match="give --scan-topic once"):
        list(CarmenLog(path, ["FLASER", "ROBOTLASER1"]).readings())


def test_a_truncated_gzip_file_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "test.log.gz"
    random = np.random.default_rng(1)
    text = "".join([odom("0 0 0"), *(flaser(random.uniform(0, 9, 50).tolist(), stamp=stamp) for stamp in range(50))])
    data = gzip.compress(text.encode())
    path.write_bytes(data)
    assert len(list(CarmenLog(path).readings())) == 50
    for damaged in (data[: len(data) // 2], data[:500] + b"\x00" * 50 + data[550:]):
        path.write_bytes(damaged)
        with pytest.raises(RecordingError, match="truncated or damaged"):
            list(CarmenLog(path).readings())


numbers = st.one_of(st.floats().map(repr), st.integers().map(str), st.sampled_from(["nan", "-inf", "1e999", "9" * 5000, "0x1", "", "é"]))
valid_lines = st.one_of(
    st.lists(numbers, max_size=5).map(lambda ranges: flaser(ranges)),
    st.builds(lambda ranges, stamp: robotlaser(ranges, stamp), st.lists(numbers, max_size=5), numbers),
    st.tuples(numbers, numbers, numbers).map(lambda pose: odom(" ".join(pose))),
    st.tuples(numbers, numbers, numbers, numbers).map(lambda words: flaser([1, 2], robot=" ".join(words[:3]), stamp=words[3])),
    numbers.map(lambda value: f"PARAM robot_front_laser_max {value} 1 host 1\n"),
    st.lists(numbers, max_size=12).map(lambda words: f"FLASER {' '.join(words)}\n"),
    st.lists(numbers, max_size=30).map(lambda words: f"ROBOTLASER1 {' '.join(words)}\n"),
)


@pytest.mark.slow
@settings(max_examples=300, suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow])
@given(st.lists(valid_lines, max_size=8).map(lambda lines: "".join(lines).encode()), st.binary(max_size=40), st.integers(0, 300))
def test_noise_is_read_or_refused_but_never_crashes(tmp_path: Path, text: bytes, noise: bytes, at: int) -> None:
    path = tmp_path / "noise.log"
    path.write_bytes(odom("0 0 0").encode() + text[:at] + noise + text[at:])
    log = CarmenLog(path)
    stamps = []
    try:
        for reading in log.readings():
            assert isinstance(reading, Reading)
            assert isinstance(reading.odometry, Odometry)
            assert reading.odometry.valid
            stamps.append(reading.stamp_ns)
    except RecordingError:
        pass  # refused: that is fine
    assert stamps == sorted(set(stamps))
    log.info()
