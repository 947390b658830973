"""`OdometryModel`: where particles go when the odometry reports a motion."""

import math
from dataclasses import dataclass, field

import numpy as np

from ial.contractors.boxes import FloatArray
from ial.contractors.kernels import kernel
from ial.contractors.threads import run
from ial.keys.key import key
from ial.keys.kind import Number
from ial.keys.record import Record
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


_NOISE = Number(least=0.0)


@dataclass(frozen=True)
class OdometryModel(Record):
    """A differential drive with Gaussian errors, with the names and the defaults of nav2's AMCL.

    Source: Thrun, Burgard and Fox, Probabilistic Robotics, 2005, table 5.6.
    """

    alpha1: float = field(default=0.2, metadata=key(_NOISE, "rotation's noise from rotation"))
    alpha2: float = field(default=0.2, metadata=key(_NOISE, "rotation's noise from translation"))
    alpha3: float = field(default=0.2, metadata=key(_NOISE, "translation's noise from translation"))
    alpha4: float = field(default=0.2, metadata=key(_NOISE, "translation's noise from rotation"))

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
