"""`ScanStream`: odometry and scans as lines of JSON, from a file or as they arrive.

Each line is an object with one key.

``{"odometry": {"stamp": "1.500000000", "x": 0.1, "y": 0.2, "z": 0.0, "w": 1.0}}``
    A message of the odometry: metres, and the quaternion (0, 0, z, w), or ``theta`` in radians in its place. ``error_m`` and ``error_rad``
    say how far it may be from what was recorded; 0 if they are left out.

``{"scan": {"stamp": "1.500000000", "angle_min": -1.57, "angle_increment": 0.017, "ranges": [2.31, null, "inf"]}}``
    A scan with the numbers of ``sensor_msgs/LaserScan``; optional are ``range_min`` (0), ``range_max`` (``"inf"``), ``time_increment`` (0),
    ``frame_id``, ``laser``, which says where the lidar sits on the robot (``{"x": 0.1, "y": 0.0, "yaw": 0.0, "upside_down": false}``),
    ``end``, the odometry at the last beam, and ``odometry``, that at the first beam where it was interpolated (both with the keys of an
    odometry line, but the stamp). A range is a number, ``"inf"``, ``"-inf"``, or null for none (REP-117).

A stamp is a time in seconds; as a text it keeps its nanoseconds. The odometry of a scan is looked up at its stamp by the one rule of
`OdometryBuffer`, so a scan waits until odometry as late as itself (with ``end``, as late as its last beam) has arrived. Several lidars tell
themselves apart by ``frame_id``; their scans stand in the order of their stamps.
"""

import json
import math
from collections import deque
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ial.datasets.odometry import Odometry
from ial.datasets.odometry_buffer import MAX_GAP_NS, OdometryBuffer
from ial.datasets.odometry_path import OdometryPath
from ial.datasets.reader import Reader, Record
from ial.datasets.scan import UNTIMED, LaserScan, Mounting, last_beam_ns
from ial.datasets.stamps import format_stamp, parse_stamp
from ial.datasets.text_log import lines
from ial.errors import RecordingError
from ial.pose import Pose

_NUMBERS = {"angle_min", "angle_increment", "range_min", "range_max", "time_increment"}
_KEPT_NS = 5 * 10**9  # how long messages outlast the scan that took them: the sweep of another lidar may reach back over them
_MOST_MESSAGES = 2**20  # that are kept while no scan can be used: an hour and a half at 200 Hz, 56 MiB
_NEEDED = {"stamp", "angle_min", "angle_increment", "ranges"}


@dataclass(frozen=True)
class _Waiting:
    """A scan that has arrived: the stamps of its first and last beam, the arguments of `LaserScan`, the odometry at both where it says."""

    stamp_ns: int
    end_ns: int
    scan: dict[str, Any]
    first: Odometry | None
    last: Odometry | None

    def record(self, odometry: OdometryBuffer) -> Record:
        """Return the scan with what is known of the odometry; messages are forgotten some time after they are taken."""
        stamp, end = self.stamp_ns, self.end_ns
        # Where its messages are forgotten already, a scan that comes too late is of no use, whatever it says about itself.
        first = odometry.at(stamp) if self.first is None or stamp < odometry.kept_since_ns else self.first
        timed: dict[str, Any] = {"sweep": None}
        repaired = ""
        if first is not None and self.last is not None and end != stamp:
            if math.isfinite(first.error_m) and min(stamp, end) >= odometry.kept_since_ns:
                timed = {"sweep": odometry.between(stamp, end).joining((stamp, first), (end, self.last))}
            else:
                timed, repaired = UNTIMED, "odometry during the scan is no longer known: all beams taken as of its stamp"

        def take(since: int | None) -> OdometryPath:
            messages = odometry.between(since, stamp)
            odometry.forget(stamp - _KEPT_NS)
            return messages

        looked_up = self.first is not None or not odometry.holds(stamp)
        return Record(stamp, first, {**self.scan, **timed}, repaired=repaired, messages=take, looked_up=looked_up)


