"""Kidnapped recordings, made from real ones: the robot is elsewhere from one scan to the next, and its odometry does not tell."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ial.datasets.in_memory import InMemoryRecording
from ial.datasets.odometry import Odometry
from ial.datasets.odometry_path import OdometryPath
from ial.datasets.recording import Reading, Recording
from ial.datasets.trajectory import Trajectory
from ial.errors import RecordingError
from ial.pose import Pose


@dataclass(frozen=True)
class Kidnapping:
    """One jump within a recording.

    Parameters
    ----------
    at
        The last scan before it, by its number in the recording.
    to
        The scan that follows: a later one, so that scans are cut out, or an earlier one, so that scans come twice.
    """

    at: int
    to: int


def kidnap(
    recording: Recording, jumps: Sequence[Kidnapping], truth: Trajectory | None = None
) -> tuple[InMemoryRecording, Trajectory | None]:
    """Return a recording with jumps, and its reference trajectory.

    Before the scan to which a jump leads, odometry and clock advance by the recorded step that led to that scan; so neither tells that
    anything happened. After the last jump the recording goes on to its end.

    Parameters
    ----------
    recording
        The recording; read once, and held in memory.
    jumps
        In the order in which they happen. Each must begin at a scan that is reached: after the scan to which the one before led.
    truth
        Its reference trajectory; what it says at the scans is put together anew.

    Raises
    ------
    RecordingError
        If a jump names a scan that is not there or not reached, if it leads to where the recording would go on anyway, or if
        no scan has a reference.
    """
    readings = list(recording.readings())
    places = {reading.index: place for place, reading in enumerate(readings)}
    order = list(_order(recording.name, [reading.index for reading in readings], places, jumps))
    moved: list[Reading] = []
    stamps, poses = [], []
    jumped = False
    for number, place in enumerate(order):
        reading = readings[place]
        jumped = jumped or place != number
        # Before the first jump nothing changes, to the last bit.
        moved.append(_moved(moved[-1], readings, place) if jumped else replace(reading, index=number))
        pose = None if truth is None else truth.at(reading.stamp_ns)
        if pose is not None:
            stamps.append(moved[-1].stamp_ns)
            poses.append((pose.x, pose.y, pose.theta))
    if truth is not None and not poses:
        raise RecordingError(f"no scan of {recording.name} has a reference: their stamps do not meet; check that it is the right file")
    reference = None if truth is None else Trajectory(np.array(stamps, dtype=np.int64), np.array(poses).reshape(-1, 3))
    return InMemoryRecording(f"{recording.name}, kidnapped", moved), reference


def _order(name: str, indices: list[int], places: dict[int, int], jumps: Sequence[Kidnapping]) -> Iterator[int]:
    """Yield the place of each scan in its new order."""
    start = 0
    for jump in jumps:
        for scan in (jump.at, jump.to):
            if scan not in places:
                raise RecordingError(f"{name} has no scan {scan}; its scans are numbered from {indices[0]} to {indices[-1]}")
        stop = places[jump.at]
        if stop < start:
            raise RecordingError(
                f"scan {jump.at} is not reached before the jump to {jump.to}; give the jumps in the order in which they happen"
            )
        if places[jump.to] == stop + 1:
            raise RecordingError(f"scan {jump.to} follows scan {jump.at} anyway; give another one")
        yield from range(start, stop + 1)
        start = places[jump.to]
    yield from range(start, len(indices))


def _moved(last: Reading, readings: Sequence[Reading], place: int) -> Reading:
    """Return the scan at a place as the one that follows `last`, with the odometry of the recorded step that led to that scan."""
    source = max(place, 1)  # the first scan has no step before it: the next one serves
    before, now, reading = readings[source - 1], readings[source], readings[place]
    later = last.stamp_ns - before.stamp_ns

    def continued(path: OdometryPath, start: Odometry, onto: Odometry, later: int) -> OdometryPath:
        return OdometryPath.of((stamp + later, _continued(onto, start, odometry)) for stamp, odometry in path)

    messages = continued(now.messages, before.odometry, last.odometry, later)
    stamp, odometry = now.stamp_ns + later, _continued(last.odometry, before.odometry, now.odometry)
    sweep = reading.scan.sweep
    if sweep is not None:
        rest = continued(sweep, reading.odometry, odometry, stamp - reading.stamp_ns)
        sweep = OdometryPath(rest.stamps_ns, np.concatenate([[odometry.numbers], rest.numbers[1:]]))
    about = now.raised_ns, now.clocked, now.looked_up
    return Reading(last.index + 1, stamp, odometry, replace(reading.scan, stamp_ns=stamp, sweep=sweep), messages, *about)


def _continued(last: Odometry, before: Odometry, now: Odometry) -> Odometry:
    """Return `last` moved on by the recorded step from `before` to `now`; these numbers are what the new recording records."""
    step: Pose = before.pose.inverse() @ now.pose
    return Odometry.of(last.pose @ step, now.error_m, now.error_rad)
