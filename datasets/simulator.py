"""`simulate`: a recording with exact truth, whose errors keep within known bounds.

Every promise of the guarantee can be tested on it: at the true pose at most the given number of beams is bad, by the exact definition of a
good beam, and the odometry recorded from scan to scan encloses the true motion.
"""

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from ial.datasets.in_memory import InMemoryRecording
from ial.datasets.motion import Motion, MotionBounds
from ial.datasets.motion_boxes import PER_SCAN
from ial.datasets.odometry import Odometry
from ial.datasets.odometry_path import OdometryPath
from ial.datasets.recording import Reading
from ial.datasets.scan import LaserScan, Mounting
from ial.datasets.trajectory import Trajectory
from ial.errors import ConfigError
from ial.keys.key import key
from ial.keys.kind import Number, Truth, Whole
from ial.keys.record import Record
from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, OccupancyGrid
from ial.maps.grids.ray_casting import cast_rays
from ial.pose import Pose

_DEPTHS_M = (1e-7, 1e-5, 1e-3)  # how far behind the edge of a cell a beam ends, so that rounding cannot take it out again
_MARGIN_M = 1e-10
_INSIDE = 1.0 - 1e-9  # errors keep off their bound by this factor, which covers the rounding of the simulator itself

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Lidar:
    """A planar lidar.

    Parameters
    ----------
    beams
        Number of beams.
    angle_min, angle_increment
        Bearing of the first beam and step, radians.
    range_min, range_max
        Limits, metres.
    mounting
        Where it sits on the robot.
    """

    beams: int = 181
    angle_min: float = -0.5 * math.pi
    angle_increment: float = math.pi / 180.0
    range_min: float = 0.05
    range_max: float = 30.0
    mounting: Mounting = field(default_factory=Mounting)


@dataclass(frozen=True)
class SensorErrors(Record):
    """What is wrong with the readings."""

    range_error_m: float = field(
        default=0.02, metadata=key(Number(), "bound of the error of a good beam's range, which is uniform within it", "m")
    )
    bearing_error_rad: float = field(default=0.002, metadata=key(Number(), "bound of the error of its bearing", "rad"))
    outliers: int = field(
        default=0,
        metadata=key(Whole(0), "at most so many beams of each scan are replaced: by shorter, longer or random readings, or by none"),
    )
    adversarial: bool = field(
        default=False,
        metadata=key(Truth(), "errors are as large as their bounds allow, and the number of replaced beams is exactly `outliers`"),
    )


@dataclass(frozen=True, eq=False)
class Simulation:
    """A simulated run.

    Parameters
    ----------
    recording
        What the robot recorded.
    truth
        Where it was: ``T_map_base`` at each scan's stamp.
    """

    recording: InMemoryRecording
    truth: Trajectory


