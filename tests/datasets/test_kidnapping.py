import itertools
import math
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import mpmath
import numpy as np
import pytest

from ial.datasets.conversion import convert
from ial.datasets.in_memory import InMemoryRecording
from ial.datasets.kidnapping import Kidnapping, kidnap
from ial.datasets.odometry import Odometry
from ial.datasets.odometry_buffer import OdometryBuffer
from ial.datasets.odometry_path import OdometryPath
from ial.datasets.opening import open_recording
from ial.datasets.recording import Reading
from ial.datasets.sample import sample_grid, sample_recording
from ial.datasets.scan import LaserScan
from ial.datasets.trajectory import Trajectory
from ial.errors import RecordingError
from ial.lidar.localizer import Localizer
from ial.lidar.run import localize
from ial.pose import Pose


def recording(scans: int = 10) -> InMemoryRecording:
    """Return scans at growing intervals along a curve; the range of a scan is its number."""
    readings, at = [], Pose(3.0, -1.0, 0.4)
    for index in range(scans):
        stamp = 10**9 + 10**6 * (100 * index + index * index)
        readings.append(Reading(index, stamp, Odometry.of(at, 0.01), LaserScan(stamp, np.full(3, index + 1.0, np.float32), -1.0, 0.5)))
        at = at @ Pose(0.1 * index, 0.01, 0.2 - 0.03 * index)
    return InMemoryRecording("curve", readings)


def numbers(readings: list[Reading]) -> list[int]:
    return [int(reading.scan.ranges[0]) - 1 for reading in readings]


@pytest.mark.parametrize(
    ("jumps", "order"),
    [
        ([(2, 7)], [0, 1, 2, 7, 8, 9]),
        ([(6, 2)], [0, 1, 2, 3, 4, 5, 6, 2, 3, 4, 5, 6, 7, 8, 9]),
        ([(2, 5), (6, 0), (1, 8)], [0, 1, 2, 5, 6, 0, 1, 8, 9]),
        ([(9, 4)], [*range(10), 4, 5, 6, 7, 8, 9]),
        ([], list(range(10))),
    ],
)
def test_scans_follow_each_other_as_the_jumps_say(jumps: list[tuple[int, int]], order: list[int]) -> None:
    moved, _ = kidnap(recording(), [Kidnapping(*jump) for jump in jumps])
    readings = list(moved.readings())
    assert numbers(readings) == order
    assert [reading.index for reading in readings] == list(range(len(order)))
    assert all(reading.stamp_ns == reading.scan.stamp_ns for reading in readings)


def test_odometry_and_clock_tell_nothing_and_nothing_changes_before() -> None:
    before, (after, _) = list(recording().readings()), kidnap(recording(), [Kidnapping(3, 7), Kidnapping(8, 1)])
    readings = list(after.readings())
    assert [reading.odometry for reading in readings[:4]] == [reading.odometry for reading in before[:4]]
    assert [reading.stamp_ns for reading in readings[:4]] == [reading.stamp_ns for reading in before[:4]]
    for earlier, later, number in zip(readings, readings[1:], numbers(readings)[1:], strict=False):
        recorded, step = (
            pair[0].odometry.pose.inverse() @ pair[1].odometry.pose for pair in ((before[number - 1], before[number]), (earlier, later))
        )
        assert np.allclose([step.x, step.y, step.theta], [recorded.x, recorded.y, recorded.theta], atol=1e-12)
        assert later.stamp_ns - earlier.stamp_ns == before[number].stamp_ns - before[number - 1].stamp_ns
        turned = later.odometry.pose.theta - before[number].odometry.pose.theta
        sides = abs(math.cos(turned)) + abs(math.sin(turned))
        assert 0.01 * sides <= later.odometry.error_m * (1 + 1e-12) <= 0.01 * sides + 1e-9


def test_the_reference_jumps_with_the_robot() -> None:
    before = list(recording().readings())
    truth = Trajectory(np.array([each.stamp_ns for each in before]), np.array([[each.index, 0.0, 0.0] for each in before], dtype=float))
    moved, reference = kidnap(recording(), [Kidnapping(2, 7)], truth)
    assert reference is not None
    assert [reference.at(each.stamp_ns).x for each in moved.readings()] == [0, 1, 2, 7, 8, 9]  # type: ignore[union-attr]


