"""`random_walk`: a path of poses through the free space of a map."""

import math

import numpy as np
from scipy import ndimage

from ial.errors import MapError
from ial.maps.grids.occupancy_grid import FREE, MaskArray, OccupancyGrid
from ial.pose import Pose, wrap

_TRIES = 100


def random_walk(
    grid: OccupancyGrid, count: int, seed: int, step_m: float = 0.1, turn_rad: float = 0.1, clearance_m: float = 0.2
) -> list[Pose]:
    """Return poses ``T_map_base`` of a robot that wanders about and turns away from what is not free.

    Parameters
    ----------
    grid
        The map.
    count
        The number of poses.
    seed
        The same seed gives the same path.
    step_m, turn_rad
        Largest way and turn from pose to pose.
    clearance_m
        Distance to keep from cells that are not free, measured between centres of cells; less where the map is narrower everywhere.

    Raises
    ------
    MapError
        If no cell of the map is free.
    """
    random = np.random.default_rng(seed)
    clear = _clear_cells(grid, clearance_m)
    row, column = random.choice(np.argwhere(clear))
    inside = random.uniform(0.1, 0.9, 2)
    x, y = (column + inside[0]) * grid.resolution, (row + inside[1]) * grid.resolution
    at = Pose(float(x), float(y), float(random.uniform(-math.pi, math.pi)))
    poses = [at]
    while len(poses) < count:
        at = _next(grid, clear, at, random, step_m, turn_rad)
        poses.append(at)
    return [grid.origin @ pose for pose in poses]


def _clear_cells(grid: OccupancyGrid, clearance_m: float) -> MaskArray:
    free = np.pad(grid.mask(FREE), 1)
    distance = ndimage.distance_transform_edt(free)[1:-1, 1:-1] * grid.resolution
    largest = float(distance.max(initial=0.0))
    if largest == 0.0:
        raise MapError("no cell of the map is free, so there is nowhere to drive; check its thresholds with `ial map info`")
    return np.asarray(distance >= min(clearance_m, largest))


def _next(grid: OccupancyGrid, clear: MaskArray, at: Pose, random: np.random.Generator, step_m: float, turn_rad: float) -> Pose:
    """Return a pose one step ahead, or turned on the spot where no step is free."""
    for _ in range(_TRIES):
        onward = at @ Pose(float(random.uniform(0.0, step_m)), 0.0, float(random.uniform(-turn_rad, turn_rad)))
        points = max(2, math.ceil(2.0 * step_m / grid.resolution))
        if all(_is_clear(grid, clear, at, onward, part / points) for part in range(1, points + 1)):
            return onward
    return Pose(at.x, at.y, wrap(at.theta + float(random.uniform(-turn_rad, turn_rad))))


def _is_clear(grid: OccupancyGrid, clear: MaskArray, start: Pose, end: Pose, share: float) -> bool:
    column = math.floor((start.x + share * (end.x - start.x)) / grid.resolution)
    row = math.floor((start.y + share * (end.y - start.y)) / grid.resolution)
    return 0 <= row < grid.rows and 0 <= column < grid.columns and bool(clear[row, column])
