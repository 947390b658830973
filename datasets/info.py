"""`RecordingInfo`: what a recording holds, what it lacks, and how to say so."""

import math
from dataclasses import asdict, dataclass, field
from typing import Any

from ial.datasets.scan import Mounting


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
    mountings
        Where each lidar sits on the robot, by the name of its frame.
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
    mountings: dict[str, Mounting] = field(default_factory=dict)
    missing: list[str] = field(default_factory=list)

    def as_dict(self) -> dict[str, Any]:
        """Return plain numbers, texts and lists, ready for JSON; a number that is not finite becomes None."""
        return {key: None if isinstance(value, float) and not math.isfinite(value) else value for key, value in asdict(self).items()}
