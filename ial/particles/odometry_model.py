"""`OdometryModel`: where particles go when the odometry reports a motion."""

import math
from dataclasses import dataclass, fields

import numpy as np

from ial.contractors.boxes import FloatArray
from ial.contractors.kernels import kernel
from ial.contractors.threads import run
from ial.errors import ConfigError
from ial.pose import Pose

_TURNS_ON_THE_SPOT_M = 0.01  # a shorter way has no direction


@kernel
def _drive(start, stop, turns, errors, noise, poses):  # type: ignore[no-untyped-def]
    first, way, last = turns
    first_error, way_error, last_error = errors
    for row in range(start, stop):
        theta = poses[row, 2] + first - first_error * noise[row, 0]
        driven = way - way_error * noise[row, 1]
        poses[row, 0] += driven * math.cos(theta)
        poses[row, 1] += driven * math.sin(theta)
        poses[row, 2] = theta + last - last_error * noise[row, 2]


@dataclass(frozen=True)
class OdometryModel:
    """A differential drive with Gaussian errors, with the names and the defaults of nav2's AMCL.

    Parameters
    ----------
    alpha1
        Rotation's noise from rotation.
    alpha2
        Rotation's noise from translation.
    alpha3
        Translation's noise from translation.
    alpha4
        Translation's noise from rotation.

    Raises
    ------
    ConfigError
        If a number is negative or not finite.

    Source: Thrun, Burgard and Fox, Probabilistic Robotics, 2005, table 5.6.
    """

    alpha1: float = 0.2
    alpha2: float = 0.2
    alpha3: float = 0.2
    alpha4: float = 0.2

    def __post_init__(self) -> None:
        for part in fields(self):
            value = getattr(self, part.name)
            if not (math.isfinite(value) and value >= 0.0):
                raise ConfigError(f"{part.name} is {value!r}; give a finite number that is not negative")

    def drive(self, poses: FloatArray, motion: Pose, random: np.random.Generator) -> None:
        """Move particles in place.

        Parameters
        ----------
        poses
            x, y, θ in the map's axes, lengths in metres, float64 of shape (n, 3).
        motion
            What the odometry reports, in the frame of the pose before.
        random
            Where the noise comes from: three numbers a particle, whatever the number of threads.
        """
        way = math.hypot(motion.x, motion.y)
        first = math.atan2(motion.y, motion.x) if way > _TURNS_ON_THE_SPOT_M else 0.0
        last = math.remainder(motion.theta - first, 2.0 * math.pi)
        # Backwards is no turn by half a circle and back.
        first_turn, last_turn = (min(abs(turn), math.pi - abs(turn)) for turn in (first, last))
        errors = (
            math.sqrt(self.alpha1 * first_turn**2 + self.alpha2 * way**2),
            math.sqrt(self.alpha3 * way**2 + self.alpha4 * (first_turn**2 + last_turn**2)),
            math.sqrt(self.alpha1 * last_turn**2 + self.alpha2 * way**2),
        )
        noise = random.standard_normal(poses.shape)
        run(_drive, len(poses), (first, way, last), errors, noise, poses, minimum=1024)
