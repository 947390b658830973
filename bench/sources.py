"""The recordings with a reference that several benchmarks use."""

import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ial.datasets.in_memory import InMemoryRecording
from ial.datasets.odometry import Odometry
from ial.datasets.opening import open_recording
from ial.datasets.recording import Reading
from ial.datasets.scan import LaserScan, Mounting
from ial.datasets.trajectory import Trajectory, read_tum
from ial.maps.grids.map_file import read_map
from ial.maps.grids.occupancy_grid import OccupancyGrid
from ial.pose import Pose
from ial.study.reference import TruthFrame

LOGS = {
    "intel_lab": "intel-corrected.log.gz",
    "freiburg_079": "freiburg-079-corrected.log.gz",
    "aces_austin": "aces-corrected.log.gz",
}
NAMES = (*LOGS, "mrpt_loop")


@dataclass(frozen=True)
class Source:
    """A recording, the map and the reference that belong to it, and which scans are used.

    The CARMEN logs are used with the map of their even scans, so every second scan from 1 on. The MRPT loop has a map of the same run.
    """

    name: str
    recording: InMemoryRecording
    grid: OccupancyGrid
    truth: Trajectory
    frame: TruthFrame
    start: int
    every: int

    @classmethod
    def of(cls, name: str) -> "Source":
        """Read the files."""
        folder = Path(os.environ["IAL_DATA"])
        if name == "mrpt_loop":
            folder = folder / "mrpt_malaga"
            truth = read_tum(folder / "pseudo_reference_map_loop.tum")
            return cls(name, mrpt_loop(), read_map(folder / "map_loop.yaml"), truth, "base", 0, 1)
        recording = InMemoryRecording(name, open_recording(folder / name / LOGS[name]).readings())
        return cls(name, recording, read_map(folder / name / "map_even.yaml"), read_tum(folder / name / "gt.tum"), "laser", 1, 2)


def mrpt_loop() -> InMemoryRecording:
    """Return the loop through the Telecommunications Faculty of Málaga, which is there as arrays only."""
    with np.load(Path(os.environ["IAL_DATA"]) / "mrpt_malaga/log_for_map_loop.npz") as file:
        log = {name: file[name] for name in file.files}
    x, y, yaw = log["lidar_in_robot"].tolist()
    angles = log["angles"]
    readings = []
    for index, (time, odometry, ranges, invalid) in enumerate(zip(log["t"], log["odom"], log["ranges"], log["invalid"], strict=True)):
        stamp = round(1e9 * float(time))
        scan = LaserScan(
            stamp,
            np.where(invalid, np.float32(np.inf), ranges),
            float(angles[0]),
            float(angles[1] - angles[0]),
            range_max=float(log["range_max"]),
            mounting=Mounting(x, y, yaw),
        )
        readings.append(Reading(index, stamp, Odometry.of(Pose(*odometry.tolist())), scan))
    return InMemoryRecording("mrpt_loop", readings)
