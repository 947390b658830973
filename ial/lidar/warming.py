"""`warm`: everything that the localizer runs, once, so that the first scan of a robot does not wait for a compiler."""

import dataclasses
import math

import numpy as np

from ial.contractors.boxes import Boxes
from ial.datasets.in_memory import InMemoryRecording
from ial.datasets.odometry import Odometry
from ial.datasets.odometry_buffer import OdometryBuffer
from ial.datasets.recording import Reading, steps
from ial.datasets.scan import LaserScan
from ial.lidar.configuration.config import LocalizerConfig
from ial.lidar.localizer import Localizer
from ial.maps.grids.occupancy_grid import OCCUPIED, OccupancyGrid
from ial.pose import Pose

_SIDE = 80  # cells
_CELL_M = 0.05
_START = Boxes.around([(1.8, 4.7, 4.0)], [0.5, 0.5, 0.2])  # the middle of the room, with headings beyond π


def warm(config: LocalizerConfig | None = None) -> None:
    """Load the kernels that the localizer needs, and compile those that have never been: in a small made-up room.

    Parameters
    ----------
    config
        The configuration that will be used; that of most users by default. The limits in it do not matter.
    """
    config = dataclasses.replace(config or LocalizerConfig(), max_seconds=None)
    for outliers in (config.outliers, 0.1, "auto"):
        for use in (True, False):
            free_space = dataclasses.replace(config.free_space, use=use)
            chosen = dataclasses.replace(config, outliers=outliers, free_space=free_space)
            for grid, initial in ((_room(), None), (dataclasses.replace(_room(), origin=Pose(1.0, 2.0, 0.5)), _START)):
                localizer = Localizer(grid, config=chosen, initial=initial)
                for step in steps(_recording(), config.bounds.motion):
                    localizer.update(step.motion, step.scan)


def _room() -> OccupancyGrid:
    cells = np.zeros((_SIDE, _SIDE), dtype=np.uint8)
    cells[[0, -1]] = cells[:, [0, -1]] = OCCUPIED
    cells[20:30, 50:53] = OCCUPIED
    return OccupancyGrid(cells, _CELL_M)


def _recording() -> InMemoryRecording:
    """Return a few scans from the middle of the room, and then one that fits nowhere near."""
    readings = []
    odometry = OdometryBuffer((stamp, Odometry.of(Pose())) for stamp in (0, 4, 8, 12, 16))
    for index, side in enumerate((1.9, 1.9, 0.7)):
        angles = np.arange(180) * (math.pi / 90.0)
        ranges = side / np.maximum(np.abs(np.cos(angles)), np.abs(np.sin(angles)))
        stamp, end = 4 * index + 1, 4 * index + 6  # between messages, with messages during the scan
        at, sweep = odometry.at(stamp), odometry.sweep(stamp, end)
        assert at is not None
        scan = LaserScan(stamp, ranges.astype(np.float32), 0.0, math.pi / 90.0, 0.05, 10.0, sweep=sweep)
        readings.append(Reading(index, stamp, at, scan, odometry.between(stamp - 4, stamp)))
    return InMemoryRecording("a made-up room", readings)
