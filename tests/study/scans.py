"""Random small scans in random small maps, and what the definitions say of them, point by point: the twin's own twin."""

import cmath
import itertools
import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from ial.datasets.motion import ErrorBound, MotionBounds
from ial.datasets.odometry import Odometry
from ial.datasets.odometry_path import OdometryPath
from ial.datasets.scan import LaserScan, Mounting
from ial.lidar.configuration.config import Bounds, FreeSpace, LocalizerConfig
from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, OccupancyGrid
from ial.pose import Pose


def swept(*poses: Pose) -> OdometryPath:
    """Return the odometry of a robot that began at the origin, one message a second."""
    return OdometryPath.of((10**9 * number, Odometry.of(pose)) for number, pose in enumerate((Pose(), *poses)))


@dataclass(frozen=True)
class Case:
    """A map, a scan and a pose of the base in the grid's frame."""

    grid: OccupancyGrid
    config: LocalizerConfig
    scan: LaserScan
    pose: tuple[float, float, float]

    @classmethod
    def random(cls, seed: int) -> "Case":
        random = np.random.default_rng(seed)
        rows, columns = random.integers(6, 25, 2)
        cells = np.where(random.random((rows, columns)) < random.choice([0.02, 0.15]), OCCUPIED, FREE).astype(np.uint8)
        cells[random.integers(rows), random.integers(columns)] = OCCUPIED
        resolution = float(random.choice([0.05, 0.1, 1.0 / 3.0]))
        motion = MotionBounds(ErrorBound(per_metre=0.2, per_scan=1.0), ErrorBound(per_radian=0.1, per_scan=1.0))
        errors = random.uniform(0.0, [0.2, 0.05, 0.1]) * random.integers(0, 2, 3)
        free = FreeSpace(True, float(random.choice([0.0, 0.02, 0.15])), int(random.integers(1, 9)), float(random.choice([0.0, 2.0])))
        config = LocalizerConfig(
            bounds=Bounds(*errors.tolist(), motion), free_space=free, max_beams=int(random.integers(1, 12)), deskew=bool(random.integers(2))
        )
        ranges = random.uniform(0.05, 4.0, int(random.integers(1, 15)))
        ranges[random.random(len(ranges)) < 0.2] = np.inf
        scan = LaserScan(
            0,
            ranges.astype(np.float32),
            float(random.uniform(-3.0, 3.0)),
            float(random.choice([-0.5, 0.3])),
            mounting=Mounting(*random.uniform(-0.3, 0.3, 2).tolist(), float(random.uniform(-3.0, 3.0)), bool(random.integers(2))),
            sweep=swept(Pose(*random.normal(0.0, 0.2, 3).tolist())) if random.integers(2) else None,
        )
        at = random.uniform(-0.2, 1.2, 2) * [columns, rows] * resolution
        case = cls(OccupancyGrid(cells, resolution), config, scan, (*at.tolist(), float(random.uniform(-4.0, 4.0))))
        for beam in np.flatnonzero(random.random(len(ranges)) < 0.5).tolist():  # these end where the errors just allow, or just beyond
            room = errors[0] + errors[2]
            far = case.entered(*next(case.rays(beam, 1))) + float(random.choice([-1.1, -0.9, 0.0, 1.1])) * room
            ranges[beam] = far if 0.0 < far < 30.0 else ranges[beam]
        return replace(case, scan=replace(scan, ranges=ranges.astype(np.float32)))

    @property
    def squares(self) -> list[tuple[float, float]]:
        """The lower left corners of the occupied cells."""
        row, column = np.nonzero(self.grid.mask(OCCUPIED))
        return [(float(x), float(y)) for x, y in zip(column * self.grid.resolution, row * self.grid.resolution, strict=True)]

    def distance(self, point: complex) -> float:
        """Return how far a point is from the nearest closed occupied cell."""
        width, nearest = self.grid.resolution, math.inf
        for x, y in self.squares:
            aside = complex(max(x - point.real, 0.0, point.real - x - width), max(y - point.imag, 0.0, point.imag - y - width))
            nearest = min(nearest, abs(aside))
        return nearest

    def rays(self, beam: int, samples: int, motions: int = 2) -> Iterator[tuple[complex, complex]]:
        """Yield where the laser may have stood in the grid's frame, and which way (a unit) the beam may have gone."""
        scan, bounds, mounting = self.scan, self.config.bounds, self.scan.mounting
        bearing = scan.angle_min + beam * scan.angle_increment
        bearing = mounting.yaw + (-bearing if mounting.upside_down else bearing)
        base, turned = complex(*self.pose[:2]), cmath.exp(1j * self.pose[2])
        sweep = scan.sweep if self.config.deskew and len(scan) > 1 else None
        share = 0.0 if sweep is None else beam / (len(scan) - 1)
        along = Pose() if sweep is None else sweep.last.pose
        way, twist = abs(complex(along.x, along.y)), abs(along.theta)
        off_m, off_rad = share * bounds.motion.translation.per_metre * way, share * bounds.motion.rotation.per_radian * twist
        aside = [0.0] if share == 0.0 else np.linspace(-1.0, 1.0, motions).tolist()
        for dx, dy, twisted in itertools.product(aside, repeat=3):
            moved = complex(share * along.x + dx * off_m, share * along.y + dy * off_m)
            facing = turned * cmath.exp(1j * (share * along.theta + twisted * off_rad))
            laser = base + turned * moved + facing * complex(mounting.x, mounting.y)
            for error in np.linspace(-1.0, 1.0, samples).tolist() if bounds.bearing_error_rad else [0.0]:
                yield laser, facing * cmath.exp(1j * (bearing + error * bounds.bearing_error_rad))

    def entered(self, laser: complex, along: complex, aside: float = 0.0) -> float:
        """Return after how many metres a ray beside the middle one meets a closed occupied cell, by clipping it with each of them."""
        start, width, nearest = laser + 1j * along * aside, self.grid.resolution, math.inf
        for x, y in self.squares:
            enter, leave = 0.0, math.inf
            for at, by, low in ((start.real, along.real, x), (start.imag, along.imag, y)):
                if by == 0.0:
                    enter = enter if low <= at <= low + width else math.inf
                    continue
                one, other = sorted(((low - at) / by, (low + width - at) / by))
                enter, leave = max(enter, one), min(leave, other)
            if enter <= leave:
                nearest = min(nearest, enter)
        return nearest
