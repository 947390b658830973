"""`Simulated`: the robot that `ial explore` drives, as its options say, and where it starts."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ial.active.belief import Belief
from ial.active.contact import Contact
from ial.active.simulated_robot import Errors, SimulatedRobot
from ial.datasets.simulator import Lidar, SensorErrors
from ial.errors import ConfigError
from ial.keys.reading import read
from ial.maps.grids.occupancy_grid import OccupancyGrid
from ial.pose import Pose

_TRIES = 1000
_BLIND_M = Lidar().range_min
_MOTION = {
    "translation": {"per_metre": 0.02, "per_radian": 0.01, "per_second": 0.002, "per_scan": 0.01},
    "rotation": {"per_metre": 0.01, "per_radian": 0.03, "per_second": 0.0, "per_scan": 0.005},
}


@dataclass(frozen=True)
class Simulated:
    """What is simulated.

    Parameters
    ----------
    radius_m
        The radius of the robot.
    range_m, beams, fov_deg
        How far its lidar sees, with how many beams, over which angle.
    range_error_m, bearing_error_rad, bad_beams, adversarial
        As in `SensorErrors`.

    Raises
    ------
    ConfigError
        If a number cannot be meant.
    """

    radius_m: float
    range_m: float
    beams: int
    fov_deg: float
    range_error_m: float
    bearing_error_rad: float
    bad_beams: int
    adversarial: bool

    def __post_init__(self) -> None:
        if not 0.0 <= self.radius_m < math.inf:
            raise ConfigError(f"--radius is {self.radius_m:g}; give 0 or a positive length in metres")
        if not _BLIND_M < self.range_m < math.inf:
            raise ConfigError(f"--range is {self.range_m:g}; give a length above {_BLIND_M:g} m, nearer than which a lidar is blind")
        if self.beams < 1:
            raise ConfigError(f"--beams is {self.beams}; a lidar needs at least 1 beam")
        if not 0.0 < self.fov_deg <= 360.0:
            raise ConfigError(f"--fov is {self.fov_deg:g}; give an angle above 0 and up to 360 degrees")
        if not 0 <= self.bad_beams <= self.beams:
            raise ConfigError(f"--bad-beams is {self.bad_beams}; give a number from 0 to --beams, {self.beams}")
        if not self.errors.range_error_m >= 0.0 or not self.errors.bearing_error_rad >= 0.0:
            raise ConfigError("an error of a beam is below 0; give --range-error-m and --bearing-error-rad of 0 or more")

    @property
    def errors(self) -> SensorErrors:
        """What is wrong with the readings."""
        given = {"range_error_m": self.range_error_m, "bearing_error_rad": self.bearing_error_rad}
        return read(SensorErrors(), {**given, "outliers": self.bad_beams, "adversarial": self.adversarial})

    @property
    def lidar(self) -> Lidar:
        """The sensor; one that sees all around has no beam twice."""
        view = math.radians(self.fov_deg)
        gaps = self.beams if self.fov_deg == 360.0 else max(1, self.beams - 1)
        return Lidar(self.beams, -0.5 * view, view / gaps, range_max=self.range_m)

    def bounds(self, *, same_world: bool) -> dict[str, Any]:
        """Return the bounds that follow from the simulated errors, as keys of a configuration.

        Parameters
        ----------
        same_world
            Whether the robot drives in the map itself; else it is not known how many beams the map makes bad.
        """
        found: dict[str, Any] = {"range_error_m": self.range_error_m, "bearing_error_rad": self.bearing_error_rad, "motion": _MOTION}
        return {**found, "outliers": self.bad_beams} if same_world else found

    def robot(self, world: OccupancyGrid, belief: Belief, start: tuple[float, float, float] | None, seed: int) -> SimulatedRobot:
        """Return the robot where it starts.

        Parameters
        ----------
        world
            What it drives in.
        belief
            What is known: the map, and what the robot keeps to everything. Its bounds of motion are those of the simulated odometry.
        start
            x, y in metres and the heading in radians, in the map frame; drawn if None.
        seed
            What errors and the start are drawn from.

        Raises
        ------
        ConfigError
            If it cannot start there, or nowhere.
        """
        at = self._drawn(world, belief, seed) if start is None else self._checked(belief, start)
        errors = Errors(self.errors, belief.localizer.config.bounds.motion)
        return SimulatedRobot(world, at, self.lidar, errors, self.radius_m, seed)

    def _checked(self, belief: Belief, start: tuple[float, float, float]) -> Pose:
        x, y, theta = start
        said = f"--start {x:g} {y:g} {theta:g}"
        if not all(math.isfinite(each) for each in start):
            raise ConfigError(f"{said} is no pose; give finite numbers")
        pose = Pose(x, y, theta)
        clearance = belief.distances.clearance_m
        inside = belief.grid.pose_to_grid(pose)
        if not (0.0 <= inside.x < belief.grid.width_m and 0.0 <= inside.y < belief.grid.height_m):
            raise ConfigError(f"{said} lies outside of the map; give a place in its free space, or leave it out")
        if Contact(belief.grid, 0.0).touches(pose):
            raise ConfigError(f"{said} lies in something that is not free; give a place in the free space of the map, or leave it out")
        if Contact(belief.grid, clearance).touches(pose):
            raise ConfigError(
                f"{said} is nearer than the clearance, {clearance:g} m, to something that is not free; give another place, or a smaller "
                "--clearance"
            )
        return pose

    def _drawn(self, world: OccupancyGrid, belief: Belief, seed: int) -> Pose:
        """Return a start with its clearance in the map, and with its radius in the world."""
        random = np.random.default_rng(seed)
        field, contact = belief.field, Contact(world, self.radius_m)
        places = np.argwhere(field.distance_m >= belief.distances.clearance_m)
        for _ in range(_TRIES):
            row, column = random.choice(places).tolist()
            at = Pose((column + 0.5) * field.place_m, (row + 0.5) * field.place_m, float(random.uniform(-math.pi, math.pi)))
            pose = belief.grid.origin @ at
            if not contact.touches(pose):
                return pose
        raise ConfigError("no start was found that is free both in the map and in the --world; give --start, or maps of one frame")
