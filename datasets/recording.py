"""`Recording`: what every reader yields, and the steps that a localizer takes from it."""

import math
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import Protocol

import numpy as np

from ial.datasets.info import RecordingInfo
from ial.datasets.mark import Mark
from ial.datasets.motion import Motion, MotionBounds
from ial.datasets.odometry import Odometry
from ial.datasets.odometry_path import OdometryPath
from ial.datasets.scan import UNTIMED, BeamClass, LaserScan
from ial.errors import RecordingError

STAMP_RAISED = "stamp did not increase: set to its predecessor's plus 1 ms"
RAISED_BY_NS = 10**6


@dataclass(frozen=True, eq=False)
class Reading:
    """One raw scan with its odometry: the canonical step, whose bits do not depend on the file format.

    Parameters
    ----------
    index
        Number of the scan in the recording, from 0; skipped scans are counted.
    stamp_ns
        Time in nanoseconds, strictly increasing within a recording.
    odometry
        Where the odometry says the robot was at that time.
    scan
        The scan.
    messages
        Every message of the odometry since the scan yielded before, in the order of recording; those at the two scans are not among them.
        Their stamps lie between those of the two scans. For the first scan: every message before it, where messages have stamps.
    raised_ns
        By how much `stamp_ns` is later than the stamp in the recording, which did not increase.
    clocked
        Whether `messages` have stamps of their own. Else they have shares of the time between the scans; and before a first scan, where
        there is no time to share, they are left out.
    looked_up
        Whether `odometry` is no message of that time, but was looked up between two.
    """

    index: int
    stamp_ns: int
    odometry: Odometry
    scan: LaserScan
    messages: OdometryPath = field(default_factory=OdometryPath.of)
    raised_ns: int = 0
    clocked: bool = True
    looked_up: bool = False

    @property
    def recorded_ns(self) -> int:
        """The stamp in the recording."""
        return self.stamp_ns - self.raised_ns


class Recording(Protocol):
    """A recorded or simulated run. It may be read several times, by one reader at a time.

    Attributes
    ----------
    name
        What to call it in messages and results.
    skipped
        Number of scans left out by the last `readings`, by reason; complete when that has ended.
    repaired
        Number of faults mended by the last `readings`, by kind (such as a stamp that did not increase).
    """

    name: str
    skipped: Counter[str]
    repaired: Counter[str]

    def readings(self) -> Iterator[Reading]:
        """Yield the scans in the order of recording.

        Raises
        ------
        RecordingError
            If the recording cannot be read to its end, or yields no scan at all.
        """
        ...

    def info(self) -> RecordingInfo:
        """Read the recording and say what it holds and what is missing."""
        ...


@dataclass(frozen=True, eq=False)
class Step:
    """One processed scan and the motion since the one processed before.

    Parameters
    ----------
    index, stamp_ns, scan
        As in `Reading`.
    motion
        The motion since the last processed scan; None for the first.
    odometry
        Where the odometry says the robot is at the scan.
    recorded
        What `motion` was made of: the odometry from each scan of the recording to the next, since the last processed one.
    raised_ns, behind_ns
        As in `Mark`.
    """

    index: int
    stamp_ns: int
    motion: Motion | None
    scan: LaserScan
    odometry: Odometry
    recorded: tuple[OdometryPath, ...] = ()
    raised_ns: int = 0
    behind_ns: int = 0

    @property
    def mark(self) -> Mark:
        """What a later run needs in order to go on after this scan."""
        return Mark(self.index, self.stamp_ns, self.odometry, self.raised_ns, self.behind_ns)


