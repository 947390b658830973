"""`Scene`: the simulated input of the benchmarks, a scan at a random place in a random floor plan."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

from ial.datasets.motion import MotionBounds
from ial.datasets.scan import LaserScan
from ial.datasets.simulator import Lidar, SensorErrors, simulate
from ial.datasets.walk import random_walk
from ial.lidar.configuration.config import Bounds, LocalizerConfig
from ial.maps.grids.floor_plan import floor_plan
from ial.maps.grids.occupancy_grid import OccupancyGrid
from ial.pose import Pose

BEAMS = 180
OUTLIERS = BEAMS // 10
RANGE_ERROR_M = 0.05
CONFIG = LocalizerConfig(bounds=Bounds(range_error_m=RANGE_ERROR_M, bearing_error_rad=0.0, map_error_m=0.0), outliers=OUTLIERS)


@dataclass(frozen=True, eq=False)
class Scene:
    """A map, a scan, and the pose of the robot in the map frame."""

    grid: OccupancyGrid
    scan: LaserScan
    truth: Pose


def scenes(width_m: float, height_m: float, resolution: float, plans: int, scans: int) -> Iterator[Scene]:
    """Yield scans all around, of `BEAMS` beams with up to `OUTLIERS` wrong, in floor plans of one size; `scans` in each plan."""
    lidar = Lidar(beams=BEAMS, angle_min=-math.pi, angle_increment=2.0 * math.pi / BEAMS)
    errors = SensorErrors(range_error_m=RANGE_ERROR_M, bearing_error_rad=0.0, outliers=OUTLIERS)
    for plan in range(plans):
        grid = floor_plan(width_m, height_m, resolution, plan)
        for seed in range(scans * plan, scans * (plan + 1)):
            (pose,) = random_walk(grid, 1, seed)
            (reading,) = simulate(grid, [pose], lidar, errors, MotionBounds(), seed).recording.readings()
            yield Scene(grid, reading.scan, pose)
