"""Tests of writing a recording and reading it back."""

from pathlib import Path

import pytest

from ial.datasets.conversion import convert
from ial.datasets.in_memory import InMemoryRecording
from ial.datasets.opening import open_recording
from ial.datasets.recording import Reading
from ial.datasets.scan import LaserScan, Mounting
from ial.errors import OutputError

KINDS = ["mcap", "bag"]


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("name", ["intel_lab/intel-corrected.log.gz", "olin_mac_tb4/original/macfirst_floor_take_2"])
def test_real_recordings_read_back_to_the_bit(kind: str, name: str, data_folder: Path, tmp_path: Path, canonical_steps) -> None:  # type: ignore[no-untyped-def]
    source = open_recording(data_folder / name)
    path = tmp_path / f"copy.{kind}"
    count = convert(source, path)
    steps = canonical_steps(source)
    assert count == len(steps)
    assert canonical_steps(open_recording(path)) == steps


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("mounting", [Mounting(), Mounting(0.1, -0.2, 2.9), Mounting(0.3, 0.4, -1.1, upside_down=True)])
def test_synthetic_recordings_read_back_to_the_bit(kind: str, mounting: Mounting, tmp_path: Path, readings, canonical_steps) -> None:  # type: ignore[no-untyped-def]
    source = InMemoryRecording("synthetic", readings(mounting=mounting))
    path = tmp_path / f"copy.{kind}"
    convert(source, path)
    copy = open_recording(path)
    assert canonical_steps(copy) == canonical_steps(source)
    convert(copy, path)
    assert canonical_steps(open_recording(path)) == canonical_steps(source)
    assert list(tmp_path.iterdir()) == [path]


def test_the_same_recording_gives_the_same_bytes(tmp_path: Path, readings) -> None:  # type: ignore[no-untyped-def]
    source = InMemoryRecording("synthetic", readings())
    for kind in KINDS:
        paths = [tmp_path / f"{name}.{kind}" for name in "ab"]
        for path in paths:
            convert(source, path)
        assert paths[0].read_bytes() == paths[1].read_bytes()


def test_other_names_and_places_are_refused(tmp_path: Path, readings) -> None:  # type: ignore[no-untyped-def]
    source = InMemoryRecording("synthetic", readings())
    with pytest.raises(OutputError, match=r"\.mcap"):
        convert(source, tmp_path / "copy.txt")
    with pytest.raises(OutputError, match="cannot be written"):
        convert(source, tmp_path / "nowhere" / "copy.bag")


def test_nothing_is_left_behind_by_a_failure(tmp_path: Path, readings) -> None:  # type: ignore[no-untyped-def]
    first, second = list(readings(2))
    scan = second.scan
    moved = LaserScan(second.stamp_ns, scan.ranges, scan.angle_min, scan.angle_increment, range_max=5.0, mounting=Mounting(1.0))
    source = InMemoryRecording("moving", [first, Reading(1, second.stamp_ns, second.odometry, moved)])
    for kind in KINDS:
        with pytest.raises(OutputError, match="changes at scan 1"):
            convert(source, tmp_path / f"copy.{kind}")
    assert list(tmp_path.iterdir()) == []


def test_a_stamp_before_the_epoch_is_refused(tmp_path: Path, readings) -> None:  # type: ignore[no-untyped-def]
    (reading,) = readings(1)
    scan = LaserScan(-1, [1.0, 2.0], 0.0, 0.1)  # type: ignore[arg-type]
    with pytest.raises(OutputError, match="cannot be written"):
        convert(InMemoryRecording("early", [Reading(0, -1, reading.odometry, scan)]), tmp_path / "copy.mcap")
