"""Every message of the odometry counts, whatever lies between two scans: forth and back in a corridor, each message as wrong as it may be.

Twenty messages say +0.1 m and twenty −0.1 m; each may be wrong by 0.02 + 0.1 · 0.1 = 0.03 m and is by 0.029 m. So the odometry is where it
was, and the robot 1.16 m ahead.
"""

import json
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from ial.datasets.carmen import CarmenLog
from ial.datasets.conversion import convert, convert_to_lines
from ial.datasets.in_memory import InMemoryRecording
from ial.datasets.kidnapping import Kidnapping, kidnap
from ial.datasets.motion import ErrorBound, Motion, MotionBounds
from ial.datasets.odometry import Odometry
from ial.datasets.odometry_path import OdometryPath
from ial.datasets.opening import open_recording
from ial.datasets.recording import Reading, Recording, Step, steps
from ial.datasets.scan import LaserScan
from ial.datasets.scan_stream import ScanStream
from ial.errors import OutputError
from ial.lidar.configuration.config import Bounds, LocalizerConfig
from ial.lidar.localizer import Localizer
from ial.maps.grids.occupancy_grid import OCCUPIED, OccupancyGrid
from ial.pose import Pose

BOUNDS = MotionBounds(ErrorBound(0.02, 0.1), ErrorBound(0.0))
TRUTH, ALLOWED = 1.16, 1.2
STEP_S = 0.02
STAMPS = [1.0 + STEP_S * number for number in range(41)]
RECORDED = np.concatenate([[0.0], np.cumsum([0.1] * 20 + [-0.1] * 20)]).tolist()


def odometry(at: float, x: float) -> bytes:
    return json.dumps({"odometry": {"stamp": f"{at:.9f}", "x": x, "y": 0.0, "theta": 0.0}}).encode()


def scan(at: float, **more: Any) -> bytes:
    return json.dumps({"scan": {"stamp": f"{at:.9f}", "angle_min": 0.0, "angle_increment": 0.5, "ranges": [1.0], **more}}).encode()


def corridor(*more: tuple[float, bytes]) -> list[bytes]:
    """Return the lines of the corridor, with scans at both ends and lines that come after the message of their time."""
    lines = [*more, (STAMPS[0], scan(STAMPS[0])), (STAMPS[-1], scan(STAMPS[-1]))]
    messages = [(stamp, odometry(stamp, x)) for stamp, x in zip(STAMPS, RECORDED, strict=True)]
    return [line for _, line in sorted([*messages, *lines], key=lambda each: each[0])]


def motion(recording: Recording, **choice: Any) -> Motion:
    """Return the motion from the first scan to the last of those that are processed."""
    whole = Motion.identity()
    for step in steps(recording, BOUNDS, **choice):
        whole = whole if step.motion is None else whole.compose(step.motion)
    return whole


def check(motion: Motion) -> None:
    assert motion.contains(Pose(TRUTH))
    assert motion.contains(Pose(-TRUTH))
    assert motion.upper[0] == pytest.approx(ALLOWED, abs=1e-9)
    assert motion.upper[2] == 0.0


def test_json_lines() -> None:
    check(motion(ScanStream(corridor())))


def test_a_scan_in_between_that_cannot_be_read_drops_nothing() -> None:
    for bad in (b"nonsense", scan(STAMPS[13], ranges=[]), scan(STAMPS[13], stamp="noon"), scan(STAMPS[13], angle_increment=None)):
        stream = ScanStream(corridor((STAMPS[13], bad), (STAMPS[27], bad)))
        check(motion(stream))
        assert sum(stream.skipped.values()) == 2


def test_scans_that_are_left_out_drop_nothing() -> None:
    lines = corridor(*((STAMPS[row], scan(STAMPS[row])) for row in (7, 20, 33)))
    for every in (1, 2, 4):
        check(motion(ScanStream(lines), every=every))
    third = motion(ScanStream(lines), start=2)
    assert third.upper[0] - third.lower[0] == pytest.approx(2 * 20 * 0.03, abs=1e-9)


def test_two_lidars() -> None:
    lines = corridor(*((STAMPS[row], scan(STAMPS[row], frame_id="rear")) for row in (7, 20, 40)))
    check(motion(ScanStream(lines), stop=4))
    assert [reading.scan.frame_id for reading in ScanStream(lines).readings()] == ["laser", "rear", "rear", "rear", "laser"]


