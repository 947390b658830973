import numpy as np
import pytest

from ial.datasets.in_memory import InMemoryRecording
from ial.datasets.kidnapping import Kidnapping, kidnap
from ial.datasets.odometry import Odometry
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
        assert later.odometry.error_m == 0.01


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
