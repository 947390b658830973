"""Kidnapped recordings, made from real ones: the robot is elsewhere from one scan to the next, and its odometry does not tell."""

import math
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ial.contractors.margins import ABOVE, ROUNDINGS
from ial.datasets.in_memory import InMemoryRecording
from ial.datasets.odometry import Odometry
from ial.datasets.odometry_path import OdometryPath
from ial.datasets.recording import Reading, Recording
from ial.datasets.scan import UNTIMED
from ial.datasets.trajectory import Trajectory, interpolate
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


UNKNOWN_SWEEP = "odometry during the scan before or after a jump is not known: all its beams taken as of its stamp"


def kidnap(
    recording: Recording, jumps: Sequence[Kidnapping], truth: Trajectory | None = None
) -> tuple[InMemoryRecording, Trajectory | None]:
    """Return a recording with jumps, and its reference trajectory.

    Before the scan to which a jump leads, odometry and clock advance by the recorded step that led to that scan; so neither tells that
    anything happened. Where the beams of the scan before have times, the robot is carried after the last of them: the odometry is as
    recorded during that scan, and goes on with what is left of the step to the next one; if nothing is left of it, that scan comes later.
    After the last jump the recording goes on to its end.

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
        If a jump names a scan that is not there or not reached, if it leads to where the recording would go on anyway or to the second of
        two timed scans with one stamp, or if no scan has a reference.
    """
    readings = list(recording.readings())
    parts = list(_parts(recording.name, readings, jumps))
    repaired = _take_unknown_sweeps_out(parts)
    moved: list[Reading] = []
    stamps, poses = [], []
    move = _Move()
    for number, part in enumerate(parts):
        messages = None
        if number:
            messages, move = _joined(parts[number - 1], move, part, _lead(readings, part))
        for reading in part.readings:
            moved.append(move.reading(reading, len(moved), messages))
            messages = None
            pose = None if truth is None else truth.at(reading.stamp_ns)
            if pose is not None:
                stamps.append(moved[-1].stamp_ns)
                poses.append((pose.x, pose.y, pose.theta))
    if truth is not None and not poses:
        raise RecordingError(f"no scan of {recording.name} has a reference: their stamps do not meet; check that it is the right file")
    reference = None if truth is None else Trajectory(np.array(stamps, dtype=np.int64), np.array(poses).reshape(-1, 3))
    kidnapped = InMemoryRecording(f"{recording.name}, kidnapped", moved)
    kidnapped.skipped.update(recording.skipped)
    kidnapped.repaired.update(recording.repaired + repaired)
    return kidnapped, reference


@dataclass
class _Part:
    """Scans that follow each other as recorded, from one jump to the next, the first of them at a place of the recording."""

    place: int
    readings: list[Reading]

    @property
    def first(self) -> OdometryPath:
        """The odometry during the scan that reaches back farthest."""
        return min(map(_during, self.readings), key=lambda path: int(path.stamps_ns[0]))

    @property
    def last(self) -> OdometryPath:
        """The odometry during the scan that ends last."""
        return max(map(_during, self.readings), key=lambda path: int(path.stamps_ns[-1]))


@dataclass(frozen=True)
class _Move:
    """Takes what was recorded to the time and the place at which a kidnapped recording has it.

    Parameters
    ----------
    later_ns
        By how much it comes later.
    onto
        From the recorded odometry frame to the new one; None where nothing changes, to the last bit, the time included.
    """

    later_ns: int = 0
    onto: Pose | None = None

    def odometry(self, odometry: Odometry) -> Odometry:
        """Return a moved odometry; these numbers are what the new recording records, or are as near to it as its errors say."""
        if self.onto is None:
            return odometry
        moved = Odometry.of(self.onto @ odometry.pose)
        if odometry.exact:
            return moved
        # A square that is turned needs a larger one along the axes; and the middle is rounded, in fewer than 31 steps.
        wider = abs(math.cos(self.onto.theta)) + abs(math.sin(self.onto.theta))
        terms = abs(self.onto.x) + abs(self.onto.y) + abs(odometry.x) + abs(odometry.y)
        error_m = ABOVE * (wider * odometry.error_m + ROUNDINGS * terms)
        error_rad = ABOVE * (odometry.error_rad + ROUNDINGS * 4.0 * math.pi)
        return replace(moved, error_m=error_m, error_rad=error_rad)

    def path(self, path: OdometryPath) -> OdometryPath:
        """Return a moved path."""
        if self.onto is None:
            return path
        return OdometryPath.of((stamp + self.later_ns, self.odometry(odometry)) for stamp, odometry in path)

    def reading(self, reading: Reading, index: int, messages: OdometryPath | None) -> Reading:
        """Return a moved scan with another number, and with other messages before it where some are given, which are not moved."""
        stamp, scan = reading.stamp_ns + self.later_ns, reading.scan
        if messages is None:
            messages = self.path(reading.messages)
        sweep = None if scan.sweep is None else self.path(scan.sweep)
        scan = replace(scan, stamp_ns=stamp, sweep=sweep)
        return replace(reading, index=index, stamp_ns=stamp, odometry=self.odometry(reading.odometry), scan=scan, messages=messages)