def test_a_message_that_is_missing_is_a_longer_piece_and_its_time_counts() -> None:
    lines = [line for line in corridor() if b'"1.1' not in line]  # no message between 1.08 and 1.2 s
    bounds = MotionBounds(replace(BOUNDS.translation, per_second=1.0), BOUNDS.rotation)
    for each, seconds in ((BOUNDS, 0.0), (bounds, 0.8)):
        (_, step) = steps(ScanStream(lines), each)
        assert step.motion is not None
        assert len(step.recorded[0]) == 41 - 5
        assert 0.5 * (step.motion.upper[0] - step.motion.lower[0]) == pytest.approx(35 * 0.02 + 4.0 * 0.1 + seconds, abs=1e-6)


def test_bags_and_two_topics_of_scans(bag) -> None:  # type: ignore[no-untyped-def]
    with bag:
        bag.mounting()
        bag.mounting("rear")
        for stamp, x in zip(STAMPS, RECORDED, strict=True):
            bag.odometry(stamp, x)
        for stamp in (STAMPS[0], 0.5 * (STAMPS[12] + STAMPS[13]), STAMPS[-1]):
            bag.scan(stamp, "/rear", "rear")
        for stamp in (STAMPS[-1], STAMPS[0]):  # the clock is wrong, and the stamp repaired
            bag.scan(stamp)
    for every in (1, 2):
        rear = motion(open_recording(bag.path, ["/rear"]), every=every)
        assert rear.contains(Pose(TRUTH))
        assert ALLOWED < rear.upper[0] < ALLOWED + 0.15  # the scan in the middle makes one more piece, whose ends are interpolated
    # Back in time, over all messages.
    back = open_recording(bag.path, ["/scan"])
    check(motion(back))
    assert sum(back.repaired.values()) == 1
    last = list(back.readings())[1]
    assert len(last.messages) == 39
    assert (np.diff(last.messages.stamps_ns) > 0).all()


def test_odometry_from_tf(bag) -> None:  # type: ignore[no-untyped-def]
    with bag:
        bag.mounting()
        for stamp, x in zip(STAMPS, RECORDED, strict=True):
            bag.transform(stamp, "odom", "base_link", (x, 0.0, 0.0))
        for stamp in (STAMPS[0], STAMPS[-1]):
            bag.scan(stamp)
    check(motion(open_recording(bag.path)))


def test_carmen_logs_share_the_time_equally(tmp_path: Path) -> None:
    path = tmp_path / "corridor.log"
    lines = [f"ODOM {x} 0 0 0 0 0 0.0 host 0.0\n" for x in RECORDED]  # whose stamps mean nothing
    scans = [f"FLASER 1 1.0 0 0 0 0 0 0 {stamp} host {stamp}\n" for stamp in (1.0, 1.8)]
    unreadable = "ODOM 0.1 nan 0 0 0 0 0.0 host 0.0\nFLASER 2 1.0 0 0 0 0 0 0 1.3 host 1.3\n"
    path.write_text("".join([lines[0], scans[0], *lines[1:14], unreadable, *lines[14:], scans[1]]))
    log = CarmenLog(path)
    check(motion(log))
    assert log.skipped
    _, last = log.readings()
    assert last.messages.stamps_ns.tolist() == [1_000_000_000 + 20_000_000 * number for number in range(1, 40)]
    timed = MotionBounds(ErrorBound(0.0, per_second=1.0), ErrorBound())
    (_, step) = steps(log, timed)
    assert step.motion is not None
    assert step.motion.upper[0] == pytest.approx(0.8, abs=1e-6)


def in_memory() -> InMemoryRecording:
    scans = [LaserScan(round(stamp * 1e9), np.ones(1, np.float32), 0.0, 0.5) for stamp in (STAMPS[0], STAMPS[-1], STAMPS[-1] + 1.0)]
    between = OdometryPath.of((round(stamp * 1e9), Odometry(x, 0.0)) for stamp, x in list(zip(STAMPS, RECORDED, strict=True))[1:-1])
    ends = (OdometryPath.of(), between, OdometryPath.of())
    readings = [
        Reading(row, each.stamp_ns, Odometry(0.0, 0.0), each, path) for row, (each, path) in enumerate(zip(scans, ends, strict=True))
    ]
    return InMemoryRecording("corridor", readings)


def test_in_memory_written_and_kidnapped(tmp_path: Path) -> None:
    source = in_memory()
    check(motion(source, stop=2))
    with (tmp_path / "copy.jsonl").open("w") as file:
        convert_to_lines(source, file)
    for kind in ("mcap", "bag"):
        convert(source, tmp_path / f"copy.{kind}")
    for path in sorted(tmp_path.iterdir()):
        check(motion(open_recording(path), stop=2))
    moved, _ = kidnap(source, [Kidnapping(2, 1)])  # the step that led to scan 1 comes once more
    twice = [step.motion for step in steps(moved, BOUNDS)]
    assert len(twice) == 5
    for number in (1, 3):
        odometry = twice[number]
        assert odometry is not None
        check(odometry)


