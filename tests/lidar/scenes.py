"""`Scene`: a random map, robot, lidar and configuration whose assumptions hold by construction, for the tests of the guarantee."""

import math
from dataclasses import dataclass, replace

import numpy as np

from ial.datasets.in_memory import InMemoryRecording
from ial.datasets.motion import ErrorBound, MotionBounds
from ial.datasets.scan import Mounting
from ial.datasets.simulator import Lidar, SensorErrors, simulate
from ial.datasets.walk import random_walk
from ial.lidar.configuration.config import Bounds, LocalizerConfig, Precision
from ial.maps.grids.floor_plan import floor_plan
from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, UNKNOWN, OccupancyGrid
from ial.pose import Pose

CLEARANCE_M = 0.25  # more than a map is ever shifted, so that the robot stays in free cells of the shifted map


@dataclass(frozen=True)
class Scene:
    """What a localizer is given, and where the robot truly was, in the map frame."""

    grid: OccupancyGrid
    config: LocalizerConfig
    recording: InMemoryRecording
    path: list[Pose]


def random_scene(seed: int, scans: int = 1, excess: float = 1.0) -> Scene:
    """Return a scene whose errors are `excess` times as large as its bounds say; up to 1 all assumptions hold."""
    random = np.random.default_rng(seed)
    world = _world(random, seed, closed=scans > 1)
    bounds, lidar = _bounds(random), _lidar(random)
    outliers = int(random.integers(0, lidar.beams // 5))
    errors = SensorErrors(
        range_error_m=excess * bounds.range_error_m,
        bearing_error_rad=excess * bounds.bearing_error_rad,
        outliers=outliers,
        adversarial=bool(random.integers(2)),
    )
    path = random_walk(world, scans, seed, step_m=0.4, turn_rad=0.6, clearance_m=CLEARANCE_M)
    recording = simulate(world, path, lidar, errors, bounds.motion, seed).recording
    config = LocalizerConfig(
        bounds=bounds,
        outliers=outliers,
        precision=Precision(float(random.uniform(0.1, 0.3)), float(random.uniform(0.05, 0.15)), int(random.integers(0, 4))),
        max_beams=int(random.choice([180, lidar.beams - lidar.beams // 4])),
        domain="free_or_unknown" if random.integers(4) == 0 else "free",
    )
    return Scene(_shifted(world, excess * bounds.map_error_m, random), config, recording, path)


def _world(random: np.random.Generator, seed: int, closed: bool) -> OccupancyGrid:
    """Return a floor plan or scattered blocks, some cells unknown, anywhere in the map frame and turned."""
    width, height = random.uniform(6.0, 12.0, 2)
    resolution = float(random.choice([0.03, 0.05, 0.1]))
    if closed or random.integers(3):
        cells = floor_plan(width, height, resolution, seed).cells.copy()
    else:
        cells = np.full((round(height / resolution), round(width / resolution)), FREE, dtype=np.uint8)
        for _ in range(int(random.integers(5, 30))):
            _block(cells, random, 1.0 / resolution)[:] = OCCUPIED
    for _ in range(int(random.integers(0, 3))):
        part = _block(cells, random, 2.0 / resolution)
        part[part == FREE] = UNKNOWN
    turned = random.integers(4) > 0
    origin = Pose(*random.uniform(-50.0, 50.0, 2).tolist(), float(random.uniform(-math.pi, math.pi)) if turned else 0.0)
    return OccupancyGrid(cells, resolution, origin)


def _block(cells: np.ndarray, random: np.random.Generator, largest: float) -> np.ndarray:
    """Return a random rectangle of cells, as a view."""
    height, width = (int(random.integers(1, max(2, round(largest)))) for _ in range(2))
    row, column = int(random.integers(0, cells.shape[0])), int(random.integers(0, cells.shape[1]))
    return cells[row : row + height, column : column + width]


def _bounds(random: np.random.Generator) -> Bounds:
    """Return error bounds; each of them is zero in some scenes, but the first two not both."""
    range_error, map_error = random.uniform(0.0, 0.1, 2) * random.choice([[1, 1], [1, 0], [0, 1]])
    translation = ErrorBound(float(random.uniform(0.02, 0.1)), float(random.uniform(0.0, 0.2)), 0.0)
    rotation = ErrorBound(float(random.uniform(0.02, 0.1)), 0.0, float(random.uniform(0.0, 0.2)))
    return Bounds(
        range_error_m=float(range_error),
        bearing_error_rad=float(random.choice([0.0, random.uniform(0.0, 0.02)])),
        map_error_m=float(map_error),
        motion=MotionBounds(translation, rotation),
    )


def _lidar(random: np.random.Generator) -> Lidar:
    """Return a lidar: any field of view, either direction of turning, any mounting, upside down in half of the scenes."""
    beams = int(random.integers(25, 100))
    view = float(random.uniform(0.5 * math.pi, 2.0 * math.pi))
    mounting = Mounting(*random.uniform(-0.3, 0.3, 2).tolist(), float(random.uniform(-math.pi, math.pi)), bool(random.integers(2)))
    return Lidar(
        beams=beams,
        angle_min=float(random.uniform(-math.pi, math.pi)),
        angle_increment=float(random.choice([-1.0, 1.0])) * view / beams,
        range_min=float(random.choice([0.05, 0.3])),
        range_max=float(random.uniform(5.0, 30.0)),
        mounting=mounting,
    )


def _shifted(world: OccupancyGrid, distance_m: float, random: np.random.Generator) -> OccupancyGrid:
    """Return the map that the localizer gets: off by a distance, in any direction."""
    direction = float(random.uniform(-math.pi, math.pi))
    distance_m *= 1.0 - 1e-9  # covers the rounding of this
    at = world.origin
    return replace(world, origin=Pose(at.x + distance_m * math.cos(direction), at.y + distance_m * math.sin(direction), at.theta))
