from fractions import Fraction

import numpy as np
import pytest

from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.rays.real_robot import RealRobot
from ial.errors import ConfigError, MapError
from ial.particles.bounce_monte_carlo import BounceMonteCarlo
from tests.bouncing.judged_runs import WORLDS

HALL = WORLDS["hall"]
ANGLE, STEP, RADIUS = Fraction(100), Fraction(1, 4), Fraction(1, 5)
SOME = ExecutionBounds(Fraction(2), Fraction(1, 50), 1)


def test_a_robot_with_errors_is_found() -> None:
    near = 0
    for seed in range(5):
        robot = RealRobot(HALL, ANGLE, STEP, RADIUS, SOME, seed)
        particles = BounceMonteCarlo(HALL, ANGLE, STEP, RADIUS, SOME, particles=20_000, seed=seed)
        assert particles.box() is None
        for _ in range(20):
            for pose in robot.leg():
                assert particles.update(pose.observation)
        x0, y0, x1, y1 = particles.box() or (9.0, 9.0, 0.0, 0.0)
        x, y = float(robot.pose[0]), float(robot.pose[1])
        near += x0 - 0.1 <= x <= x1 + 0.1 and y0 - 0.1 <= y <= y1 + 0.1 and max(x1 - x0, y1 - y0) < 4.5
    assert near >= 4  # it promises nothing


@pytest.mark.parametrize("miss_steps", [0.0, 1.0])
def test_ways_that_do_not_fit_weigh_less(miss_steps: float) -> None:
    """After a turn by 180° particles drive at least as far as they came, so those that came 20 steps can drive 20."""
    particles = BounceMonteCarlo(HALL, Fraction(180), STEP, RADIUS, particles=5_000, miss_steps=miss_steps, seed=1)
    before = particles.rays.distances(particles.poses)
    assert particles.leg(20)
    backwards = particles.rays.distances(particles.poses)
    fits = (backwards >= 20 * float(STEP) - 1e-6).mean()
    assert (before >= 20 * float(STEP)).mean() < 0.5
    assert fits == 1.0 if not miss_steps else 0.5 < fits < 1.0


def test_a_count_that_no_way_explains_ends_a_hard_filter_and_not_a_soft_one() -> None:
    hard = BounceMonteCarlo(HALL, ANGLE, STEP, RADIUS, particles=500, seed=1)
    assert hard.update(0)
    assert not hard.leg(200)
    assert hard.box() is None
    assert not hard.update(0)
    assert not hard.leg(1)
    soft = BounceMonteCarlo(HALL, ANGLE, STEP, RADIUS, particles=500, miss_steps=10.0, seed=1)
    assert soft.leg(60)
    assert len(soft.poses) == 500


def test_observations_one_by_one_are_a_leg_at_once_and_a_seed_gives_the_same_cloud() -> None:
    def made() -> BounceMonteCarlo:
        return BounceMonteCarlo(HALL, ANGLE, STEP, RADIUS, SOME, particles=300, roughening_rad=0.01, seed=3)

    one, other = made(), made()
    for observation in (0, 0, 0, 1, 0, 0, 1):
        one.update(observation)
    other.leg(3)
    other.leg(2)
    assert np.array_equal(one.poses, other.poses)
    other.leg(2)
    assert not np.array_equal(one.poses, other.poses)


def test_turns_are_wrong_by_as_much_as_the_bounds_say() -> None:
    particles = BounceMonteCarlo(HALL, ANGLE, STEP, RADIUS, SOME, particles=4_000, seed=2)
    particles.poses = np.tile([3.0, 1.0, 0.0], (4_000, 1))
    steps = int(particles.rays.distances(particles.poses)[0] / float(STEP))
    assert particles.leg(steps)
    turned = np.degrees(particles.poses[:, 2]) - 100.0
    assert np.abs(turned).max() == pytest.approx(2.0)
    ends = np.isclose(np.abs(turned), 2.0)
    assert 0.45 < ends.mean() < 0.55
    assert np.abs(turned[~ends].mean()) < 0.2


def test_the_memory_is_that_of_the_arrays() -> None:
    particles = BounceMonteCarlo(HALL, ANGLE, STEP, RADIUS, particles=100)
    assert particles.memory_bytes == particles.poses.nbytes + 100 * 8 + particles.rays.walls.nbytes


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"step_m": Fraction(0)}, "step is 0 m"),
        ({"particles": 0}, "0 particles; give at least 1"),
        ({"miss_steps": -1.0}, "give 0 or more"),
        ({"roughening_rad": -1.0}, "give 0 or more"),
        ({"radius_m": Fraction(-1)}, "radius of the robot is -1 m"),
    ],
)
def test_what_cannot_be_meant_is_refused(options: dict[str, object], message: str) -> None:
    with pytest.raises(ConfigError, match=message):
        BounceMonteCarlo(**{"environment": HALL, "bounce_deg": ANGLE, "step_m": STEP} | options)  # type: ignore[arg-type]


def test_a_robot_that_does_not_fit() -> None:
    with pytest.raises(MapError, match="hardly fits"):
        BounceMonteCarlo(HALL, ANGLE, STEP, Fraction(5), particles=10)