def test_a_stream_that_was_down() -> None:
    lines = corridor(*((STAMPS[row], scan(STAMPS[row])) for row in (10, 30)))
    first, second, *_ = steps(ScanStream(lines), BOUNDS)
    assert first.motion is None
    assert second.motion is not None
    # Read from its beginning once more, or from where the interruption ended: what came before the mark is not composed twice.
    for rest in (lines, lines[5:], lines[11:]):
        moved = second.motion
        for step in steps(ScanStream(rest), BOUNDS, after=second.mark):
            assert step.motion is not None
            moved = moved.compose(step.motion)
        check(moved)
    # What was missed is one piece, as long as the gap.
    timed = MotionBounds(ErrorBound(0.02, 0.1, per_second=1.0), ErrorBound())
    step = next(iter(steps(ScanStream(lines[25:]), timed, after=second.mark)))
    assert 1e-9 * (step.recorded[0].stamps_ns[1] - second.stamp_ns) == pytest.approx(0.26)
    pieces = len(step.recorded[0]) - 1
    way = np.abs(np.diff(step.recorded[0].numbers[:, 0])).sum()
    assert step.motion is not None
    assert 0.5 * (step.motion.upper[0] - step.motion.lower[0]) == pytest.approx(0.02 * pieces + 0.1 * way + 0.4, abs=1e-6)


