"""`SimulatedRobot`: a lidar robot in a map that obeys commands with errors within bounds, and the truth about it."""

import math
from dataclasses import dataclass

import numpy as np

from ial.active.contact import Contact
from ial.active.robot import Drive, Driven
from ial.datasets.motion import Motion, MotionBounds
from ial.datasets.odometry import Odometry
from ial.datasets.scan import LaserScan
from ial.datasets.simulator import Lidar, SensorErrors, simulated_odometry, simulated_scan
from ial.errors import ConfigError
from ial.maps.grids.occupancy_grid import OccupancyGrid
from ial.pose import Pose, wrap

_SPEED_M_S, _TURN_RAD_S, _PAUSE_S, _START_S = 0.5, 1.0, 0.1, 1.0
_SLACK = 0.9  # of the bounds is used by errors of the drive, so that the recorded odometry can enclose it


@dataclass(frozen=True)
class Errors:
    """What is wrong with a simulated robot.

    Parameters
    ----------
    sensor
        With its readings.
    motion
        With its odometry, and with what it makes of a command.
    """

    sensor: SensorErrors
    motion: MotionBounds


class SimulatedRobot:
    """A disk that turns on the spot and drives straight on, and stops where it touches something.

    Parameters
    ----------
    grid
        The map it is in.
    start
        Where it is, ``T_map_base``.
    lidar
        Its sensor.
    errors
        What is wrong with it.
    radius_m
        Its radius.
    seed
        The same seed gives the same errors.

    Raises
    ------
    ConfigError
        If it touches something that is not free where it starts.
    """

    def __init__(self, grid: OccupancyGrid, start: Pose, lidar: Lidar, errors: Errors, radius_m: float = 0.0, seed: int = 0) -> None:
        self.grid, self.lidar, self.errors, self.radius_m = grid, lidar, errors, radius_m
        self._random = np.random.default_rng(seed)
        self._contact = Contact(grid, radius_m)
        self.pose = start
        self.path = [start]
        self.collisions = 0
        self._odometry = Odometry.of(Pose(0.0, 0.0, 0.0))
        self._now_s = _START_S
        if self.touches(start):
            raise ConfigError(
                f"the robot cannot start at ({start.x:g}, {start.y:g}): something that is not free is nearer than its radius, "
                f"{radius_m:g} m; give a start in the free space of the map"
            )

    def __repr__(self) -> str:
        return f"<SimulatedRobot at {self.pose}, {len(self.path) - 1} drives>"

    def touches(self, pose: Pose) -> bool:
        """Return whether a cell that is not free would be nearer than the radius; outside of the map nothing is free."""
        return self._contact.touches(pose)

    @staticmethod
    def seconds(command: Drive) -> float:
        """Return how long it takes to obey a command, in seconds."""
        return abs(command.turn_rad) / _TURN_RAD_S + command.distance_m / _SPEED_M_S + _PAUSE_S

    def look(self) -> LaserScan:
        """Return a scan from where it is."""
        return simulated_scan(self.grid, self.pose, self.lidar, self.errors.sensor, round(1e9 * self._now_s), self._random)

    def drive(self, command: Drive) -> Driven[Motion, LaserScan]:
        """Obey a command, and look."""
        seconds = self.seconds(command)
        reached, collided = self._reached(self._missed(command, seconds))
        stamps = [round(1e9 * self._now_s), round(1e9 * (self._now_s + seconds))]
        path = simulated_odometry(
            self._odometry, self.pose, reached, stamps, self.errors.motion, self.errors.sensor.adversarial, self._random
        )
        self._odometry, self._now_s, self.pose = path.last, self._now_s + seconds, reached
        self.path.append(reached)
        self.collisions += collided
        return Driven(self.errors.motion.along(path), self.look(), collided)

    def _missed(self, command: Drive, seconds: float) -> Pose:
        """Return where the command leads, with an error."""
        turn, way = command.turn_rad, command.distance_m
        told = self.errors.motion.enclose(Pose(way * math.cos(turn), way * math.sin(turn), turn), seconds)
        half = 0.5 * (told.upper - told.lower) * _SLACK
        drawn = self._random.choice([-1.0, 1.0], 3) if self.errors.sensor.adversarial else self._random.uniform(-1.0, 1.0, 3)
        dx, dy, dtheta = (half * drawn).tolist()
        return self.pose @ Pose(way * math.cos(turn) + dx, way * math.sin(turn) + dy, wrap(turn + min(max(dtheta, -1.0), 1.0)))

    def _reached(self, target: Pose) -> tuple[Pose, bool]:
        """Return how far it comes on the straight line to its target, and whether it touches something before."""
        x, y = target.x - self.pose.x, target.y - self.pose.y
        parts = max(2, math.ceil(4.0 * math.hypot(x, y) / self.grid.resolution))
        for part in range(1, parts + 1):
            there = Pose(self.pose.x + x * part / parts, self.pose.y + y * part / parts, target.theta)
            if self.touches(there):
                share = (part - 1) / parts
                return Pose(self.pose.x + x * share, self.pose.y + y * share, target.theta), True
        return target, False
