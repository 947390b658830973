from fractions import Fraction

import numpy as np
import pytest

from ial.bouncing.rays.real_robot import RealRobot
from ial.errors import ConfigError, IalError
from ial.maps.polygons.environment import Environment
from ial.particles.disk_rays import DiskRays
from tests.bouncing.judged_runs import WORLDS
from tests.bouncing.truth import random_environment

NEAR = 1e-5  # what only just touches is grazed here, and exact there


def driven(environment: Environment, radius: Fraction, seed: int) -> tuple[list[float], list[float]]:
    """The poses at the starts of legs of an exact robot, and how far it drove from each."""
    robot = RealRobot(environment, Fraction(137), Fraction(100), radius, seed=seed)
    poses, ways = [], []
    for _ in range(15):
        x, y, turn = robot.pose
        list(robot.leg())
        poses.append((float(x), float(y), 2.0 * np.pi * float(turn)))
        ways.append(float(np.hypot(float(robot.pose[0] - x), float(robot.pose[1] - y))))
    return poses, ways


@pytest.mark.parametrize("radius", ["0", "1/5", "2/5"])
def test_a_disk_drives_as_far_as_an_exact_one(radius: str) -> None:
    compared = 0
    for seed, environment in enumerate([*WORLDS.values(), *map(random_environment, range(1, 30))]):
        try:
            poses, ways = driven(environment, Fraction(radius), seed)
        except IalError:  # it fits nowhere
            continue
        rays = DiskRays(environment, Fraction(radius))
        assert np.abs(rays.distances(np.array(poses)) - ways).max() < NEAR
        assert rays.are_free(np.array(poses)[:1, :2]).all()
        compared += len(ways)
    assert compared > 200


def test_a_disk_as_wide_as_a_cell_slides_along_walls() -> None:
    rays = DiskRays(WORLDS["L"], Fraction(1, 2))
    x0, y0 = map(float, WORLDS["L"].bounds[:2])
    along = np.array([[x0 + 0.5, y0 + 0.5, 0.0], [x0 + 0.5, y0 + 0.5, np.pi / 2], [x0 + 8.5, y0 + 0.5, 0.0]])
    assert rays.distances(along) == pytest.approx([8.0, 6.0, 0.0], abs=NEAR)


def test_a_place_is_free_where_the_disk_keeps_its_radius_from_every_wall() -> None:
    environment = WORLDS["hall"]
    places = np.random.default_rng(1).uniform(-1.0, 10.0, (500, 2))
    free = DiskRays(environment, Fraction(2, 5)).are_free(places)
    for (x, y), told in zip(places.tolist(), free.tolist(), strict=True):
        try:
            RealRobot(environment, Fraction(90), Fraction(1), Fraction(2, 5), start=(Fraction(x), Fraction(y), Fraction(0)))
            exact = True
        except ConfigError:
            exact = False
        assert told == exact
    assert 50 < free.sum() < 450


def test_a_negative_radius_is_refused() -> None:
    with pytest.raises(ConfigError, match="radius of the robot is -1 m"):
        DiskRays(WORLDS["L"], Fraction(-1))
