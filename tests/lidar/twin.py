"""`World`: a random small map with a robot in it, and what is certain about the beams of one scan."""

import math
from dataclasses import dataclass

import numpy as np

from ial.contractors.boxes import Boxes, FloatArray
from ial.datasets.scan import BeamClass, LaserScan, Mounting
from ial.lidar.configuration.config import Bounds, LocalizerConfig
from ial.lidar.evidence.beams import Beams, select_beams
from ial.maps.grids.cell_index import CellIndex
from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, OccupancyGrid
from ial.maps.grids.ray_casting import cast_rays
from ial.pose import Pose
from ial.study.good_beams import good_beams
from ial.study.obstacles import Obstacles
from ial.study.used_beams import UsedBeams

INSIDE = 1.0 - 1e-9  # errors keep off their bound by this factor, which covers the rounding of the world itself


@dataclass(frozen=True)
class World:
    """A map, a robot in it, and one scan."""

    mask: np.ndarray
    resolution: float
    pose: Pose
    scan: LaserScan
    bounds: Bounds

    @classmethod
    def random(cls, random: np.random.Generator) -> "World":
        """Return a world whose beams mostly end as far from the walls as the bounds allow, some beyond that, some anywhere."""
        rows, columns = random.integers(8, 40, 2)
        mask = random.random((rows, columns)) < random.choice([0.003, 0.02, 0.1])
        mask[random.integers(rows), random.integers(columns)] = True
        resolution = float(random.choice([0.05, 0.1, 1.0 / 3.0]))
        size = np.array([columns, rows]) * resolution
        pose = Pose(*random.uniform(-0.1 * size, 1.1 * size).tolist(), float(random.uniform(-math.pi, math.pi)))
        mounting = Mounting(*random.uniform(-0.3, 0.3, 2).tolist(), float(random.uniform(-math.pi, math.pi)), bool(random.integers(2)))
        range_error, bearing_error, map_error = random.uniform(0.0, 0.1, 3) * random.integers(0, 2, 3)
        bounds = Bounds(float(range_error), float(bearing_error), float(map_error))
        blank = LaserScan(0, np.ones(int(random.integers(1, 40)), np.float32), -3.0, float(random.choice([-0.15, 0.15])), mounting=mounting)
        laser = pose @ mounting.pose
        turn = bearing_error * random.choice([-1.0, 1.0], len(blank)) * INSIDE
        distance = cast_rays(mask, resolution, laser.x, laser.y, laser.theta + bearings(blank) + turn)
        far = (range_error + map_error) * random.choice([-1.0, -1.0, 0.5, 3.0], len(blank)) * (1.0 - 1e-6)
        ranges = np.maximum(distance + far, 0.0).astype(np.float32)
        wrong = random.random(len(blank)) < random.choice([0.0, 0.3])
        ranges[wrong] = random.uniform(0.0, 8.0, int(wrong.sum()))
        limits = (blank.angle_min, blank.angle_increment)
        return cls(mask, resolution, pose, LaserScan(0, ranges, *limits, mounting=mounting), bounds)

    def hits(self) -> np.ndarray:
        """Return the numbers of the beams that the localizer uses."""
        return np.flatnonzero(self.scan.classes() == BeamClass.HIT)

    def beams(self, outliers: int) -> Beams:
        """Return the evidence of the scan with a number of outliers."""
        return select_beams(self.scan, self.bounds, outliers, len(self.scan))

    def index(self) -> CellIndex:
        """Return the occupied cells."""
        return CellIndex(self.mask, self.resolution)

    def distances(self, x: FloatArray, y: FloatArray) -> FloatArray:
        """Return the Euclidean distance of points to the nearest closed occupied cell."""
        row, column = np.nonzero(self.mask)
        dx = np.maximum(np.maximum(column * self.resolution - x[..., None], x[..., None] - (column + 1) * self.resolution), 0.0)
        dy = np.maximum(np.maximum(row * self.resolution - y[..., None], y[..., None] - (row + 1) * self.resolution), 0.0)
        return np.hypot(dx, dy).min(axis=-1)

    def certainly_good(self) -> np.ndarray:
        """Return which used beams are good at the pose."""
        cells = np.where(self.mask, OCCUPIED, FREE).astype(np.uint8)
        beams = UsedBeams.of(self.scan, LocalizerConfig(bounds=self.bounds, max_beams=len(self.scan)))
        at = np.array([[self.pose.x, self.pose.y, self.pose.theta]])
        return np.asarray(good_beams(beams, at, Obstacles(OccupancyGrid(cells, self.resolution)))[0])

    def certainly_bad(self, spread_m: float = 0.0, turn_rad: float = 0.0) -> np.ndarray:
        """Return which used beams are bad wherever the pose is off by at most `spread_m` along each axis and by `turn_rad`."""
        laser = self.pose @ self.scan.mounting.pose
        used = self.hits()
        reading, angle = self.scan.ranges[used].astype(np.float64), laser.theta + bearings(self.scan)[used]
        farthest, arm = reading + self.bounds.range_error_m, math.hypot(self.scan.mounting.x, self.scan.mounting.y)
        room = self.bounds.map_error_m + self.bounds.range_error_m + farthest * self.bounds.bearing_error_rad
        room = room + spread_m + (farthest + arm) * turn_rad + 1e-5
        at = self.distances(laser.x + reading * np.cos(angle), laser.y + reading * np.sin(angle))
        return np.asarray(at > math.sqrt(2.0) * room)

    def box_around(self, random: np.random.Generator) -> Boxes:
        """Return a random box that holds the pose: inside, on a face or on a corner; as small as a point or as large as the world."""
        at = np.array([self.pose.x, self.pose.y, self.pose.theta])
        widths = random.choice([0.0, 1e-15, 1e-6, 0.01, 0.3, 3.0], 3)
        share = random.choice([0.0, 1.0, random.random()], 3)
        lower, upper = at - share * widths, at + (1.0 - share) * widths
        if random.integers(10) == 0:
            lower[2], upper[2] = -math.nextafter(math.pi, 4.0), math.nextafter(math.pi, 4.0)
        elif lower[2] < -math.pi:
            lower[2], upper[2] = lower[2] + 2.0 * math.pi - 1e-15, upper[2] + 2.0 * math.pi + 1e-15
        return Boxes(lower[None], upper[None])


def bearings(scan: LaserScan) -> FloatArray:
    """Return the middle of each beam's bearing in the frame of the mounting."""
    lower, upper = scan.bearings()
    return 0.5 * (lower + upper)
