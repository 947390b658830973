"""Robots and what they know, for the tests of active localization."""

import dataclasses
import math
from functools import cache

import numpy as np

from ial.active.belief import Belief
from ial.active.simulated_robot import Errors, SimulatedRobot
from ial.datasets.motion import ErrorBound, MotionBounds
from ial.datasets.simulator import Lidar, SensorErrors
from ial.lidar.configuration.config import LocalizerConfig
from ial.lidar.localizer import Localizer
from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, OccupancyGrid
from ial.pose import Pose

RADIUS_M, CLEARANCE_M, LONGEST_S = 0.2, 0.35, 6.0
MOTION = MotionBounds(ErrorBound(0.0, 0.02, 0.01, 0.002, 0.01), ErrorBound(0.0, 0.01, 0.03, 0.0, 0.005))
LIDAR = Lidar(beams=91, angle_min=-math.pi, angle_increment=2.0 * math.pi / 91.0, range_max=4.0)
SENSOR = SensorErrors(0.02, 0.002, 2)


def config(clearance_m: float = CLEARANCE_M) -> LocalizerConfig:
    plain = LocalizerConfig()
    return dataclasses.replace(plain, outliers=4, robot_radius_m=clearance_m, bounds=dataclasses.replace(plain.bounds, motion=MOTION))


def belief(grid: OccupancyGrid) -> Belief:
    return Belief(Localizer(grid, config=config()), RADIUS_M, LONGEST_S)


def robot(grid: OccupancyGrid, start: Pose, seed: int = 0, adversarial: bool = False) -> SimulatedRobot:
    sensor = dataclasses.replace(SENSOR, adversarial=adversarial)
    return SimulatedRobot(grid, start, LIDAR, Errors(sensor, MOTION), RADIUS_M, seed)


def room(width_m: float = 6.0, height_m: float = 4.0) -> OccupancyGrid:
    """A room with a pillar, walls of one cell around it."""
    cells = np.full((round(height_m / 0.05), round(width_m / 0.05)), FREE, dtype=np.uint8)
    cells[[0, -1]] = OCCUPIED
    cells[:, [0, -1]] = OCCUPIED
    cells[30:38, 60:70] = OCCUPIED
    return OccupancyGrid(cells, 0.05)


@cache
def _blocked(grid: OccupancyGrid) -> tuple[np.ndarray, np.ndarray]:
    """Both corners of the cells that are not free, (y, x)."""
    cells = np.argwhere(grid.cells != FREE)
    return cells * grid.resolution, (cells + 1) * grid.resolution


def distance_to_walls(grid: OccupancyGrid, x: float, y: float) -> float:
    """The distance of a point of the grid's frame to the nearest closed cell that is not free, by looking at all of them."""
    low, high = _blocked(grid)
    away = np.maximum(np.maximum(low - [y, x], [y, x] - high), 0.0)
    outside = min(x, y, grid.width_m - x, grid.height_m - y)
    return min(float(np.sqrt((away**2).sum(axis=1)).min()), outside)
