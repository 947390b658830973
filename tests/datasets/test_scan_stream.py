import gzip
import io
import json
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ial.datasets.conversion import convert_to_lines
from ial.datasets.in_memory import InMemoryRecording
from ial.datasets.odometry import Odometry
from ial.datasets.odometry_buffer import OdometryBuffer
from ial.datasets.opening import open_recording
from ial.datasets.recording import Reading
from ial.datasets.sample import sample_recording
from ial.datasets.scan import Mounting
from ial.datasets.scan_stream import ScanStream
from ial.errors import RecordingError
from ial.pose import Pose


def odometry(at: float, x: float = 0.0, **more: object) -> bytes:
    return json.dumps({"odometry": {"stamp": f"{at:.9f}", "x": x, "y": 0.0, "theta": 0.0, **more}}).encode()


def scan(at: float, **changes: object) -> bytes:
    record = {"stamp": f"{at:.9f}", "angle_min": -0.5, "angle_increment": 0.5, "ranges": [1.0, 2.0, None], **changes}
    return json.dumps({"scan": {name: value for name, value in record.items() if value != "absent"}}).encode()


def read(*lines: bytes) -> list[Reading]:
    return list(ScanStream(lines).readings())


@pytest.mark.parametrize("mounting", [Mounting(), Mounting(0.1, -0.2, 2.9), Mounting(0.3, 0.4, -1.1, upside_down=True)])
def test_lines_read_back_to_the_bit(mounting: Mounting, tmp_path: Path, readings, canonical_steps) -> None:  # type: ignore[no-untyped-def]
    source = InMemoryRecording("synthetic", readings(mounting=mounting))
    path = tmp_path / "copy.jsonl"
    with path.open("w") as file:
        assert convert_to_lines(source, file) == 12
    assert canonical_steps(open_recording(path)) == canonical_steps(source)
    packed = tmp_path / "copy.jsonl.gz"
    packed.write_bytes(gzip.compress(path.read_bytes()))
    assert canonical_steps(open_recording(packed)) == canonical_steps(source)
    assert all(json.loads(line, parse_constant=pytest.fail) for line in path.read_text().splitlines())


@pytest.mark.slow
@pytest.mark.parametrize("name", ["intel_lab/intel-corrected.log.gz", "olin_mac_tb4/original/macfirst_floor_take_2"])
def test_real_recordings_read_back_to_the_bit(name: str, data_folder: Path, tmp_path: Path, canonical_steps) -> None:  # type: ignore[no-untyped-def]
    source = open_recording(data_folder / name)
    path = tmp_path / "copy.jsonl"
    with path.open("w") as file:
        convert_to_lines(source, file)
    assert canonical_steps(open_recording(path)) == canonical_steps(source)


def test_the_sample_reads_back_with_its_numbers() -> None:
    file = io.StringIO()
    convert_to_lines(sample_recording(), file)
    copies = read(*file.getvalue().encode().splitlines())
    assert [(each.index, each.stamp_ns) for each in copies] == [(each.index, each.stamp_ns) for each in sample_recording().readings()]


def test_a_scan_waits_until_its_odometry_is_known_and_no_longer() -> None:
    taken: list[int] = []

    def feed() -> Iterator[bytes]:
        for number, line in enumerate(
            [odometry(1.0), scan(1.1), scan(1.15), odometry(1.12, 0.2), odometry(1.2, 1.0), scan(1.2), scan(9.0)]
        ):
            taken.append(number)
            yield line

    readings = ScanStream(feed()).readings()
    assert (next(readings).stamp_ns, taken[-1]) == (1_100_000_000, 3)
    assert (next(readings).stamp_ns, taken[-1]) == (1_150_000_000, 4)
    assert (next(readings).stamp_ns, taken[-1]) == (1_200_000_000, 5)
    assert next(readings, None) is None