class ScanStream(Reader):
    """A recording as JSON lines.

    Parameters
    ----------
    source
        The file, plain or gzip; or lines as they come, which can be read once.
    name
        What to call it in messages; the path by default.
    laser_pose
        Where the laser sits, ``T_base_laser``, in place of what the scans say.
    """

    format = "JSON lines"

    def __init__(self, source: Path | Iterable[bytes], name: str | None = None, laser_pose: Pose | None = None) -> None:
        super().__init__(str(source) if name is None and isinstance(source, Path) else name or "stream")
        self._source = source
        self._placed: dict[str, object] = {}  # the lidar that `laser_pose` is of
        self._mounting = None if laser_pose is None else Mounting(laser_pose.x, laser_pose.y, laser_pose.theta)

    def _records(self) -> Iterator[Record]:
        odometry = OdometryBuffer()
        waiting: deque[_Waiting] = deque()
        for line in lines(self._source) if isinstance(self._source, Path) else self._source:
            if not line.strip():
                continue
            kind, content = _parsed(line)
            try:
                if kind == "odometry":
                    self._take(odometry, *_odometry(content))
                elif kind == "scan":
                    waiting.append(self._scan_of(content))
                else:
                    raise ValueError(kind)
            except (ValueError, TypeError, KeyError, OverflowError, RecordingError) as error:
                fault = str(error) if isinstance(error, RecordingError) else "line that is neither odometry nor a scan"
                if kind == "odometry":
                    self.repaired["odometry line that cannot be read: left out"] += 1
                else:
                    yield Record(None, fault=fault)
            yield from _ready(waiting, odometry)
        for scan in waiting:
            yield scan.record(odometry)

    def _take(self, odometry: OdometryBuffer, stamp: int, sample: Odometry) -> None:
        if not sample.valid:
            raise ValueError("odometry that is not finite")
        latest = odometry.latest_ns
        if latest is not None and stamp < latest:
            self.repaired["odometry older than the one before: left out"] += 1
            return
        odometry.add(stamp, sample)
        if len(odometry) > _MOST_MESSAGES:
            # The steps over them can no longer be composed, so nothing is known of the motion up to here.
            self.repaired[f"{_MOST_MESSAGES // 2} odometry messages without a scan that can be used: the motion over them is unknown"] += 1
            odometry.lose(_MOST_MESSAGES // 2)

    def _scan_of(self, content: dict[str, Any]) -> _Waiting:
        missing = _NEEDED - content.keys()
        unknown = content.keys() - _NEEDED - _NUMBERS - {"laser", "frame_id", "end", "odometry"}
        if missing or unknown:
            raise RecordingError(f"scan line with {'no' if missing else 'an unknown'} key '{min(missing or unknown)}'")
        laser = {"x": 0.0, "y": 0.0, "yaw": 0.0, "upside_down": False, **content.get("laser", {})}
        if len(laser) > 4 or not isinstance(laser["upside_down"], bool):
            raise RecordingError("scan line whose laser has other keys than x, y, yaw, and upside_down: true or false")
        if self._mounting is not None and content.get("frame_id") != self._placed.setdefault("frame_id", content.get("frame_id")):
            raise RecordingError("scan of a second lidar, which --laser-pose cannot place")
        mounting = self._mounting or Mounting(float(laser["x"]), float(laser["y"]), float(laser["yaw"]), laser["upside_down"])
        scan = {name: float(value) for name, value in content.items() if name in _NUMBERS}
        with np.errstate(over="ignore"):  # beyond the largest float32 lies infinity: nothing in range
            ranges = np.array([np.nan if value is None else float(value) for value in content["ranges"]], dtype=np.float32)
        frame = {"frame_id": str(content["frame_id"])} if "frame_id" in content else {}
        stamp = parse_stamp(str(content["stamp"]))
        first, last = (_sample_of(content[key]) if key in content else None for key in ("odometry", "end"))
        end = stamp if last is None else last_beam_ns(stamp, scan.get("time_increment", 0.0), len(ranges))
        return _Waiting(stamp, end, {**scan, **frame, "ranges": ranges, "mounting": mounting}, first, last)


def _ready(waiting: deque[_Waiting], odometry: OdometryBuffer) -> Iterator[Record]:
    """Yield the scans whose odometry is known, or will never be."""
    latest = odometry.latest_ns
    while waiting:
        needed = max(waiting[0].stamp_ns, waiting[0].end_ns)
        known = latest is not None and latest >= needed
        if not known and waiting[-1].stamp_ns <= needed + MAX_GAP_NS:
            return
        yield waiting.popleft().record(odometry)


def _parsed(line: bytes) -> tuple[str, dict[str, Any]]:
    """Return the key of a line and what stands there; nothing where the line is not of that form."""
    try:
        ((kind, content),) = json.loads(line).items()
    except (ValueError, AttributeError, RecursionError):
        return "", {}
    return (kind, content) if isinstance(content, dict) else ("", {})


def _odometry(content: dict[str, Any]) -> tuple[int, Odometry]:
    return parse_stamp(str(content["stamp"])), _sample_of(content)


def _sample_of(content: dict[str, Any]) -> Odometry:
    x, y = float(content["x"]), float(content["y"])
    z, w = (float(content["z"]), float(content["w"])) if "theta" not in content else Pose(0.0, 0.0, float(content["theta"])).quaternion()
    errors = float(content.get("error_m", 0.0)), float(content.get("error_rad", 0.0))
    if not all(math.isfinite(error) and error >= 0.0 for error in errors):
        raise ValueError("an error bound that is negative or not finite")
    return Odometry(x, y, z, w, *errors)


def odometry_line(stamp_ns: int, odometry: Odometry) -> str:
    """Return the line of a message of the odometry."""
    return json.dumps({"odometry": {"stamp": format_stamp(stamp_ns), **_sample(odometry)}})


def _sample(odometry: Odometry) -> dict[str, float]:
    sample = {"x": odometry.x, "y": odometry.y, "z": odometry.z, "w": odometry.w}
    return {**sample, **({"error_m": odometry.error_m, "error_rad": odometry.error_rad} if odometry.error_m or odometry.error_rad else {})}


def scan_line(scan: LaserScan, odometry: Odometry | None = None) -> str:
    """Return the line of a scan; numbers have the digits that a float32 needs.

    Parameters
    ----------
    scan
        The scan; the odometry at its last beam is written too if it is known.
    odometry
        That at its first beam, where it is no message.
    """
    at = scan.mounting
    laser = {"x": at.x, "y": at.y, "yaw": at.yaw, "upside_down": at.upside_down}
    numbers = {name: _number(np.float32(getattr(scan, name))) for name in sorted(_NUMBERS)}
    content = {"stamp": format_stamp(scan.stamp_ns), "frame_id": scan.frame_id, "laser": laser, **numbers}
    if odometry is not None:
        content["odometry"] = _sample(odometry)
    if scan.sweep is not None:
        content["end"] = _sample(scan.sweep.last)
    text = json.dumps({"scan": content}, ensure_ascii=False)
    ranges = ", ".join(json.dumps(_number(value)) for value in scan.ranges)
    return f'{text[:-2]}, "ranges": [{ranges}]}}}}'


def _number(value: np.float32) -> float | str | None:
    """Return the shortest decimal that is this float32; JSON has no infinities."""
    if np.isnan(value):
        return None
    return float(str(value)) if np.isfinite(value) else str(value)
