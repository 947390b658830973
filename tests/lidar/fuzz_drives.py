"""`Drive`: a random robot in random maps, which is made to see and to undergo whatever a localizer has to stand."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np

from ial.contractors.boxes import Boxes
from ial.datasets.motion import Motion
from ial.datasets.odometry import Odometry
from ial.datasets.odometry_path import OdometryPath
from ial.datasets.scan import LaserScan, Mounting
from ial.lidar.configuration.config import LocalizerConfig
from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, OccupancyGrid
from ial.maps.grids.ray_casting import cast_rays
from ial.pose import Pose
from ial.study.possible_motions import possible_motions
from tests.lidar.fuzz_settings import factors, random_config, random_map

MODES = ("static", "tracked", "lost", "blind", "maps", "lidars", "deskewed", "limited", "initial", "fine", "extreme", "sections")
INSIDE = 1.0 - 1e-9
LIDARS = {"laser": Mounting(), "rear": Mounting(-0.2, 0.05, math.pi, upside_down=True)}

Random = np.random.Generator
Array = np.ndarray


@dataclass(frozen=True, eq=False)
class Moment:
    """A scan and the motion before it; where the robot truly was, in the frame of the grid of this name."""

    motion: Motion | None
    scan: LaserScan
    place: str
    pose: Array


@dataclass(eq=False)
class Drive:
    """What a localizer is given, with small cells if it is `fine`; `images` maps a pose to poses elsewhere that may look alike."""

    mode: str
    seed: int
    grids: dict[str, OccupancyGrid]
    config: LocalizerConfig
    fine: bool
    initial: Boxes | None = None
    moments: list[Moment] = field(default_factory=list)
    images: Callable[[Array], list[Array]] = lambda pose: []


def random_drive(mode: str, seed: int) -> Drive:
    """Return one of endlessly many drives; the same mode and seed give the same one."""
    random = np.random.default_rng([MODES.index(mode), seed])
    count = int(random.integers(2, 4)) if mode == "maps" else 1
    twin = mode in ("lost", "static", "initial") and bool(random.integers(2))
    grids = {f"map {number}": random_map(random, mode, twin) for number in range(count)}
    grid = grids["map 0"]
    fine = mode in ("fine", "sections") or (mode in ("deskewed", "lidars") and bool(random.integers(2)))
    drive = Drive(mode, seed, grids, random_config(random, mode, grid, fine), fine)
    width, height = grid.width_m, grid.height_m
    turned = np.array([width, height, math.pi])
    half = np.array([0.5 * width, 0.0, 0.0])
    drive.images = lambda pose: [turned - pose * [1.0, 1.0, -1.0] if not twin else pose + half, pose - half]
    _Driver(drive, random).go()
    if fine or mode == "initial" or (mode in ("lost", "blind") and random.integers(2)):
        drive.initial = _around(drive, random, [0.5, 0.5, 0.05] if fine else [5.0, 5.0, 2.0] if mode == "initial" else [3.0, 3.0, 0.4])
    return drive


def _around(drive: Drive, random: Random, cells: list[float]) -> Boxes:
    """Return boxes of the map frame around the first true pose, and perhaps its images: so many cells and radians wide, any turn."""
    grid, truth = drive.grids[drive.moments[0].place], drive.moments[0].pose
    sizes = np.array([grid.resolution, grid.resolution, 1.0]) * cells
    poses = [truth, *(drive.images(truth) if drive.mode == "initial" else [])][: int(random.integers(1, 4))]
    boxes = []
    for pose in poses:
        x, y, theta = (float(each) for each in grid.to_map(*pose))
        middle = np.array([x, y, theta + 2.0 * math.pi * int(random.integers(-2, 3))])
        low, high = random.uniform(0.1, 1.0, (2, 3)) * sizes
        boxes.append(list(zip((middle - low).tolist(), (middle + high).tolist(), strict=True)))
    return Boxes.of(*boxes)


class _Driver:
    """Moves the robot and makes its scans."""

    def __init__(self, drive: Drive, random: Random) -> None:
        self.drive = drive
        self.random = random
        self.place = str(random.choice(list(drive.grids)))
        self.sizes = np.array([6.0, 6.0, 0.0]) * drive.grids["map 0"].resolution + [0.0, 0.0, 0.5]
        self.beams = int(random.integers(1 if drive.mode == "extreme" else 8, 45))
        self.view = float(random.uniform(1.5, 2.0 * math.pi)) * float(random.choice([-1.0, 1.0]))
        self.view *= float(factors(random, drive.mode, 1)[0].clip(1e-7, 1e2))
        far = factors(random, drive.mode, 2)
        self.mounting = Mounting(*(random.uniform(-0.3, 0.3, 2) * far).tolist(), float(random.uniform(-4.0, 4.0)), bool(random.integers(2)))

    def go(self) -> None:
        """Drive; halfway, a robot that is to get lost is carried away, one that is to be blind sees nonsense."""
        mode, random = self.drive.mode, self.random
        moments = {"static": 1, "initial": 2, "sections": 3, "maps": 3}.get(mode, 5)
        pose = self._free_pose()
        for number in range(moments):
            motion = None
            if number:
                before, pose = pose, self._moved(pose)
                motion = self._motion(before, pose)
            if number == 2 and mode in ("lost", "maps"):
                elsewhere = [each for each in self.drive.images(pose) if self._is_free(each)]
                pose = elsewhere[0] if elsewhere and random.integers(3) else self._free_pose()
            nonsense = mode == "blind" and number == 2
            self.drive.moments.append(Moment(motion, self._scan(pose, number, nonsense), self.place, pose))

    def _is_free(self, pose: Array) -> bool:
        grid = self.drive.grids[self.place]
        column, row = np.floor(pose[:2] / grid.resolution).astype(int).tolist()
        return 0 <= row < grid.rows and 0 <= column < grid.columns and grid.cells[row, column] == FREE

    def _free_pose(self) -> Array:
        grid = self.drive.grids[self.place]
        row, column = self.random.permutation(np.argwhere(grid.cells == FREE))[0]
        at = (np.array([column, row]) + self.random.random(2)) * grid.resolution
        return np.array([*at.tolist(), float(self.random.uniform(-math.pi, math.pi))])

    def _moved(self, pose: Array) -> Array:
        for _ in range(20):
            moved = pose + self.random.normal(0.0, 0.5, 3) * self.sizes
            if self._is_free(moved):
                return np.asarray(moved)
        return pose

    def _motion(self, before: Array, pose: Array) -> Motion:
        """Return a box of motions that holds the true one, near its border as often as within."""
        random = self.random
        if random.integers(25) == 0 and not self.drive.fine:
            return Motion.unknown()
        c, s = math.cos(before[2]), math.sin(before[2])
        x, y, theta = pose - before
        true = np.array([c * x + s * y, c * y - s * x, theta])
        half = random.uniform(0.02, 0.1 if self.drive.fine else 0.6) * self.sizes * random.uniform(0.1, 1.0, 3)
        middle = true + half * np.where(random.random(3) < 0.3, random.choice([-INSIDE, INSIDE], 3), random.uniform(-1.0, 1.0, 3))
        return Motion(middle - half, middle + half)

    def _sweep(self) -> OdometryPath:
        """Return what the odometry says during a scan, in a few messages, some of them interpolated."""
        random, at = self.random, Pose(*self.random.uniform(-3.0, 3.0, 3).tolist())
        samples, stamp = [], 10**9
        for _ in range(int(random.integers(2, 5))):
            off = random.uniform(0.0, [0.02 * self.sizes[0], 0.01]) * random.integers(2)
            samples.append((stamp, Odometry.of(at, *off.tolist())))
            at = at @ Pose(*(0.1 * self.sizes * random.normal(0.0, 1.0, 3)).tolist())
            stamp += int(random.integers(10**6, 10**8))
        return OdometryPath.of(samples)

    def _scan(self, pose: Array, number: int, nonsense: bool) -> LaserScan:
        """Return what is seen: errors anywhere within their bounds, often at them; some beams spoilt."""
        drive, random = self.drive, self.random
        grid, config, beams = drive.grids[self.place], drive.config, self.beams
        frame = "rear" if drive.mode == "lidars" and number % 2 else "laser"
        mounting = LIDARS["rear"] if frame == "rear" else self.mounting
        limits = (float(random.uniform(-math.pi, math.pi)), self.view / beams, 0.3 * grid.resolution, 60.0 * grid.resolution)
        sweep = self._sweep() if drive.mode in ("deskewed", "extreme") else None
        blank = LaserScan(0, np.ones(beams, np.float32), *limits, mounting=mounting, frame_id=frame, sweep=sweep)
        bounds = config.bounds.of(frame)
        moved = np.zeros((beams, 3))
        if sweep is not None and config.deskew and beams > 1:
            moves = possible_motions(sweep, config.bounds.motion, np.arange(beams) / (beams - 1))
            moved = moves[:, int(random.integers(moves.shape[1]))]
        bearings = blank.angle_min + np.arange(beams) * blank.angle_increment
        bearings = mounting.yaw + (-bearings if mounting.upside_down else bearings)
        heading = pose[2] + moved[:, 2]
        at = _turned(pose[2], moved[:, :2]) + pose[:2] + _turned(heading, np.array([[mounting.x, mounting.y]]))
        shift = float(random.uniform(-math.pi, math.pi))
        at = at + bounds.map_error_m * INSIDE * np.array([math.cos(shift), math.sin(shift)]) * random.integers(2)
        angles = heading + bearings + _errors(random, beams, bounds.bearing_error_rad)
        start = np.clip(at, -1e9 * grid.resolution, 1e9 * grid.resolution)  # as far as rays can be cast from
        distance = cast_rays(grid.mask(OCCUPIED), grid.resolution, start[:, 0], start[:, 1], np.mod(angles, 2.0 * math.pi))
        ranges = distance + 1e-6 + _errors(random, beams, bounds.range_error_m)
        spoilt = random.random(beams) < (1.0 if nonsense else random.choice([0.0, 0.1, 0.3]))
        other = random.uniform(0.0, 60.0 * grid.resolution, beams)
        ranges = ranges * factors(random, drive.mode, beams)
        ranges[spoilt] = np.where(random.random(beams) < 0.8, other, random.choice([np.inf, np.nan], beams))[spoilt]
        return replace(blank, ranges=ranges.astype(np.float32))


def _errors(random: Random, count: int, bound: float) -> Array:
    drawn = random.choice([-1.0, 1.0], count) if random.integers(2) else random.uniform(-1.0, 1.0, count)
    return np.asarray(drawn * (bound * INSIDE))


def _turned(angle: float | Array, points: Array) -> Array:
    c, s = np.cos(angle), np.sin(angle)
    return np.stack([c * points[:, 0] - s * points[:, 1], s * points[:, 0] + c * points[:, 1]], axis=1)