@pytest.mark.parametrize(
    ("jumps", "message"),
    [
        ([(3, 4)], "follows scan 3 anyway"),
        ([(30, 4)], "has no scan 30; its scans are numbered from 0 to 9"),
        ([(3, 8), (5, 1)], "scan 5 is not reached"),
    ],
)
def test_a_jump_that_cannot_be_is_refused(jumps: list[tuple[int, int]], message: str) -> None:
    with pytest.raises(RecordingError, match=message):
        kidnap(recording(), [Kidnapping(*jump) for jump in jumps])


MS = 10**6
MOST_SPEED, MOST_TURN = 0.9, 1.1  # metres and radians in a second, of `sweeping`


def sweeping(time_increment: float, unknown: tuple[int, ...] = ()) -> InMemoryRecording:
    """Return ten scans of 14 beams, at steps of 120 to 138 ms, most of them between two messages, which come every 20 ms along a curve.

    Parameters
    ----------
    time_increment
        Seconds; with 0.01 some of the scans end after the stamp of the next.
    unknown
        The scans at whose last beams the odometry is not known.
    """
    messages, at = OdometryBuffer(), Pose(3.0, -1.0, 0.4)
    for number in range(80):
        messages.add(10**9 + 20 * MS * number, Odometry.of(at))
        at = at @ Pose(0.012 + 0.004 * (number % 2), 0.001, 0.02 * np.sin(number / 7))
    readings, before = [], None
    for index in range(10):
        stamp = 10**9 + MS * (200 + 120 * index + 2 * index * index // 10 * 5)
        scan = LaserScan(stamp, np.full(14, index + 1.0, np.float32), -1.0, 0.1, time_increment=time_increment)
        sweep = None if index in unknown else messages.sweep(stamp, scan.end_ns)
        odometry = messages.at(stamp)
        assert odometry is not None
        looked_up = not messages.holds(stamp)
        between = messages.between(before, stamp)
        readings.append(Reading(index, stamp, odometry, replace(scan, sweep=sweep), between, looked_up=looked_up))
        before = stamp
    return InMemoryRecording("curve", readings)


def seen_from_the_scan(reading: Reading) -> Iterator[list[float]]:
    """Yield the time and the pose of the base at each odometry message during a scan, as seen from its beginning."""
    assert reading.scan.sweep is not None
    for stamp, odometry in reading.scan.sweep:
        at = reading.odometry.pose.inverse() @ odometry.pose
        yield [stamp - reading.stamp_ns, at.x, at.y, at.theta]


@pytest.mark.parametrize("jumps", [[(3, 7)], [(6, 2)], [(9, 4)], [(2, 5), (6, 0), (1, 8)], [(3, 6), (6, 9)]])
@pytest.mark.parametrize("time_increment", [0.004, 0.01, 0.014, -0.004, -0.01])
def test_the_odometry_during_each_scan_is_as_recorded(
    time_increment: float,
    jumps: list[tuple[int, int]],
    tmp_path: Path,
    canonical_steps: Any,
) -> None:
    before = list(sweeping(time_increment).readings())
    kidnapped, _ = kidnap(sweeping(time_increment), [Kidnapping(*jump) for jump in jumps])
    readings = list(kidnapped.readings())
    for reading, number in zip(readings, numbers(readings), strict=True):
        assert np.allclose(list(seen_from_the_scan(reading)), list(seen_from_the_scan(before[number])), rtol=0.0, atol=1e-12)
        assert reading.scan.end_ns - reading.stamp_ns == before[number].scan.end_ns - before[number].stamp_ns
    for path in (tmp_path / "copy.mcap", tmp_path / "copy.bag"):
        convert(kidnapped, path)
        assert canonical_steps(open_recording(path)) == canonical_steps(kidnapped)


@pytest.mark.parametrize("jumps", [[(3, 7)], [(6, 2)], [(9, 4)], [(2, 5), (6, 0), (1, 8)]])
@pytest.mark.parametrize("time_increment", [0.0, 0.004, 0.01, 0.014, -0.004, -0.01])
def test_odometry_and_clock_go_on_over_a_sweep(time_increment: float, jumps: list[tuple[int, int]]) -> None:
    before = list(sweeping(time_increment).readings())
    readings = list(kidnap(sweeping(time_increment), [Kidnapping(*jump) for jump in jumps])[0].readings())
    for earlier, later, number in zip(readings, readings[1:], numbers(readings)[1:], strict=False):
        recorded = before[max(number, 1)].stamp_ns - before[max(number, 1) - 1].stamp_ns
        step = later.stamp_ns - earlier.stamp_ns
        # As long as recorded, or until the one scan has all its beams, or with time for all those of the other.
        assert step in (recorded, 1 + abs(later.scan.end_ns - later.stamp_ns))
        assert step >= recorded
        path = list(later.messages.joining((earlier.stamp_ns, earlier.odometry), (later.stamp_ns, later.odometry)))
        for (start, first), (stop, second) in itertools.pairwise(path):
            moved, seconds = first.pose.inverse() @ second.pose, 1e-9 * (stop - start)
            assert 0.0 < seconds < 0.041
            assert np.hypot(moved.x, moved.y) <= MOST_SPEED * seconds + 1e-12
            assert abs(moved.theta) <= MOST_TURN * seconds + 1e-12


def test_beams_of_a_scan_at_a_jump_have_no_times_where_its_sweep_is_not_known(tmp_path: Path) -> None:
    kidnapped, _ = kidnap(sweeping(0.01, unknown=(5, 9)), [Kidnapping(9, 4)])
    convert(kidnapped, tmp_path / "copy.mcap")
    for recording in (kidnapped, open_recording(tmp_path / "copy.mcap")):
        scans = [reading.scan for reading in recording.readings()]
        assert (scans[9].sweep, scans[9].time_increment) == (None, 0.0)
        assert scans[8].sweep is not None
        assert scans[10].sweep is not None
    assert kidnapped.repaired.total() == 1


def test_a_jump_between_two_lidars_of_one_stamp_is_refused() -> None:
    readings = list(sweeping(0.004).readings())
    other = replace(readings[5], stamp_ns=readings[5].stamp_ns + 1, raised_ns=1, messages=OdometryPath.of())
    other = replace(other, scan=replace(other.scan, stamp_ns=other.stamp_ns, frame_id="rear"))
    pair = InMemoryRecording("pair", [replace(each, index=row) for row, each in enumerate([*readings[:6], other, *readings[6:]])])
    with pytest.raises(RecordingError, match="scan 6 of pair has the stamp of scan 5, which is of another lidar; jump to that one"):
        kidnap(pair, [Kidnapping(2, 6)])
    kidnap(pair, [Kidnapping(2, 5), Kidnapping(5, 2)])


@pytest.mark.slow
def test_the_localizer_is_lost_at_once_and_finds_the_new_place_in_the_same_step() -> None:
    plain = {step.index: estimate for step, estimate in localize(sample_recording(), Localizer(sample_grid()))}
    moved, _ = kidnap(sample_recording(), [Kidnapping(10, 30)])
    estimates = [estimate for _, estimate in localize(moved, Localizer(sample_grid()))]
    assert [estimate.status for estimate in estimates[:11]] == [plain[index].status for index in range(11)]
    assert estimates[11].status == "lost"
    there = plain[30].pose
    assert there is not None
    assert any(each.x[0] <= there.x <= each.x[1] and each.y[0] <= there.y <= each.y[1] for each in estimates[11].hypotheses)
    assert estimates[-1].status == "localized"


def test_what_interpolated_odometry_may_be_is_moved_with_it() -> None:
    """Exactly: the corners of what it may be, turned and moved in 60 digits, lie within what is said after the jump."""
    before, (after, _) = list(recording().readings()), kidnap(recording(), [Kidnapping(3, 7), Kidnapping(8, 1)])
    readings = list(after.readings())
    moved = [(before[number].odometry, reading.odometry) for number, reading in zip(numbers(readings), readings, strict=True)]
    assert all(now.error_m > 0.0 for _, now in moved)
    (first, there), *others = moved[6:]  # after the last jump, moved by one transform
    with mpmath.workdps(60):

        def angle(odometry: Odometry) -> mpmath.mpf:
            return 2 * mpmath.atan2(odometry.z, odometry.w)

        turn = angle(there) - angle(first)
        c, s = mpmath.cos(turn), mpmath.sin(turn)
        for old, now in others:
            for dx, dy in itertools.product((-1, 1), repeat=2):
                x = mpmath.mpf(old.x) + dx * mpmath.mpf(old.error_m) - mpmath.mpf(first.x)
                y = mpmath.mpf(old.y) + dy * mpmath.mpf(old.error_m) - mpmath.mpf(first.y)
                assert abs(there.x + c * x - s * y - now.x) <= now.error_m + mpmath.mpf(1e-12)
                assert abs(there.y + s * x + c * y - now.y) <= now.error_m + mpmath.mpf(1e-12)
