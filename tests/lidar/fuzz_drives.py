"""`Drive`: a random robot in random maps, which is made to see and to undergo whatever a localizer has to stand."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np

from ial.contractors.boxes import Boxes
from ial.datasets.motion import ErrorBound, Motion, MotionBounds
from ial.datasets.scan import LaserScan, Mounting
from ial.lidar.config import Bounds, FreeSpace, LidarBounds, LocalizerConfig, Precision
from ial.maps.occupancy_grid import FREE, OCCUPIED, UNKNOWN, OccupancyGrid
from ial.maps.ray_casting import cast_rays
from ial.pose import Pose

MODES = ("static", "tracked", "lost", "blind", "maps", "lidars", "deskewed", "limited", "initial", "sheets")
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
    """What a localizer is given. `images` maps a pose to poses elsewhere in the same map that may look alike."""

    mode: str
    seed: int
    grids: dict[str, OccupancyGrid]
    config: LocalizerConfig
    initial: Boxes | None = None
    moments: list[Moment] = field(default_factory=list)
    images: Callable[[Array], list[Array]] = lambda pose: []


def random_drive(mode: str, seed: int) -> Drive:
    """Return one of endlessly many drives; the same mode and seed give the same one."""
    random = np.random.default_rng([MODES.index(mode), seed])
    count = int(random.integers(2, 4)) if mode == "maps" else 1
    twin = mode in ("lost", "static", "initial") and bool(random.integers(2))
    grids = {f"map {number}": _map(random, mode, twin) for number in range(count)}
    grid = grids["map 0"]
    drive = Drive(mode, seed, grids, _config(random, mode, grid))
    width, height = grid.width_m, grid.height_m
    turned = np.array([width, height, math.pi])
    half = np.array([0.5 * width, 0.0, 0.0])
    drive.images = lambda pose: [turned - pose * [1.0, 1.0, -1.0] if not twin else pose + half, pose - half]
    _Driver(drive, random).go()
    if mode in ("initial", "sheets") or (mode in ("lost", "blind") and random.integers(2)):
        drive.initial = _around(drive, random)
    return drive


def _map(random: Random, mode: str, twin: bool) -> OccupancyGrid:
    """Return a closed room with things in it; two alike side by side if wanted, or one that is its own image."""
    rows, columns = (int(each) for each in random.integers(14, 45, 2))
    resolution = float(random.choice([0.05, 0.1, 0.0333, 0.2, 1.0 / 3.0]))
    if mode == "sheets":
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
    far = float(random.choice([0.0, 50.0, 1e4]))
    yaw = float(random.choice([0.0, 0.5 * math.pi, -math.pi, random.uniform(-math.pi, math.pi), random.uniform(-7.0, 7.0)]))
    return OccupancyGrid(cells, resolution, Pose(*random.uniform(-far, far, 2).tolist(), yaw))


def _config(random: Random, mode: str, grid: OccupancyGrid) -> LocalizerConfig:
    """Return a configuration; lengths go with the size of the cells, so that no drive takes long."""
    cell = grid.resolution
    range_error, bearing_error, map_error = random.uniform(0.0, [1.5 * cell, 0.03, 1.5 * cell]) * random.integers(0, 3, 3).clip(0, 1)
    motion = MotionBounds(ErrorBound(0.1, 0.1, 0.1), ErrorBound(0.1, 0.05, 0.1))
    lidars = {"rear": LidarBounds(float(random.uniform(0.0, 2.0 * cell)), float(random.uniform(0.0, 0.05)))} if mode == "lidars" else {}
    bounds = Bounds(float(range_error), float(bearing_error), float(map_error), motion, lidars)
    free = FreeSpace(
        use=bool(random.integers(4)),
        margin_m=float(random.choice([0.0, 0.4, 1.0, 2.5]) * cell),
        max_rays=int(random.integers(1, 16)),
        no_return_m=float(random.choice([0.0, 0.0, 10.0, 60.0]) * cell),
    )
    outliers = ("auto", "auto", "auto", 0.35, 0.29, 0.1, 2, 0)[int(random.integers(8))]
    fine = 0.02 if mode == "sheets" else float(random.uniform(0.7, 4.0))
    config = LocalizerConfig(
        bounds=bounds,
        outliers=outliers,  # type: ignore[arg-type]
        outlier_margin=(0, 1, 0.05, 0.1)[int(random.integers(4))],
        max_outliers=float(random.choice([0.3, 0.7, 1.0])),
        max_jump=float(random.choice([0.1, 1.0])),
        free_space=free,
        precision=Precision(max(fine * cell, 1e-3), float(random.uniform(0.05, 0.3)), int(random.integers(0, 4))),
        max_beams=int(random.integers(8, 40)),
        deskew=mode == "deskewed" or not random.integers(4),
        domain="free_or_unknown" if not random.integers(3) else "free",
        robot_radius_m=float(random.choice([0.0, 0.0, 0.0, 0.7, 1.6]) * cell),
        recovery="restart" if not random.integers(4) else "union",
    )
    if mode == "limited":
        most = (
            {"max_boxes": int(random.choice([1, 20, 300, 5000]))} if random.integers(3) else {"max_seconds": 10.0 ** -random.uniform(1, 4)}
        )
        config = replace(config, **most)
    return config


def _around(drive: Drive, random: Random) -> Boxes:
    """Return boxes of the map frame around the first true pose, and perhaps elsewhere; intervals of angles of any turn."""
    grid, truth = drive.grids[drive.moments[0].place], drive.moments[0].pose
    sizes = {"sheets": [0.05, 0.05, 0.02], "initial": [1.5, 1.5, 2.0]}.get(drive.mode, [0.4, 0.4, 0.4])
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
        self.beams = int(random.integers(8, 45))
        self.view = float(random.uniform(1.5, 2.0 * math.pi)) * float(random.choice([-1.0, 1.0]))
        self.mounting = Mounting(*random.uniform(-0.3, 0.3, 2).tolist(), float(random.uniform(-4.0, 4.0)), bool(random.integers(2)))

    def go(self) -> None:
        """Drive; halfway, a robot that is to get lost is carried away, one that is to be blind sees nonsense."""
        mode, random = self.drive.mode, self.random
        moments = {"static": 1, "initial": 2, "sheets": 3, "maps": 3}.get(mode, 5)
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
        if random.integers(25) == 0:
            return Motion.unknown()
        c, s = math.cos(before[2]), math.sin(before[2])
        x, y, theta = pose - before
        true = np.array([c * x + s * y, c * y - s * x, theta])
        half = random.uniform(0.02, 0.6) * self.sizes * random.uniform(0.1, 1.0, 3)
        middle = true + half * np.where(random.random(3) < 0.3, random.choice([-INSIDE, INSIDE], 3), random.uniform(-1.0, 1.0, 3))
        return Motion(middle - half, middle + half)

    def _scan(self, pose: Array, number: int, nonsense: bool) -> LaserScan:
        """Return what is seen: errors anywhere within their bounds, often at them; some beams spoilt."""
        drive, random = self.drive, self.random
        grid, config, beams = drive.grids[self.place], drive.config, self.beams
        frame = "rear" if drive.mode == "lidars" and number % 2 else "laser"
        mounting = LIDARS["rear"] if frame == "rear" else self.mounting
        limits = (float(random.uniform(-math.pi, math.pi)), self.view / beams, 0.3 * grid.resolution, 60.0 * grid.resolution)
        sweep = Pose(*(0.3 * self.sizes * random.normal(0.0, 1.0, 3)).tolist()) if drive.mode == "deskewed" else None
        blank = LaserScan(0, np.ones(beams, np.float32), *limits, mounting=mounting, frame_id=frame, sweep=sweep)
        bounds = config.bounds.of(frame)
        moved, off = _during(blank, config, random)
        bearings = blank.angle_min + np.arange(beams) * blank.angle_increment
        bearings = mounting.yaw + (-bearings if mounting.upside_down else bearings)
        heading = pose[2] + moved[:, 2] + off[:, 2]
        at = _turned(pose[2], moved[:, :2] + off[:, :2]) + pose[:2] + _turned(heading, np.array([[mounting.x, mounting.y]]))
        shift = float(random.uniform(-math.pi, math.pi))
        at = at + bounds.map_error_m * INSIDE * np.array([math.cos(shift), math.sin(shift)]) * random.integers(2)
        angles = heading + bearings + _errors(random, beams, bounds.bearing_error_rad)
        distance = cast_rays(grid.mask(OCCUPIED), grid.resolution, at[:, 0], at[:, 1], angles)
        ranges = distance + 1e-6 + _errors(random, beams, bounds.range_error_m)
        spoilt = random.random(beams) < (1.0 if nonsense else random.choice([0.0, 0.1, 0.3]))
        other = random.uniform(0.0, 60.0 * grid.resolution, beams)
        ranges[spoilt] = np.where(random.random(beams) < 0.8, other, random.choice([np.inf, np.nan], beams))[spoilt]
        return replace(blank, ranges=ranges.astype(np.float32))


def _during(scan: LaserScan, config: LocalizerConfig, random: Random) -> tuple[Array, Array]:
    """Return how the base moved until each beam by the odometry, and how wrong that is, (x, y, θ) each, as docs/guarantee.md says."""
    sweep = scan.sweep
    if sweep is None or not config.deskew:
        return np.zeros((len(scan), 3)), np.zeros((len(scan), 3))
    share = np.arange(len(scan))[:, None] / (len(scan) - 1)
    way, turn = math.hypot(sweep.x, sweep.y), abs(sweep.theta)
    parts = (config.bounds.motion.translation, config.bounds.motion.translation, config.bounds.motion.rotation)
    most = np.array([part.per_metre * way + part.per_radian * turn for part in parts])
    return share * [sweep.x, sweep.y, sweep.theta], share * most * INSIDE * random.choice([-1.0, 0.0, 1.0], 3)


def _errors(random: Random, count: int, bound: float) -> Array:
    drawn = random.choice([-1.0, 1.0], count) if random.integers(2) else random.uniform(-1.0, 1.0, count)
    return np.asarray(drawn * (bound * INSIDE))


def _turned(angle: float | Array, points: Array) -> Array:
    c, s = np.cos(angle), np.sin(angle)
    return np.stack([c * points[:, 0] - s * points[:, 1], s * points[:, 0] + c * points[:, 1]], axis=1)
