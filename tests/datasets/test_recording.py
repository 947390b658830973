"""Tests of the steps that a localizer takes from a recording."""

import math
from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np
import pytest

from ial.datasets.in_memory import InMemoryRecording
from ial.datasets.motion import ErrorBound, MotionBounds
from ial.datasets.odometry import Odometry
from ial.datasets.recording import Reading, Step, steps
from ial.datasets.scan import LaserScan
from ial.errors import RecordingError

Maker = Callable[..., Iterator[Reading]]
BOUNDS = MotionBounds(ErrorBound(0.1, 0.2, 0.3), ErrorBound(0.05, 0.01, 0.2))


@pytest.fixture
def recording(readings: Maker) -> InMemoryRecording:
    """Twelve scans."""
    return InMemoryRecording("synthetic", readings(12))


def _reset(reading: Reading, ranges: list[float]) -> Reading:
    return Reading(
        reading.index, reading.stamp_ns, reading.odometry, LaserScan(reading.stamp_ns, np.array(ranges), 0.0, 0.1, range_max=10.0)
    )


@pytest.mark.parametrize(("start", "stop", "every"), [(0, None, 1), (1, None, 2), (0, 7, 3), (5, 6, 1), (11, None, 4)])
def test_indices_are_those_of_a_slice(recording: InMemoryRecording, start: int, stop: int | None, every: int) -> None:
    chosen = list(steps(recording, BOUNDS, start, stop, every))
    assert [step.index for step in chosen] == list(range(12))[start:stop:every]


def test_the_motion_in_between_is_composed_of_every_recorded_step(recording: InMemoryRecording) -> None:
    poses = [reading.odometry for reading in recording.readings()]
    first, second, third = list(steps(recording, BOUNDS, 1, 8, 3))
    assert first.motion is None
    for step, begin in ((second, 1), (third, 4)):
        one, two, three = (BOUNDS.along(path) for path in step.recorded)
        expected = one.compose(two).compose(three)
        assert step.motion is not None
        assert np.array_equal(step.motion.lower, expected.lower)
        assert np.array_equal(step.motion.upper, expected.upper)
        assert step.motion.contains(poses[begin].pose.inverse() @ poses[begin + 3].pose)
    assert second.odometry == poses[4]


def test_a_skipped_scan_in_between_loses_no_motion(readings: Maker) -> None:
    every = list(readings(5))
    direct = list(steps(InMemoryRecording("gap", [every[0], every[3]]), BOUNDS))
    expected = BOUNDS.along(every[3].messages.joining((0, every[0].odometry), (every[3].stamp_ns, every[3].odometry)))
    assert direct[1].motion is not None
    assert np.array_equal(direct[1].motion.lower, expected.lower)


def test_wider_bounds_give_wider_motions(recording: InMemoryRecording) -> None:
    wide = MotionBounds(ErrorBound(0.2, 0.2, 0.3), ErrorBound(0.05, 0.01, 0.2))
    for narrow_step, wide_step in zip(steps(recording, BOUNDS), steps(recording, wide), strict=True):
        if narrow_step.motion is not None and wide_step.motion is not None:
            assert (wide_step.motion.lower[:2] < narrow_step.motion.lower[:2]).all()


def test_a_scan_of_invalid_beams_is_a_step_but_a_recording_of_them_is_an_error(recording: InMemoryRecording) -> None:
    all_readings = list(recording.readings())
    dead = [_reset(reading, [math.nan, math.inf, -math.inf, 10.0]) for reading in all_readings]
    assert len(list(steps(InMemoryRecording("mixed", [*dead[:3], *all_readings[3:]]), BOUNDS))) == 12
    seen: list[Step] = []
    with pytest.raises(RecordingError, match="none of the 12 processed scans has a usable beam"):
        seen.extend(steps(InMemoryRecording("dead", dead), BOUNDS))
    assert any("usable beam" in fault for fault in InMemoryRecording("dead", dead).info().missing)


@pytest.mark.parametrize(("start", "stop", "every"), [(-1, None, 1), (0, None, 0), (3, 3, 1), (12, None, 1)])
def test_a_choice_of_no_scan_is_an_error(recording: InMemoryRecording, start: int, stop: int | None, every: int) -> None:
    with pytest.raises(RecordingError, match="scan"):
        list(steps(recording, BOUNDS, start, stop, every))


def test_a_recording_in_memory_must_be_in_order(readings: Maker) -> None:
    first, second = readings(2)
    with pytest.raises(RecordingError, match="do not increase"):
        InMemoryRecording("reversed", [second, first])
    with pytest.raises(RecordingError, match="no scan"):
        InMemoryRecording("empty", [])


def test_odometry_errors_widen_the_motion(readings: Maker) -> None:
    first, second = readings(2)
    at = second.odometry
    plain, vague = (Reading(1, second.stamp_ns, Odometry(at.x, at.y, at.z, at.w, *errors), second.scan) for errors in ((), (0.5, 0.1)))
    exact = list(steps(InMemoryRecording("exact", [first, plain]), BOUNDS))[1].motion
    wider = list(steps(InMemoryRecording("vague", [first, vague]), BOUNDS))[1].motion
    assert exact is not None
    assert wider is not None
    assert (wider.upper - wider.lower >= exact.upper - exact.lower + [1.0, 1.0, 0.2]).all()


def test_the_motion_during_a_scan_comes_from_the_odometry_at_its_last_beam(readings: Maker) -> None:
    recorded = list(readings(4))
    for step, reading in zip(steps(InMemoryRecording("swept", recorded), BOUNDS), recorded, strict=True):
        sweep = step.scan.sweep
        assert sweep is reading.scan.sweep
        if sweep is not None:
            assert (sweep.stamps_ns[0], sweep.stamps_ns[-1]) == (reading.stamp_ns, step.scan.end_ns)
            assert next(iter(sweep))[1] == reading.odometry


def test_steps_go_on_behind_a_mark(recording: InMemoryRecording) -> None:
    whole = list(steps(recording, BOUNDS, 1, None, 3))
    rest = list(steps(recording, BOUNDS, 1, None, 3, after=whole[1].mark))
    assert [step.index for step in rest] == [step.index for step in whole[2:]]
    for one, other in zip(rest, whole[2:], strict=True):
        assert one.motion is not None
        assert other.motion is not None
        assert np.array_equal(one.motion.lower, other.motion.lower)
    live = InMemoryRecording("live", [replace(reading, index=number) for number, reading in enumerate(list(recording.readings())[8:])])
    assert [step.index for step in steps(live, BOUNDS, after=whole[1].mark)] == [5, 6, 7, 8]
