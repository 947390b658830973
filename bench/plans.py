"""`plan_and_scans`: the simulated input of the benchmarks, a floor plan with scans at random places in it."""

import math

from ial.datasets.motion import MotionBounds
from ial.datasets.scan import LaserScan
from ial.datasets.simulator import Lidar, SensorErrors, simulate
from ial.datasets.walk import random_walk
from ial.maps.floor_plan import floor_plan
from ial.maps.occupancy_grid import OccupancyGrid
from ial.pose import Pose

BEAMS = 180
OUTLIERS = BEAMS // 10
RANGE_ERROR_M = 0.05


def plan_and_scans(width_m: float, height_m: float, resolution: float, count: int) -> tuple[OccupancyGrid, list[LaserScan], list[Pose]]:
    """Return a floor plan, scans all around with up to `OUTLIERS` of `BEAMS` wrong, and the true poses."""
    grid = floor_plan(width_m, height_m, resolution, seed=1)
    lidar = Lidar(beams=BEAMS, angle_min=-math.pi, angle_increment=2.0 * math.pi / BEAMS)
    errors = SensorErrors(range_error_m=RANGE_ERROR_M, bearing_error_rad=0.0, outliers=OUTLIERS)
    poses = [random_walk(grid, 1, seed)[0] for seed in range(count)]
    scans = []
    for seed, pose in enumerate(poses):
        (reading,) = simulate(grid, [pose], lidar, errors, MotionBounds(), seed).recording.readings()
        scans.append(reading.scan)
    return grid, scans, poses
