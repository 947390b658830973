"""`BounceMonteCarlo`: a particle filter for the bouncing robot, to compare with its sets. It returns guesses, and no guarantee."""

import math
from fractions import Fraction

import numpy as np

from ial.bouncing.execution_bounds import ExecutionBounds
from ial.contractors.boxes import FloatArray
from ial.errors import ConfigError, MapError
from ial.maps.polygons.environment import Environment
from ial.particles.disk_rays import DiskRays
from ial.particles.resampling import low_variance

_MOST_TRIES = 200  # draws of as many places as there are particles; fewer than 1 in 200 free is a robot that hardly fits
_FULL_DEG = 360


class BounceMonteCarlo:
    """Particles that drive to the next wall, are weighed by the number of steps that took, drawn anew, and turned.

    A particle is a pose at the start of a leg. At a bump after k steps, one that has a way in [(k − c)·h·(1 − e), (k + c + 1)·h·(1 + e)] to
    the next wall, where c and e bound the errors of the count and of a step, weighs 1; any other weighs exp(−m²/2), where it misses that by
    m times `miss_steps` steps, or 0. The particles that are drawn by these weights go on from the wall. Their turns are wrong as those of
    `RealRobot` are: the filter is given the distribution of the errors, which a real one has to guess.

    Parameters
    ----------
    environment
        The free space.
    bounce_deg
        φ, counter-clockwise.
    step_m
        h, in metres.
    radius_m
        The radius of the robot; 0 for a point.
    bounds
        What the robot does wrong at most.
    particles
        How many there are.
    miss_steps
        By how many steps a way may be missed, as a standard deviation; 0 for weights of 0 and 1.
    roughening_rad
        Standard deviation of the noise that keeps the headings of drawn particles apart.
    seed
        Of all random numbers; the same seed gives the same cloud.

    Attributes
    ----------
    poses
        x and y in metres and the heading in radians, float64 of shape (particles, 3); empty when all particles are gone.
    bumped
        Whether there was a bump yet; before it the particles are anywhere.

    Raises
    ------
    ConfigError
        If the step is not positive, there are no particles, or a noise is negative.
    MapError
        If the robot hardly fits anywhere.

    Examples
    --------
    >>> from fractions import Fraction
    >>> from ial.maps import Environment
    >>> from ial.maps.polygons.polygon import Polygon
    >>> from ial.particles import BounceMonteCarlo
    >>> corners = [(0, 0), (4, 0), (4, 3), (0, 3)]
    >>> room = Environment((Polygon(tuple((Fraction(x), Fraction(y)) for x, y in corners)),))
    >>> robot = BounceMonteCarlo(room, Fraction(100), Fraction(1, 2), particles=500)
    >>> for observation in (0, 0, 0, 1, 0, 0, 1):
    ...     alive = robot.update(observation)
    >>> alive, robot.poses.shape
    (True, (500, 3))

    Source: Thrun, Burgard and Fox, Probabilistic Robotics, 2005, table 8.2, with a clock and a contact sensor in place of ranges.
    """

    def __init__(
        self,
        environment: Environment,
        bounce_deg: Fraction,
        step_m: Fraction,
        radius_m: Fraction = Fraction(0),
        bounds: ExecutionBounds = ExecutionBounds(),  # noqa: B008 (it is immutable)
        particles: int = 10_000,
        miss_steps: float = 0.0,
        roughening_rad: float = 0.0,
        seed: int = 0,
    ) -> None:
        if step_m <= 0:
            raise ConfigError(f"the step is {float(step_m):g} m; give a length greater than 0")
        if particles < 1:
            raise ConfigError(f"there are {particles} particles; give at least 1")
        if miss_steps < 0.0 or roughening_rad < 0.0:
            raise ConfigError(f"miss_steps is {miss_steps:g} and roughening_rad {roughening_rad:g}; give 0 or more for each")
        self.rays, self.bounds = DiskRays(environment, radius_m), bounds
        self.particles, self.miss_steps, self.roughening_rad = particles, miss_steps, roughening_rad
        self.step_m = float(step_m)
        self._turn, self._turn_error = (2.0 * math.pi * float(each) / _FULL_DEG for each in (bounce_deg, bounds.turn_deg))
        self._random = np.random.default_rng(seed)
        self._steps, self.bumped = 0, False
        self.poses = self._anywhere(environment)

    def __repr__(self) -> str:
        return f"<BounceMonteCarlo: {len(self.poses)} particles>"

    @property
    def memory_bytes(self) -> int:
        """How much memory the particles, their weights and the walls take."""
        numbers = (self.poses.shape[1] + 1) * self.particles  # a pose and a weight each
        return int(numbers * self.poses.itemsize + self.rays.walls.nbytes)

    def update(self, observation: int) -> bool:
        """Take a step with a bump (1) or without one (0); return whether any particle is left."""
        if not observation:
            self._steps += 1
            return len(self.poses) > 0
        steps, self._steps = self._steps, 0
        return self.leg(steps)

    def leg(self, steps: int) -> bool:
        """Take a bump after so many steps without one; return whether any particle is left."""
        self.bumped = True
        if not len(self.poses):
            return False
        distances = self.rays.distances(self.poses)
        weights = self._weights(distances, steps)
        total = float(weights.sum())
        if total == 0.0:
            self.poses = self.poses[:0]
            return False
        rows = low_variance(weights, self.particles, self._random)
        poses, way = self.poses[rows], distances[rows]
        poses[:, 0] += way * np.cos(poses[:, 2])
        poses[:, 1] += way * np.sin(poses[:, 2])
        poses[:, 2] += self._turn + self._turn_error * self._drawn(len(poses))
        if self.roughening_rad:
            poses[:, 2] += self.roughening_rad * self._random.standard_normal(len(poses))
        self.poses = poses
        return True

    def box(self) -> tuple[float, float, float, float] | None:
        """Return the rectangle around all particles: least x and y, greatest x and y, in metres; None if they are gone, or anywhere."""
        if not self.bumped or not len(self.poses):
            return None
        (x0, y0), (x1, y1) = self.poses[:, :2].min(axis=0).tolist(), self.poses[:, :2].max(axis=0).tolist()
        return x0, y0, x1, y1

    def _weights(self, distances: FloatArray, steps: int) -> FloatArray:
        part, count = float(self.bounds.step), self.bounds.count
        least = max(steps - count, 0) * self.step_m * (1.0 - part)
        most = (steps + count + 1) * self.step_m * (1.0 + part)
        missed = np.maximum(np.maximum(least - distances, distances - most), 0.0) / self.step_m
        if self.miss_steps:
            return np.asarray(np.exp(-0.5 * np.square(missed / self.miss_steps)))
        # A way that is a whole number of steps comes out a little too short or too long: a millionth of a step is no miss.
        return (missed < 2.0**-20).astype(np.float64)

    def _drawn(self, count: int) -> FloatArray:
        """Return numbers from −1 to 1, the ends as likely as all the rest."""
        some, kind = self._random.uniform(-1.0, 1.0, count), self._random.integers(0, 4, count)
        return np.where(kind == 0, -1.0, np.where(kind == 1, 1.0, some))

    def _anywhere(self, environment: Environment) -> FloatArray:
        """Return particles spread evenly over the free space and all headings."""
        x0, y0, x1, y1 = map(float, environment.bounds)
        found: list[FloatArray] = []
        missing = self.particles
        for _ in range(_MOST_TRIES):
            places = self._random.uniform((x0, y0), (x1, y1), (self.particles, 2))
            found.append(places[self.rays.are_free(places)][:missing])
            missing -= len(found[-1])
            if not missing:
                headings = self._random.uniform(0.0, 2.0 * math.pi, self.particles)
                return np.column_stack([np.concatenate(found), headings])
        raise MapError(f"a robot of radius {self.rays.radius_m:g} m hardly fits into the environment; check both")
