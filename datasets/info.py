"""`RecordingInfo`: what a recording holds, what it lacks, and how to say so."""

import math
from collections import Counter
from collections.abc import Iterator
from dataclasses import asdict, dataclass, field
from typing import TYPE_CHECKING, Any

from ial.datasets.scan import BeamClass, Mounting
from ial.errors import RecordingError

if TYPE_CHECKING:
    from ial.datasets.recording import Reading, Recording


@dataclass(frozen=True)
class Topic:
    """A stream of messages: its name, the type of its messages, and how many there are."""

    name: str
    type: str
    count: int


@dataclass
class RecordingInfo:
    """What a recording holds.

    Parameters
    ----------
    name, format
        Its path, and the kind of file.
    topics
        The streams in it, whether used or not.
    scans
        Number of usable scans.
    skipped, repaired
        Number of scans left out and of faults mended, by reason.
    duration_s, scan_rate_hz
        From the first stamp to the last; None below two scans.
    path_m
        Length of the odometry's path, metres.
    beams
        The distinct numbers of beams per scan.
    beam_classes
        Number of beams of each `BeamClass`.
    angle_min, angle_increment, range_min, range_max
        As in `LaserScan`, of the first scan.
    range_seen_m
        The smallest and the largest hit, metres.
    frames
        The frames in use, by role.
    mounting
        Where the lidar sits on the robot.
    missing
        What stands in the way of localizing with it, each with what to do.
    """

    name: str
    format: str
    topics: list[Topic] = field(default_factory=list)
    scans: int = 0
    skipped: dict[str, int] = field(default_factory=dict)
    repaired: dict[str, int] = field(default_factory=dict)
    duration_s: float | None = None
    scan_rate_hz: float | None = None
    path_m: float = 0.0
    beams: list[int] = field(default_factory=list)
    beam_classes: dict[str, int] = field(default_factory=dict)
    angle_min: float | None = None
    angle_increment: float | None = None
    range_min: float | None = None
    range_max: float | None = None
    range_seen_m: tuple[float, float] | None = None
    frames: dict[str, str] = field(default_factory=dict)
    mounting: Mounting | None = None
    missing: list[str] = field(default_factory=list)

    def as_dict(self) -> dict[str, Any]:
        """Return plain numbers, texts and lists, ready for JSON; a number that is not finite becomes None."""
        return {key: None if isinstance(value, float) and not math.isfinite(value) else value for key, value in asdict(self).items()}


def describe(recording: "Recording", file_format: str, topics: list[Topic], frames: dict[str, str]) -> RecordingInfo:
    """Read a recording to its end and return what it holds; what stops the reading is listed under `missing`."""
    info = RecordingInfo(recording.name, file_format, topics, frames=frames)
    try:
        _survey(info, recording.readings())
    except RecordingError as error:
        info.missing.append(str(error))
    info.skipped, info.repaired = dict(recording.skipped), dict(recording.repaired)
    return info


def _survey(info: RecordingInfo, readings: "Iterator[Reading]") -> None:
    classes: Counter[str] = Counter()
    first: Reading | None = None
    previous: Reading | None = None
    beams: set[int] = set()
    nearest, farthest = math.inf, -math.inf
    for reading in readings:
        scan = reading.scan
        if first is None or previous is None:
            first = previous = reading
            info.mounting = scan.mounting
            info.angle_min, info.angle_increment = scan.angle_min, scan.angle_increment
            info.range_min, info.range_max = scan.range_min, scan.range_max
            info.frames = {**info.frames, "laser": scan.frame_id}
        info.scans += 1
        beams.add(len(scan))
        kinds = scan.classes()
        hits = scan.ranges[kinds == BeamClass.HIT]
        classes.update({kind.name.lower(): int((kinds == kind).sum()) for kind in BeamClass})
        if len(hits):
            nearest, farthest = min(nearest, float(hits.min())), max(farthest, float(hits.max()))
        before, now = previous.odometry, reading.odometry
        info.path_m += math.hypot(now.x - before.x, now.y - before.y)
        previous = reading
        info.duration_s = 1e-9 * (reading.stamp_ns - first.stamp_ns) or None
    info.beams, info.beam_classes = sorted(beams), dict(classes)
    info.scan_rate_hz = (info.scans - 1) / info.duration_s if info.duration_s else None
    if not classes["hit"]:
        info.missing.append("a usable beam: every beam of every scan is invalid, too near, or without a return")
    else:
        info.range_seen_m = (nearest, farthest)