def simulate(
    grid: OccupancyGrid,
    path: Sequence[Pose],
    lidar: Lidar,
    errors: SensorErrors,
    bounds: MotionBounds,
    seed: int,
    period_s: float = 0.1,
    start_s: float = 1.0,
    messages: int = 1,
) -> Simulation:
    """Drive along a path and record scans and odometry.

    Parameters
    ----------
    grid
        The map.
    path
        The true poses ``T_map_base``, one for each scan, in free cells; see `random_walk`.
    lidar
        The sensor.
    errors
        What is wrong with its readings.
    bounds
        How far recorded odometry may be from the truth.
    seed
        The same seed gives the same bits.
    period_s, start_s
        Time between scans, and of the first.
    messages
        How many odometry messages each scan brings; the last comes with it.

    Raises
    ------
    ConfigError
        If a pose of the path is not in a free cell, there is no message, or the motion bounds are smaller than what rounding does.
    """
    if messages < 1:
        raise ConfigError(f"messages is {messages}; give at least one odometry message for each scan")
    random = np.random.default_rng(seed)
    readings: list[Reading] = []
    odometry = Odometry.of(Pose(0.0, 0.0, float(random.uniform(-math.pi, math.pi))))
    for index, pose in enumerate(path):
        _check_free(grid, pose, index)
        stamp = round(1e9 * (start_s + index * period_s))
        between = OdometryPath.of()
        if index:
            stamps = [readings[-1].stamp_ns + (stamp - readings[-1].stamp_ns) * part // messages for part in range(messages + 1)]
            driven = simulated_odometry(odometry, path[index - 1], pose, stamps, bounds, errors.adversarial, random)
            odometry, between = driven.last, OdometryPath(driven.stamps_ns[1:-1], driven.numbers[1:-1])
        readings.append(Reading(index, stamp, odometry, simulated_scan(grid, pose, lidar, errors, stamp, random), between))
    recording = InMemoryRecording("simulation", readings)
    return Simulation(recording, Trajectory.of((reading.stamp_ns, pose) for reading, pose in zip(readings, path, strict=True)))


def _check_free(grid: OccupancyGrid, pose: Pose, index: int) -> None:
    at = grid.origin.inverse() @ pose
    row, column = math.floor(at.y / grid.resolution), math.floor(at.x / grid.resolution)
    if not (0 <= row < grid.rows and 0 <= column < grid.columns) or grid.cells[row, column] != FREE:
        raise ConfigError(f"pose {index} of the path, ({pose.x:.3f}, {pose.y:.3f}), is not in a free cell of the map; move it")


def _error(random: np.random.Generator, size: int, bound: float, adversarial: bool) -> FloatArray:
    """Return errors within ±bound: uniform, or at the bound."""
    drawn = random.choice([-1.0, 1.0], size) if adversarial else random.uniform(-1.0, 1.0, size)
    return drawn * (bound * _INSIDE)


def simulated_odometry(
    before: Odometry, start: Pose, end: Pose, stamps: list[int], bounds: MotionBounds, adversarial: bool, random: np.random.Generator
) -> OdometryPath:
    """Return what the odometry of a robot records that moves evenly from one pose to another.

    Parameters
    ----------
    before
        What it recorded last.
    start, end
        Where it truly is, ``T_map_base``.
    stamps
        Of its messages, nanoseconds: that of `before` first.
    bounds
        How far it may be from the truth. The motion that they make of it encloses the true one.
    adversarial
        Whether errors are at their bounds.
    random
        What they are drawn from.

    Raises
    ------
    ConfigError
        If the bounds are smaller than what rounding does.
    """
    truth = Motion.between(Odometry.of(start), Odometry.of(end))
    delta = start.inverse() @ end
    count = len(stamps) - 1
    at = [Pose(part * delta.x / count, part * delta.y / count, part * delta.theta / count) for part in range(count)] + [delta]
    pieces = [one.inverse() @ other for one, other in itertools.pairwise(at)]
    seconds = 1e-9 * (stamps[-1] - stamps[0]) / count
    rooms = []
    for number, piece in enumerate(pieces):
        room = bounds.enclose(piece, seconds)
        once = 0.0 if number == count - 1 else bounds.parts[:, PER_SCAN]  # what a scan adds, it adds with its last message
        rooms.append(_error(random, 3, 1.0, adversarial) * (0.5 * (room.upper - room.lower) - once))
    for share in (1.0, 0.95, 0.9, 0.8, 0.6, 0.3, 0.0):  # the bound belongs to the recorded step, which may be shorter than the true one
        poses = [before.pose]
        for piece, error in zip(pieces, rooms, strict=True):
            dx, dy, turn = (share * error).tolist()
            poses.append(poses[-1] @ Pose(piece.x + dx, piece.y + dy, piece.theta + turn))
        path = OdometryPath.of(zip(stamps, [before, *map(Odometry.of, poses[1:])], strict=True))
        if _within(truth, bounds.along(path)):
            return path
    raise ConfigError("the motion bounds are smaller than the rounding errors of a pose; give at least 1e-9 in per_message or per_scan")


def _within(inner: Motion, outer: Motion) -> bool:
    ends = (inner.lower, inner.upper)
    return all(outer.contains(Pose(*end.tolist())) for end in ends)


def simulated_scan(
    grid: OccupancyGrid, pose: Pose, lidar: Lidar, errors: SensorErrors, stamp_ns: int, random: np.random.Generator
) -> LaserScan:
    """Return a scan from a pose ``T_map_base``, with its stamp in nanoseconds and errors that are drawn from a generator."""
    blank = np.full(lidar.beams, np.inf, dtype=np.float32)
    mounting = lidar.mounting
    limits = (lidar.angle_min, lidar.angle_increment, lidar.range_min, lidar.range_max)
    lower, upper = LaserScan(stamp_ns, blank, *limits, mounting=mounting).bearings()
    laser = grid.origin.inverse() @ pose @ mounting.pose
    bearings = 0.5 * (lower + upper) + _error(random, lidar.beams, errors.bearing_error_rad, errors.adversarial)
    distances = _distances(grid, laser, laser.theta + bearings)
    noise = _error(random, lidar.beams, errors.range_error_m, errors.adversarial)
    ranges = _rounded_within(distances, noise, errors.range_error_m)
    beyond = ranges >= np.float32(lidar.range_max)
    ranges[beyond] = np.inf
    _spoil(ranges, lidar, errors, random)
    return LaserScan(stamp_ns, ranges, *limits, mounting=mounting)


def _distances(grid: OccupancyGrid, laser: Pose, angles: FloatArray) -> FloatArray:
    """Return distances at which a beam ends well inside an occupied cell just behind its edge; inf where it meets none.

    Where a beam only grazes a corner, there is no such point, and it gets no return.
    """
    mask = grid.mask(OCCUPIED)
    edges = cast_rays(mask, grid.resolution, laser.x, laser.y, angles)
    distances = np.full(len(angles), np.inf)
    for depth in _DEPTHS_M:
        reach = np.where(np.isfinite(distances) | ~np.isfinite(edges), 0.0, edges + depth)
        x, y = laser.x + reach * np.cos(angles), laser.y + reach * np.sin(angles)
        inside = np.isinf(distances) & np.isfinite(edges)
        for dx in (-_MARGIN_M, _MARGIN_M):
            for dy in (-_MARGIN_M, _MARGIN_M):
                inside &= _occupied(mask, (x + dx) / grid.resolution, (y + dy) / grid.resolution)
        distances[inside] = reach[inside]
    return distances


def _occupied(mask: npt.NDArray[np.bool_], u: FloatArray, v: FloatArray) -> npt.NDArray[np.bool_]:
    """Return which points, in cells, lie in an occupied cell."""
    column, row = np.floor(u).astype(np.int64), np.floor(v).astype(np.int64)
    within = (row >= 0) & (row < mask.shape[0]) & (column >= 0) & (column < mask.shape[1])
    occupied = np.zeros(len(u), dtype=np.bool_)
    occupied[within] = mask[row[within], column[within]]
    return occupied


def _rounded_within(distances: FloatArray, noise: FloatArray, bound: float) -> npt.NDArray[np.float32]:
    """Return distance + noise as float32, moved towards the distance where rounding would leave the bound."""
    ranges = (distances + noise).astype(np.float32)
    finite = np.isfinite(distances)
    outside = np.zeros(len(distances), dtype=np.bool_)
    outside[finite] = np.abs(ranges[finite] - distances[finite]) > bound
    towards = np.nextafter(ranges[outside], distances[outside].astype(np.float32))
    ranges[outside] = towards
    return ranges


def _spoil(ranges: npt.NDArray[np.float32], lidar: Lidar, errors: SensorErrors, random: np.random.Generator) -> None:
    """Replace some readings by what a scan may hold in their place."""
    most = min(errors.outliers, len(ranges))
    count = most if errors.adversarial else int(random.integers(0, most + 1))
    for beam in random.choice(len(ranges), count, replace=False):
        reading = float(min(ranges[beam], lidar.range_max))
        low, high = lidar.range_min, lidar.range_max
        kind = random.integers(4)
        if kind == 0:
            replacement = random.uniform(min(low, reading), reading)
        elif kind == 1:
            replacement = random.uniform(reading, high)
        elif kind == 2:
            replacement = random.uniform(low, high)
        else:
            replacement = np.inf
        ranges[beam] = replacement
