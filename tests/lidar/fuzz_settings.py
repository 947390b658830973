"""Random maps and random configurations for the fuzzer."""

import math
from dataclasses import replace

import numpy as np

from ial.datasets.motion import ErrorBound, MotionBounds
from ial.lidar.configuration.config import Bounds, FreeSpace, LidarBounds, LocalizerConfig, Precision
from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, UNKNOWN, OccupancyGrid
from ial.pose import Pose

Random = np.random.Generator


def factors(random: Random, mode: str, count: int) -> np.ndarray:
    """Return what lengths and angles are multiplied with: 1, and in `extreme` drives sometimes something absurd."""
    absurd = random.random(count) < 0.2 if mode == "extreme" else np.zeros(count, dtype=np.bool_)
    return np.where(absurd, 10.0 ** random.uniform(-7.0, 7.0, count), 1.0)


def random_map(random: Random, mode: str, twin: bool) -> OccupancyGrid:
    """Return a closed room with things in it; two alike side by side if wanted, or one that is its own image."""
    rows, columns = (int(each) for each in random.integers(14, 45, 2))
    resolution = float(random.choice([0.05, 0.1, 0.0333, 0.2, 1.0 / 3.0]))
    resolution *= float(factors(random, mode, 1)[0].clip(1e-4, 1e2))
    if mode == "sections":
        rows, columns, resolution = rows + 90, columns + 90, 1.0 / 3.0
    cells = np.full((rows, columns), FREE, dtype=np.uint8)
    for _ in range(int(random.integers(1, 9))):
        height, width = (int(each) for each in random.integers(1, 7, 2))
        row, column = int(random.integers(rows)), int(random.integers(columns))
        cells[row : row + height, column : column + width] = random.choice([OCCUPIED, OCCUPIED, OCCUPIED, UNKNOWN])
    if random.integers(2):
        cells[random.random(cells.shape) < 0.01] = OCCUPIED
    if twin:
        cells[0], cells[-1], cells[:, 0], cells[:, -1] = (OCCUPIED,) * 4
        cells = np.hstack([cells, cells])
        if random.integers(2):
            cells[random.integers(rows), random.integers(columns)] = OCCUPIED
    elif random.integers(3) == 0:
        cells = np.where(cells[::-1, ::-1] == OCCUPIED, OCCUPIED, cells).astype(np.uint8)
    if random.integers(4):
        cells[0], cells[-1], cells[:, 0], cells[:, -1] = (OCCUPIED,) * 4
    far = float(random.choice([0.0, 50.0, 1e4]) * factors(random, mode, 1)[0])
    yaw = float(random.choice([0.0, 0.5 * math.pi, -math.pi, random.uniform(-math.pi, math.pi), random.uniform(-7.0, 7.0)]))
    return OccupancyGrid(cells, resolution, Pose(*random.uniform(-far, far, 2).tolist(), yaw))


def random_config(random: Random, mode: str, grid: OccupancyGrid, fine: bool) -> LocalizerConfig:
    """Return a configuration; lengths go with the size of the cells, so that no drive takes long."""
    cell = grid.resolution
    range_error, bearing_error, map_error = random.uniform(0.0, [1.5 * cell, 0.03, 1.5 * cell]) * random.integers(0, 3, 3).clip(0, 1)
    range_error, bearing_error, map_error, margin, no_return = factors(random, mode, 5) * (
        range_error,
        bearing_error,
        map_error,
        cell,
        cell,
    )
    motion = MotionBounds(
        ErrorBound(*(factors(random, mode, 4) * random.uniform(0.0, 0.3, 4) * [cell, 1.0, cell, cell]).tolist()),
        ErrorBound(*(factors(random, mode, 4) * random.uniform(0.0, 0.1, 4) * [1.0, 1.0 / cell, 1.0, 1.0]).tolist()),
    )
    lidars = {"rear": LidarBounds(float(random.uniform(0.0, 2.0 * cell)), float(random.uniform(0.0, 0.05)))} if mode == "lidars" else {}
    bounds = Bounds(float(range_error), float(bearing_error), float(map_error), motion, lidars)
    free = FreeSpace(
        use=bool(random.integers(4)),
        margin_m=float(random.choice([0.0, 0.4, 1.0, 2.5]) * margin),
        max_rays=int(random.integers(1, 16)),
        no_return_m=float(random.choice([0.0, 0.0, 10.0, 60.0]) * no_return),
    )
    outliers = ("auto", "auto", "auto", 0.35, 0.29, 0.1, 2, 0)[int(random.integers(8))]
    position, heading = random.uniform([0.7, 0.05], [4.0, 0.3]) if not fine else random.uniform([0.1, 0.01], [0.3, 0.03])
    position = 0.02 if mode == "sections" else position
    config = LocalizerConfig(
        bounds=bounds,
        outliers=outliers,  # type: ignore[arg-type]
        outlier_margin=(0, 1, 0.05, 0.1)[int(random.integers(4))],
        max_outliers=float(random.choice([0.3, 0.7, 1.0])),
        max_jump=float(random.choice([0.1, 1.0])),
        free_space=free,
        precision=Precision(max(float(position) * cell, 1e-3), float(heading), int(random.integers(0, 4))),
        max_beams=int(random.integers(8, 40)),
        deskew=mode in ("deskewed", "extreme") or not random.integers(4),
        domain="free_or_unknown" if not random.integers(3) else "free",
        robot_radius_m=float(random.choice([0.0, 0.0, 0.0, 0.7, 1.6]) * cell),
        recovery="restart" if not random.integers(4) else "union",
    )
    if fine and mode != "sections":
        config = replace(config, max_boxes=20_000)  # a robot that is tracked needs no more, and one that is lost not so many
    if mode == "limited":
        most = (
            {"max_boxes": int(random.choice([1, 20, 300, 5000]))} if random.integers(3) else {"max_seconds": 10.0 ** -random.uniform(1, 4)}
        )
        config = replace(config, **most)
    return config