@given(st.lists(st.tuples(st.booleans(), st.integers(1, 400)), min_size=2, max_size=60), st.randoms())
def test_the_odometry_of_a_scan_is_that_of_the_whole_buffer(events: list[tuple[bool, int]], random) -> None:  # type: ignore[no-untyped-def]
    """Whatever the order of arrival within a tenth of a second, as long as both kinds come in order."""
    lines, samples, scans, stamp = [], [], [], 0
    for is_scan, gap in events:
        stamp += gap * 10**6
        seconds = stamp / 1e9
        if is_scan:
            scans.append(stamp)
            lines.append((stamp + random.randrange(10**8), scan(seconds)))
        else:
            x = random.uniform(-1.0, 1.0)
            samples.append((stamp, Odometry.of(Pose(x, 0.0, 0.0))))
            lines.append((stamp, odometry(seconds, x)))
    buffer = OdometryBuffer(samples)
    expected = [(stamp, streamed) for stamp in scans if (streamed := buffer.at(stamp)) is not None]
    # Scans may not overtake each other.
    ordered = sorted(lines, key=lambda line: line[0])
    late = iter([line for _, line in lines if b"scan" in line[:8]])
    stream = ScanStream([next(late) if b"scan" in line[:8] else line for _, line in ordered])
    try:
        streamed = [(reading.stamp_ns, reading.odometry) for reading in stream.readings()]
    except RecordingError:
        streamed = []
    assert streamed == expected


def test_what_a_line_may_leave_out() -> None:
    (reading,) = read(odometry(1.0, 2.0, error_m=0.1), scan(1.0, ranges=[1.5, "inf", "-inf", None], laser={"yaw": 0.5}))
    assert reading.odometry == Odometry(2.0, 0.0, 0.0, 1.0, 0.1, 0.0)
    assert reading.scan.ranges.tobytes() == np.array([1.5, np.inf, -np.inf, np.nan], dtype=np.float32).tobytes()
    assert reading.scan.mounting.yaw == pytest.approx(0.5)
    assert (reading.scan.range_min, reading.scan.range_max) == (0.0, np.inf)


@pytest.mark.parametrize(
    ("line", "reason"),
    [
        (b"nonsense", "neither odometry nor a scan"),
        (b"[1, 2]", "neither odometry nor a scan"),
        (b'{"scan": 3}', "neither odometry nor a scan"),
        (b'{"image": {}}', "neither odometry nor a scan"),
        (b'{"scan": {"stamp": "1.0"', "neither odometry nor a scan"),
        (b"[" * 100_000, "neither odometry nor a scan"),
        (scan(1.0, ranges="absent"), "no key 'ranges'"),
        (scan(1.0, range_maximum=3.0), "unknown key 'range_maximum'"),
        (scan(1.0, ranges=[[1.0]]), "neither odometry nor a scan"),
        (scan(1.0, ranges=[]), "scan without beams"),
        (scan(1.0, laser={"roll": 3.0}), "laser has other keys"),
        (scan(1.0, laser={"upside_down": "false"}), "laser has other keys"),
        (scan(1.0, stamp="noon"), "neither odometry nor a scan"),
        (scan(5.0), "no odometry"),
    ],
)
def test_a_bad_line_is_skipped_and_counted_by_its_reason(line: bytes, reason: str) -> None:
    stream = ScanStream([odometry(1.0), line, scan(1.0), odometry(1.1)])
    assert len(list(stream.readings())) == 1
    ((said, count),) = stream.skipped.items()
    assert reason in said
    assert count == 1


@pytest.mark.parametrize("bad", [{"x": None}, {"x": float("nan")}, {"stamp": "noon"}, {"error_m": -1.0}, {"theta": "east"}])
def test_bad_odometry_is_left_out_and_counted(bad: dict[str, object]) -> None:
    stream = ScanStream([odometry(1.0), odometry(1.05, **bad), odometry(0.5), scan(1.0)])
    assert [reading.odometry.x for reading in stream.readings()] == [0.0]
    assert stream.repaired == {"odometry line that cannot be read: left out": 1, "odometry older than the one before: left out": 1}


@pytest.mark.slow
def test_memory_stays_flat_when_only_one_kind_arrives() -> None:
    import tracemalloc

    def feed(line) -> Iterator[bytes]:  # type: ignore[no-untyped-def]
        yield from (odometry(0.0), scan(0.0))
        for number in range(6_000):
            yield line(1.0 + 0.02 * number)

    for line in (odometry, scan):
        tracemalloc.start()
        assert len(list(ScanStream(feed(line)).readings())) == 1
        assert tracemalloc.get_traced_memory()[1] < 600_000
        tracemalloc.stop()


def test_a_stream_says_what_it_holds() -> None:
    info = ScanStream([odometry(1.0), scan(1.0)], "stdin").info()
    assert info.format == "JSON lines"
