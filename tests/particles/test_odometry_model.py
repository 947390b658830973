import math

import numpy as np
import pytest

from ial.errors import ConfigError
from ial.particles.odometry_model import OdometryModel
from ial.pose import Pose, wrap

CERTAIN = OdometryModel(0.0, 0.0, 0.0, 0.0)
MOTIONS = [Pose(), Pose(0.5, 0.1, 0.3), Pose(-0.5, 0.0, 0.0), Pose(0.0, 0.0, 1.2), Pose(0.2, -0.4, -2.0), Pose(1.0, 0.0, math.pi)]


@pytest.mark.parametrize("motion", MOTIONS)
def test_without_noise_particles_move_as_the_odometry_says(motion: Pose) -> None:
    random = np.random.default_rng(1)
    poses = random.uniform(-3.0, 3.0, (50, 3))
    expected = [Pose(*pose) @ motion for pose in poses.tolist()]
    CERTAIN.drive(poses, motion, random)
    for (x, y, theta), pose in zip(poses.tolist(), expected, strict=True):
        assert (x, y) == pytest.approx((pose.x, pose.y), abs=1e-12)
        assert wrap(theta - pose.theta) == pytest.approx(0.0, abs=1e-12)


def test_the_noise_has_the_deviations_of_the_table() -> None:
    model, motion = OdometryModel(0.01, 0.02, 0.03, 0.04), Pose(2.0, 0.0, 0.5)
    poses = np.zeros((200_000, 3))
    model.drive(poses, motion, np.random.default_rng(2))
    turn = math.sqrt(0.02 * 4.0) ** 2 + (0.01 * 0.25 + 0.02 * 4.0)
    assert poses[:, 2].std() == pytest.approx(math.sqrt(turn), rel=0.01)
    way = np.hypot(poses[:, 0], poses[:, 1])
    assert way.std() == pytest.approx(math.sqrt(0.03 * 4.0 + 0.04 * 0.25), rel=0.02)


def test_a_robot_that_backs_up_does_not_turn() -> None:
    poses = np.zeros((10_000, 3))
    OdometryModel(0.2, 0.0, 0.0, 0.2).drive(poses, Pose(-1.0, 0.0, 0.0), np.random.default_rng(3))
    assert poses == pytest.approx(np.tile([-1.0, 0.0, 0.0], (10_000, 1)), abs=1e-9)


@pytest.mark.parametrize("value", [-0.1, math.inf, math.nan])
def test_noise_that_is_no_variance_is_refused(value: float) -> None:
    with pytest.raises(ConfigError, match="alpha3"):
        OdometryModel(alpha3=value)
