"""What a recording holds, read to its end."""

import math
from collections import Counter
from collections.abc import Iterator

from ial.datasets.info import RecordingInfo, Topic
from ial.datasets.recording import Reading, Recording
from ial.datasets.scan import BeamClass
from ial.errors import RecordingError


def survey(recording: Recording, file_format: str, topics: list[Topic], frames: dict[str, str]) -> RecordingInfo:
    """Read a recording to its end and return what it holds; what stops the reading is listed under `missing`."""
    info = RecordingInfo(recording.name, file_format, topics, frames=frames)
    try:
        _fill(info, recording.readings())
    except RecordingError as error:
        info.missing.append(str(error))
    info.skipped, info.repaired = dict(recording.skipped), dict(recording.repaired)
    return info


def _fill(info: RecordingInfo, readings: Iterator[Reading]) -> None:
    classes: Counter[str] = Counter()
    first: Reading | None = None
    previous: Reading | None = None
    beams: set[int] = set()
    nearest, farthest = math.inf, -math.inf
    for reading in readings:
        scan = reading.scan
        if first is None or previous is None:
            first = previous = reading
            info.angle_min, info.angle_increment = scan.angle_min, scan.angle_increment
            info.range_min, info.range_max = scan.range_min, scan.range_max
        info.mountings.setdefault(scan.frame_id, scan.mounting)
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
    if info.mountings:
        info.frames = {**info.frames, "laser": ", ".join(info.mountings)}
    info.beams, info.beam_classes = sorted(beams), dict(classes)
    info.scan_rate_hz = (info.scans - 1) / info.duration_s if info.duration_s else None
    if not classes["hit"]:
        info.missing.append("a usable beam: every beam of every scan is invalid, too near, or without a return")
    else:
        info.range_seen_m = (nearest, farthest)