def steps(
    recording: Recording,
    bounds: MotionBounds,
    start: int = 0,
    stop: int | None = None,
    every: int = 1,
    after: Mark | None = None,
    *,
    no_return: bool = False,
) -> Iterator[Step]:
    """Yield the scans start, start + every, … below stop, each with the motion since the one yielded before.

    A recorded step leads from each scan of the recording to the next. The messages in it are enclosed by `bounds` and composed in interval
    arithmetic, and so are the steps over scans that are left out.

    Parameters
    ----------
    recording
        The recording to read.
    bounds
        How far recorded odometry may be from the truth.
    start, stop, every
        Which raw scans to process, like a slice; `stop` is exclusive.
    after
        Go on after this scan, which is known by its number, stamp and odometry. Where the recording does not hold it (a live one, which
        went on in the meantime), scans and messages up to its stamp in the recording are passed over, scans are counted on from its number,
        and the time without messages is one piece of the odometry. Whatever cannot be told to be before it counts as being after it. The
        motion is unknown where messages have no stamps of their own.
    no_return
        Whether beams without return are usable, as hits are.

    Raises
    ------
    RecordingError
        If the recording cannot be read, if no scan is chosen, or if no chosen scan has a usable beam.
    """
    if start < 0 or every < 1 or (stop is not None and stop <= start):
        raise RecordingError(f"no scan lies in from {start} to {stop} every {every}; give 0 <= from < to and every >= 1")
    previous = None if after is None else (after.stamp_ns, after.odometry)
    motion: Motion | None = None
    recorded: list[OdometryPath] = []
    yielded, usable = 0, after is not None
    used = (BeamClass.HIT, BeamClass.NO_RETURN) if no_return else (BeamClass.HIT,)
    latest = None if after is None else after.latest_ns
    for reading in recording.readings() if after is None else _after(recording, after):
        if stop is not None and reading.index >= stop:
            break
        here = reading.stamp_ns, reading.odometry
        if previous is not None and (yielded or after is not None):
            path = reading.messages.joining(previous, here)
            recorded.append(path)
            moved = bounds.along(path)
            motion = moved if motion is None else motion.compose(moved)
        previous = here
        latest = reading.recorded_ns if latest is None else max(latest, reading.recorded_ns)
        if reading.index < start or (reading.index - start) % every:
            continue
        usable = usable or bool(np.isin(reading.scan.classes(), used).any())
        clock = reading.raised_ns, latest - reading.recorded_ns
        yield Step(reading.index, reading.stamp_ns, motion, reading.scan, reading.odometry, tuple(recorded), *clock)
        yielded += 1
        motion, recorded = None, []
    if after is None:
        _check_any(recording, yielded, usable, start)


def _after(recording: Recording, mark: Mark) -> Iterator[Reading]:
    """Yield the readings after a mark, numbered as if the run had never been interrupted, the first with every message since.

    Where the recording does not hold the scan of the mark, a message too many makes a bound wider, and one too few makes it false.
    """
    offset, last = mark.index + 1, mark.stamp_ns
    missed: list[OdometryPath] | None = []
    readings = recording.readings()
    for reading in readings:
        if (reading.index, reading.stamp_ns, reading.raised_ns, reading.odometry) == (mark.index, last, mark.raised_ns, mark.odometry):
            yield from readings
            return
        if missed is not None:
            missed.append(_since(mark, reading))
            if reading.recorded_ns <= mark.latest_ns:
                missed.append(_at(mark, reading))
                offset = mark.index - reading.index
                continue
            reading, missed = replace(reading, messages=OdometryPath.joined(missed)), None
        if reading.stamp_ns <= last:
            recording.repaired[STAMP_RAISED] += 1
            stamp = last + RAISED_BY_NS
            raised = reading.raised_ns + stamp - reading.stamp_ns
            reading = replace(reading, stamp_ns=stamp, raised_ns=raised, scan=replace(reading.scan, stamp_ns=stamp, **UNTIMED))
        yield replace(reading, index=reading.index + offset, messages=reading.messages.within(last, reading.stamp_ns))
        last = reading.stamp_ns


def _since(mark: Mark, reading: Reading) -> OdometryPath:
    """Return the messages of a reading that may have come after a mark; one with infinite errors where they are not known."""
    if reading.clocked:
        return reading.messages.after(mark.recorded_ns)
    if len(reading.messages):
        return reading.messages
    return OdometryPath.of([(mark.stamp_ns, replace(mark.odometry, error_m=math.inf, error_rad=math.inf))])


def _at(mark: Mark, reading: Reading) -> OdometryPath:
    """Return the odometry of a reading, unless that is the one of the mark or of a time before it."""
    before = reading.recorded_ns < mark.recorded_ns or (reading.recorded_ns, reading.odometry) == (mark.recorded_ns, mark.odometry)
    return OdometryPath.of() if reading.clocked and before else OdometryPath.of([(reading.stamp_ns, reading.odometry)])


def _check_any(recording: Recording, yielded: int, usable: bool, start: int) -> None:
    reasons = ", ".join(f"{count} × {reason}" for reason, count in recording.skipped.items())
    if not yielded:
        skipped = f" (skipped: {reasons})" if reasons else ""
        raise RecordingError(f"{recording.name}: no scan was left to process from scan {start} on{skipped}; choose an earlier --from")
    if not usable:
        raise RecordingError(
            f"{recording.name}: none of the {yielded} processed scans has a usable beam (all are NaN, too near, or without a return), "
            "so nothing can be localized; check the driver's range_min and range_max with `ial info`"
        )