def test_a_stream_without_scans_keeps_its_memory_and_its_promise(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("ial.datasets.scan_stream._MOST_MESSAGES", 16)
    stream = ScanStream(corridor())
    (_, step) = steps(stream, BOUNDS)
    assert step.motion is not None
    assert np.isinf(step.motion.lower[:2]).all()  # what was forgotten says nothing, instead of too much
    assert any("the motion over them is unknown" in fault for fault in stream.repaired)


def room() -> OccupancyGrid:
    """Return a corridor of 12 × 2 m whose ends are seen."""
    cells = np.zeros((40, 240), dtype=np.uint8)
    cells[[0, -1]] = cells[:, [0, -1]] = OCCUPIED
    return OccupancyGrid(cells, 0.05)


def test_the_robot_in_the_corridor_is_not_lost() -> None:
    def seen(stamp: float, x: float) -> bytes:
        angles = np.arange(90) * (2.0 * np.pi / 90.0)
        c, s = np.cos(angles), np.sin(angles)
        with np.errstate(divide="ignore"):
            along = np.where(c > 0, (11.95 - x) / c, (0.05 - x) / c)
            across = np.where(s > 0, 0.95 / s, -0.95 / s)
        return scan(stamp, angle_increment=2.0 * np.pi / 90.0, ranges=np.minimum(along, across).tolist())

    lines = [line for line in corridor() if b"scan" not in line[:8]]
    lines = [lines[0], seen(STAMPS[0], 3.0), *lines[1:], seen(STAMPS[-1], 3.0 + TRUTH)]
    config = LocalizerConfig(bounds=Bounds(0.02, 0.0, 0.02, BOUNDS), outliers=0)
    localizer = Localizer(room(), config=config)
    answers: Iterator[Any] = (localizer.update(step.motion, step.scan) for step in steps(ScanStream(lines), BOUNDS))
    for answer, x in zip(answers, (3.0, 3.0 + TRUTH), strict=True):
        assert answer.poses.contains(Pose(x, 1.0, 0.0))
        assert answer.status != "lost"


def test_a_scan_that_comes_after_its_messages_are_forgotten_is_skipped_whatever_it_says_about_itself(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("ial.datasets.scan_stream._KEPT_NS", 0)
    late = scan(STAMPS[5], odometry={"x": 0.5, "y": 0.0, "theta": 0.0, "error_m": 0.1})
    stream = ScanStream([*corridor((STAMPS[20], scan(STAMPS[20]))), late])
    check(motion(stream))
    assert dict(stream.skipped) == {"no odometry": 1}


def test_odometry_that_was_looked_up_is_no_message() -> None:
    at = {"x": 0.65, "y": 0.0, "theta": 0.0, "error_m": 0.06, "error_rad": 0.0}
    lines = corridor((STAMPS[6] + 0.01, scan(STAMPS[6] + 0.01, odometry=at)))
    first, middle, last = ScanStream(lines).readings()
    assert middle.odometry == Odometry(0.65, 0.0, error_m=0.06)
    assert [len(reading.messages) for reading in (first, middle, last)] == [0, 6, 33]


def swept_back(*others: tuple[float, bytes]) -> ScanStream:
    """Return the corridor with a scan at 1.6 s whose last beam is of 1.02 s."""
    back = scan(STAMPS[30], frame_id="b", ranges=[1.0] * 30, time_increment=-STEP_S, end={"x": 0.1, "y": 0.0, "theta": 0.0})
    return ScanStream(corridor(*others, (STAMPS[30], back)))


def test_a_sweep_that_goes_back_behind_the_scan_of_another_lidar_has_every_message(monkeypatch: pytest.MonkeyPatch) -> None:
    stream = swept_back((STAMPS[28], scan(STAMPS[28])))
    sweep = next(reading.scan.sweep for reading in stream.readings() if reading.scan.frame_id == "b")
    assert sweep is not None
    assert sweep.numbers[:, 0].tolist() == [*RECORDED[30:1:-1], 0.1]
    # Where messages were forgotten nevertheless, nothing is known of the sweep.
    monkeypatch.setattr("ial.datasets.scan_stream._KEPT_NS", 0)
    second = next(reading.scan for reading in stream.readings() if reading.scan.frame_id == "b")
    assert (second.sweep, second.time_increment) == (None, 0.0)
    assert any("no longer known" in fault for fault in stream.repaired)
    monkeypatch.setattr("ial.datasets.scan_stream._MOST_MESSAGES", 16)
    assert next(reading.scan.sweep for reading in swept_back().readings() if reading.scan.frame_id == "b") is None


def numbers(steps: list[Step]) -> list[Any]:
    """Return all that a localizer sees of the steps."""
    return [
        (step.index, step.stamp_ns, None if step.motion is None else (step.motion.lower.tolist(), step.motion.upper.tolist()))
        for step in steps
    ]


@pytest.mark.parametrize("stuck", [1, 10, 30, 120])
def test_a_stream_that_was_down_behind_a_scan_whose_stamp_was_raised(stuck: int) -> None:
    lines = corridor(*((STAMPS[row], scan(STAMPS[row])) for row in (3, 6, 8, 20)))
    lines[1:2] = [lines[1]] * stuck  # the scan's clock stands still
    bounds = MotionBounds(replace(BOUNDS.translation, per_second=1.0), BOUNDS.rotation)
    whole = list(steps(ScanStream(lines), bounds))
    assert whole[stuck - 1].stamp_ns == 10**9 + (stuck - 1) * 10**6
    for rest in (lines, lines[1 + stuck :]):
        stream = ScanStream(rest)
        assert numbers(list(steps(stream, bounds, after=whole[stuck - 1].mark))) == numbers(whole[stuck:])
    assert len(whole) == stuck + 5


def test_a_stream_that_was_down_behind_a_clock_that_went_back_has_every_message() -> None:
    lines = corridor(*((STAMPS[row], scan(STAMPS[row])) for row in (10, 30)))
    early = lines.index(scan(STAMPS[30]))
    lines[early + 1 : early + 1] = [scan(STAMPS[20])]  # of a clock that was set back
    whole = list(steps(ScanStream(lines), BOUNDS))
    mark = whole[3].mark
    assert (mark.raised_ns, mark.behind_ns) == (201 * 10**6, 200 * 10**6)
    assert numbers(list(steps(ScanStream(lines), BOUNDS, after=mark))) == numbers(whole[4:])
    for rest in (lines[2:], lines[early - 5 :], lines[early + 2 :]):
        (step,) = steps(ScanStream(rest), BOUNDS, after=mark)
        assert step.index > mark.index
        assert step.stamp_ns == whole[4].stamp_ns
        assert step.motion is not None
        recorded = set(step.recorded[0].numbers[:, 0].tolist())
        assert set(RECORDED[31:40]) <= recorded


def test_a_carmen_log_that_begins_behind_the_mark_says_nothing_of_the_motion(tmp_path: Path) -> None:
    lines = [f"ODOM {x} 0 0 0 0 0 0.0 host 0.0\n" for x in RECORDED]
    scans = [f"FLASER 2 1.0 1.5 0 0 0 0 0 0 {stamp} host {stamp}\n" for stamp in (1.0, 1.8, 2.0)]
    whole, rest = tmp_path / "whole.log", tmp_path / "rest.log"
    whole.write_text("".join([lines[0], scans[0], *lines[1:], scans[1], lines[5], scans[2]]))
    rest.write_text("".join([*lines[1:], scans[1], lines[5], scans[2]]))
    read = list(steps(CarmenLog(whole), BOUNDS))
    assert numbers(list(steps(CarmenLog(whole), BOUNDS, after=read[0].mark))) == numbers(read[1:])
    second, third = steps(CarmenLog(rest), BOUNDS, after=read[0].mark)
    assert second.motion is not None
    assert third.motion is not None
    assert np.isinf(second.motion.lower[:2]).all()
    assert numbers([third]) == numbers(read[2:])


@pytest.mark.parametrize("nanoseconds", [1, 4, 100])
def test_more_messages_than_nanoseconds(tmp_path: Path, nanoseconds: int) -> None:
    path = tmp_path / "corridor.log"
    lines = [f"ODOM {x} 0 0 0 0 0 0.0 host 0.0\n" for x in RECORDED]
    scans = [f"FLASER 1 1.0 0 0 0 0 0 0 {stamp} host {stamp}\n" for stamp in ("1.0", f"1.{nanoseconds:09d}")]
    path.write_text("".join([lines[0], scans[0], *lines[1:], scans[1]]))
    check(motion(CarmenLog(path)))


def copies(source: Recording, folder: Path) -> list[Recording]:
    """Return a recording as it is read back from each format."""
    convert_to_lines(source, folder / "copy.jsonl")
    for kind in ("mcap", "bag"):
        convert(source, folder / f"copy.{kind}")
    return [open_recording(path) for path in sorted(folder.iterdir())]


END = {"x": 0.5, "y": 0.0, "theta": 0.0}


def sweeping(row: int, lidar: str, **more: Any) -> tuple[float, bytes]:
    """Return a scan at a message, whose last beam is five messages later."""
    return STAMPS[row], scan(STAMPS[row], frame_id=lidar, ranges=[1.0] * 11, time_increment=0.01, end=END, **more)


def test_two_lidars_that_sweep_from_one_stamp_are_copied_to_the_bit(tmp_path: Path, canonical_steps) -> None:  # type: ignore[no-untyped-def]
    bad = (STAMPS[12], scan(STAMPS[12], frame_id="c", ranges=[]))  # of a third one
    for number, more in enumerate(([], [bad])):
        lines = corridor(*more, *(sweeping(row, lidar) for row in (4, 12, 20) for lidar in "ab"))
        source = ScanStream(lines)
        expected = canonical_steps(source)
        assert not source.repaired
        assert sum(step[5] is not None for step in expected) == 6
        (tmp_path / str(number)).mkdir()
        for copy in copies(ScanStream(lines), tmp_path / str(number)):
            assert canonical_steps(copy) == expected


def test_an_inexact_message_at_a_scan_is_a_message(tmp_path: Path, canonical_steps) -> None:  # type: ignore[no-untyped-def]
    lines = corridor(sweeping(4, "a"), sweeping(6, "b"))
    rough = json.dumps({"odometry": {"stamp": f"{STAMPS[6]:.9f}", "x": 0.6, "y": 0.0, "theta": 0.0, "error_m": 0.01}}).encode()
    lines = [rough if line == odometry(STAMPS[6], RECORDED[6]) else line for line in lines]
    expected = canonical_steps(ScanStream(lines))
    sweep = next(reading.scan.sweep for reading in ScanStream(lines).readings() if reading.scan.frame_id == "a")
    assert sweep is not None
    assert sweep.numbers[2, 4] == 0.01
    for copy in copies(ScanStream(lines), tmp_path):
        assert canonical_steps(copy) == expected


def test_a_raised_scan_brings_no_message_into_the_sweep_of_another(tmp_path: Path, canonical_steps) -> None:  # type: ignore[no-untyped-def]
    lines = corridor(sweeping(12, "a"), (STAMPS[12], scan(STAMPS[12], frame_id="a")))
    expected = canonical_steps(ScanStream(lines))
    for copy in copies(ScanStream(lines), tmp_path):
        assert canonical_steps(copy) == expected
    # Where there are messages between the two, their shares of the time lie in the sweep.
    lines = corridor(sweeping(12, "a"), (STAMPS[12], scan(STAMPS[12], stamp=f"{STAMPS[8]:.9f}", frame_id="b")))
    with pytest.raises(OutputError, match="other odometry during a scan"):
        convert_to_lines(ScanStream(lines), tmp_path / "copy.jsonl")
    back = scan(STAMPS[14], frame_id="b", ranges=[1.0] * 11, time_increment=-0.01, end=END)
    lines = corridor((STAMPS[12], scan(STAMPS[12])), (STAMPS[12], scan(STAMPS[12], stamp=f"{STAMPS[8]:.9f}")), (STAMPS[14], back))
    with pytest.raises(OutputError, match="other odometry during a scan"):
        convert_to_lines(ScanStream(lines), tmp_path / "copy.jsonl")