def _parts(name: str, readings: Sequence[Reading], jumps: Sequence[Kidnapping]) -> Iterator[_Part]:
    """Yield what lies between the jumps, in its new order."""
    places = {reading.index: place for place, reading in enumerate(readings)}
    start = 0
    for jump in jumps:
        for scan in (jump.at, jump.to):
            if scan not in places:
                raise RecordingError(f"{name} has no scan {scan}; its scans are numbered from {readings[0].index} to {readings[-1].index}")
        stop = places[jump.at]
        if stop < start:
            raise RecordingError(
                f"scan {jump.at} is not reached before the jump to {jump.to}; give the jumps in the order in which they happen"
            )
        if places[jump.to] == stop + 1:
            raise RecordingError(f"scan {jump.to} follows scan {jump.at} anyway; give another one")
        yield _Part(start, list(readings[start : stop + 1]))
        start = places[jump.to]
        if readings[start].raised_ns and readings[start].scan.sweep is not None:
            raise RecordingError(
                f"scan {jump.to} of {name} has the stamp of scan {readings[start - 1].index}, which is of another lidar; jump to that one"
            )
    yield _Part(start, list(readings[start:]))


def _take_unknown_sweeps_out(parts: Sequence[_Part]) -> Counter[str]:
    """Take the times of beams out of scans during which the robot is carried, where the odometry at the last beam is not known.

    Else a reader of the new recording would look it up, and find that of another place.
    """
    repaired: Counter[str] = Counter()
    for number, part in enumerate(parts):
        start, stop = part.readings[0].stamp_ns, part.readings[-1].stamp_ns
        for row, reading in enumerate(part.readings):
            end = reading.scan.end_ns
            over = (number > 0 and end < start) or (number < len(parts) - 1 and end > stop)
            if over and reading.scan.sweep is None:
                part.readings[row] = replace(reading, scan=replace(reading.scan, **UNTIMED))
                repaired[UNKNOWN_SWEEP] += 1
    return repaired


def _during(reading: Reading) -> OdometryPath:
    """Return the odometry during a scan in the order of time; that at its stamp if its beams have no times."""
    sweep = reading.scan.sweep
    if sweep is None:
        return OdometryPath.of([(reading.stamp_ns, reading.odometry)])
    return OdometryPath(sweep.stamps_ns[::-1], sweep.numbers[::-1]) if sweep.stamps_ns[-1] < sweep.stamps_ns[0] else sweep


def _lead(readings: Sequence[Reading], part: _Part) -> OdometryPath:
    """Return the recorded step that leads to a part; no step leads to the first scan: the next one serves, and ends where that begins."""
    place = max(part.place, 1)
    before, now = readings[place - 1], readings[place]
    step = now.messages.joining((before.stamp_ns, before.odometry), (now.stamp_ns, now.odometry))
    if part.place:
        return step
    stamp, odometry = next(iter(part.first))
    return _Move(stamp - now.stamp_ns, odometry.pose @ now.odometry.pose.inverse()).path(step)


def _joined(before: _Part, move: _Move, part: _Part, lead: OdometryPath) -> tuple[OdometryPath, _Move]:
    """Return the messages from the last scan before a jump to the first one after it, moved, and the move of the part after the jump.

    Parameters
    ----------
    before, move
        The part before the jump, and its move.
    part
        The part after the jump.
    lead
        The step that leads to it.
    """
    last, first = before.last, part.first
    stop, start = before.readings[-1].stamp_ns, part.readings[0].stamp_ns
    carried, begun = int(last.stamps_ns[-1]) + move.later_ns, int(first.stamps_ns[0])
    duration = int(lead.stamps_ns[-1] - lead.stamps_ns[0])
    later = max(stop + move.later_ns + duration - start, carried + 1 - begun)
    # From here on, in the time of the part after the jump, its odometry counts: some of the lead, or all of it, or none.
    since = carried - later
    there = Odometry(*first.numbers[0].tolist()).pose if since == begun - 1 else _at(lead, since)
    after = _Move(later, move.odometry(last.last).pose @ there.inverse())
    rest = OdometryPath(last.stamps_ns[:-1], last.numbers[:-1]).after(stop)
    led = (lead.stamps_ns > since) & (lead.stamps_ns < begun)
    swept = (first.stamps_ns > begun) & (first.stamps_ns < start)
    rows = [OdometryPath(path.stamps_ns[chosen], path.numbers[chosen]) for path, chosen in ((lead, led), (first, swept))]
    return OdometryPath.joined([move.path(rest), *(after.path(path) for path in rows)]), after


def _at(path: OdometryPath, stamp_ns: int) -> Pose:
    """Return where a path is at a time that it holds, straight on between two messages."""
    row = int(np.searchsorted(path.stamps_ns, stamp_ns, side="right")) - 1
    (start, first), (end, second) = list(path)[row : row + 2]
    return interpolate(first.pose, second.pose, (stamp_ns - start) / (end - start))
