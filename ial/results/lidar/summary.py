"""`Summary`: a run in numbers."""

import contextlib
import platform
import time
from array import array
from collections import Counter
from collections.abc import Mapping
from dataclasses import asdict
from importlib.metadata import PackageNotFoundError, version
from typing import Any, Protocol

import numpy as np

from ial.datasets.recording import Step
from ial.datasets.scan import Mounting
from ial.datasets.stamps import format_stamp
from ial.lidar.configuration.config import LocalizerConfig
from ial.lidar.configuration.config_record import config_record
from ial.lidar.estimate import Estimate
from ial.maps.grids.occupancy_grid import OccupancyGrid
from ial.results.lidar.enclosures import Enclosure

_LIBRARIES = ("numpy", "numba", "rosbags", "opencv-python-headless", "matplotlib")


class Source(Protocol):
    """Where the scans of a run come from: a recording, or a robot that is driven. As in `Recording`."""

    name: str
    skipped: Counter[str]
    repaired: Counter[str]


class Summary:
    """Counts and times of a run, for ``summary.json``.

    Parameters
    ----------
    recording
        What is localized.
    grid
        The map.
    config
        The configuration of the localizer.
    options
        What else was chosen: files, which scans, and so on.

    Attributes
    ----------
    last
        The last processed scan.
    first_localized
        The index of the first localized scan.
    """

    def __init__(self, recording: Source, grid: OccupancyGrid, config: LocalizerConfig, options: Mapping[str, Any]) -> None:
        self._recording = recording
        self._grid = grid
        self._config = config
        self._options = dict(options)
        self._begun = time.perf_counter()
        self._statuses: Counter[str] = Counter()
        self._limits: Counter[str] = Counter()
        self._hypotheses: Counter[int] = Counter()
        self._elapsed = array("d")
        self._lidars: dict[str, Mounting] = {}
        self._beams: set[int] = set()
        self._uninformative = 0
        self._vanishing = 0
        self._first: Step | None = None
        self.first_localized: int | None = None
        self.last: Enclosure | None = None

    def __repr__(self) -> str:
        return f"<Summary of {len(self._elapsed)} scans of {self._recording.name}: {self.statuses}>"

    @property
    def localized(self) -> bool:
        """Whether the robot was localized at any scan."""
        return self.first_localized is not None

    @property
    def statuses(self) -> dict[str, int]:
        """The number of scans by status, the most frequent first."""
        return dict(self._statuses.most_common())

    def add(self, step: Step, estimate: Estimate) -> None:
        """Count one scan."""
        self._first = self._first or step
        self.last = Enclosure.of(step, estimate)
        self._statuses[estimate.status] += 1
        self._hypotheses[len(estimate.hypotheses)] += 1
        self._elapsed.append(estimate.elapsed_s)
        self._beams.add(len(step.scan))
        self._lidars.setdefault(step.scan.frame_id, step.scan.mounting)
        self._uninformative += estimate.uninformative
        self._vanishing += estimate.vanishing
        if estimate.limited:
            self._limits[estimate.limited] += 1
        if estimate.status == "localized" and self.first_localized is None:
            self.first_localized = step.index

    def as_dict(self, measures: Mapping[str, Any] | None = None) -> dict[str, Any]:
        """Return everything as plain values that JSON can hold.

        Parameters
        ----------
        measures
            The comparison with a reference, if there is one.
        """
        return {
            "localized": self.localized,
            "first_localized_scan": self.first_localized,
            "last": None if self.last is None else _last(self.last),
            "scans": self._scans(),
            "times": self._times(),
            "measures": None if measures is None else dict(measures),
            "recording": self._about_recording(),
            "map": self._grid.describe(),
            "config": config_record(self._config),
            "options": self._options,
            "versions": {"ial": version("ial"), "python": platform.python_version(), **_versions()},
            "platform": platform.platform(),
        }

    def _scans(self) -> dict[str, Any]:
        processed = len(self._elapsed)
        return {
            "processed": processed,
            "by_status": self.statuses,
            "one_hypothesis": self._hypotheses[1],
            "uninformative": self._uninformative,
            "vanishing": self._vanishing,
            "limited": dict(self._limits),
            "lidars_without_scans": sorted(self._config.bounds.lidars.keys() - self._lidars.keys()),
            "skipped": dict(self._recording.skipped),
            "repaired": dict(self._recording.repaired),
        }

    def _times(self) -> dict[str, float | None]:
        """Return the time of each scan in the localizer, and that of the run with reading and writing."""
        wall = time.perf_counter() - self._begun
        if not self._elapsed:
            return {"median_s": None, "p99_s": None, "max_s": None, "total_s": 0.0, "scans_per_s": None, "wall_s": wall}
        median, p99 = np.percentile(self._elapsed, [50, 99]).tolist()
        total = sum(self._elapsed)
        return {
            "median_s": median,
            "p99_s": p99,
            "max_s": max(self._elapsed),
            "total_s": total,
            "scans_per_s": len(self._elapsed) / total,
            "wall_s": wall,
        }

    def _about_recording(self) -> dict[str, Any]:
        about: dict[str, Any] = {"name": self._recording.name}
        if self._first is None or self.last is None:
            return about
        return {
            **about,
            "first_stamp": format_stamp(self._first.stamp_ns),
            "last_stamp": format_stamp(self.last.stamp_ns),
            "duration_s": 1e-9 * (self.last.stamp_ns - self._first.stamp_ns),
            "beams": sorted(self._beams),
            "lidars": {frame: asdict(mounting) for frame, mounting in self._lidars.items()},
        }


def _versions() -> dict[str, str | None]:
    """Return the versions of the libraries that results depend on; None for one that is installed under another name."""
    versions: dict[str, str | None] = dict.fromkeys(_LIBRARIES)
    for name in _LIBRARIES:
        with contextlib.suppress(PackageNotFoundError):
            versions[name] = version(name)
    return versions


def _last(enclosure: Enclosure) -> dict[str, Any]:
    """Return where the run ended."""
    pose = enclosure.pose
    return {
        "index": enclosure.index,
        "stamp": format_stamp(enclosure.stamp_ns),
        "status": enclosure.status,
        "hypotheses": len(enclosure.hypotheses),
        "pose": None if pose is None else {"x": pose.x, "y": pose.y, "theta": pose.theta},
    }
