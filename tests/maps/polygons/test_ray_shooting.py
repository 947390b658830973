"""Beams against single rays in 60 digits: rays at random, and rays that pass corners as near as doubles can aim."""

from collections.abc import Iterator
from fractions import Fraction
from random import Random

import mpmath
import numpy as np
import pytest

from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.rays.real_robot import RealRobot
from ial.maps.polygons.environment import Environment
from ial.maps.polygons.polygon import Polygon
from ial.maps.polygons.ray_shooting import reaches, shoot, sort_out
from ial.maps.polygons.walls import Walls
from tests.bouncing.disk_truth import contacts, disk_in
from tests.bouncing.exact_rays import DIGITS, ExactWalls, exact
from tests.bouncing.truth import random_environment, star

WORLDS = range(30)
WIDE = 1e-9


def environment(seed: int) -> Environment:
    """Return an environment of ordinary walls, or every third time of walls that are short for its size."""
    if seed % 3:
        return random_environment(7 * seed)
    room = tuple((Fraction(x, 3), Fraction(y, 3)) for x, y in ((0, 0), (31, 1), (30, 29), (-1, 30)))
    small = star(Random(seed), 9, 0.0, 0.0, 1.0, 6.0)
    return Environment((Polygon(room, (tuple((9 + x / 7000, 9 + y / 7000) for x, y in small),)),))


def aimed(walls: ExactWalls, random: np.random.Generator, wall: int, part: float) -> float:
    """Return a heading at random, or the double nearest to the direction of a corner, or one beside it; of any turn.

    Or the direction of a point of the next wall or the one before: from very near their corner, such a ray is almost parallel to the wall.
    """
    kind = random.integers(3)
    if kind == 0:
        return float(random.uniform(-7.0, 7.0))
    target = random.integers(len(walls.starts))
    if kind == 1:
        corner = walls.starts[wall] if part < 0.5 else walls.ends[wall]
        target = (walls.ends if part < 0.5 else walls.starts).index(corner)
    with mpmath.workdps(DIGITS):
        (x, y), (cx, cy) = walls.point(wall, part), walls.point(target, float(random.random() if kind == 1 else 0.0))
        heading = float(mpmath.atan2(cy - y, cx - x) + 2 * mpmath.pi * int(random.integers(-1, 2)))
    for _ in range(random.integers(3)):
        heading = float(np.nextafter(heading, random.choice([-9.0, 9.0])))
    return heading


def single_rays(seed: int, count: int) -> Iterator[tuple[int, float, float, tuple[int, mpmath.mpf, mpmath.mpf]]]:
    """Yield the wall, the part and the heading of starts, and what they hit."""
    walls, random = ExactWalls.of(environment(seed)), np.random.default_rng(seed)
    for _ in range(count):
        wall, part = (
            int(random.integers(len(walls.starts))),
            float(random.choice([random.random(), 2.0**-45, 1.0 - 2.0**-45, 0.001, 0.999])),
        )
        heading = aimed(walls, random, wall, part)
        hit = walls.first_hit(wall, part, exact(heading))
        if hit is not None:
            yield wall, part, heading, hit


def shot(
    walls: Walls, wall: int, lower: tuple[float, float], upper: tuple[float, float], near: float, far: float
) -> list[tuple[int, float, float]]:
    """Return the walls that one beam hits, with bounds of the part of each."""
    table, links = walls.table
    room = len(walls) + 1
    rows, hits, low, high = np.empty(room, np.int64), np.empty(room, np.int32), np.empty((room, 2)), np.empty((room, 2))
    bounds = (np.array([wall], np.int32), np.array([lower]), np.array([upper]), np.array([near]), np.array([far]))
    _, count = shoot(0, *bounds, table, links, walls.margin, rows, hits, low, high)
    return list(zip(hits[:count].tolist(), low[:count, 0].tolist(), high[:count, 0].tolist(), strict=True))


def reach(walls: Walls, wall: int, lower: tuple[float, float], upper: tuple[float, float], back: bool = False) -> float:
    table, links = walls.table
    beam = (np.array([wall], np.int32), np.array([lower]), np.array([upper]), np.array([back]))
    return float(reaches(*beam, table, links, walls.margin)[0])


def holds(hits: list[tuple[int, float, float]], wall: int, part: mpmath.mpf) -> bool:
    return any(at == wall and low <= part <= high for at, low, high in hits)


@pytest.mark.parametrize("seed", WORLDS)
def test_what_one_ray_hits_is_found_and_bounded_closely(seed: int) -> None:
    walls = Walls.of(environment(seed))
    tried = sharp = 0
    for wall, part, heading, (hit, there, way) in single_rays(seed, 80):
        start = (part, heading)
        hits = shot(walls, wall, start, start, 0.0, np.inf)
        assert holds(hits, hit, there)
        assert reach(walls, wall, start, start) >= way
        near, far = (float(np.nextafter(float(way), side)) for side in (0.0, np.inf))
        assert holds(shot(walls, wall, start, start, near, far), hit, there), "the distance is known to a bit"
        sharp += hit not in [at for at, _, _ in shot(walls, wall, start, start, float(way) + 1e-6, np.inf)]
        tried += 1
    assert tried > 20
    assert sharp > 0.5 * tried  # the others pass a corner, or the wall at so small an angle that nothing is sure


@pytest.mark.parametrize("seed", WORLDS)
def test_what_one_ray_hits_is_in_what_its_beam_hits(seed: int) -> None:
    walls, random = Walls.of(environment(seed)), np.random.default_rng(seed)
    for wall, part, heading, (hit, there, way) in single_rays(seed, 40):
        wide, turned = random.choice([0.0, 1e-12, 1e-3, 0.1], 2)
        left, behind = random.choice([0.0, 0.3, 1.0], 2)
        lower = (max(0.0, part - left * wide), heading - behind * turned)
        upper = (min(1.0, part + (1.0 - left) * wide), heading + (1.0 - behind) * turned)
        near, far = (float(np.nextafter(float(way), side)) for side in (0.0, np.inf))
        assert holds(shot(walls, wall, lower, upper, near, far), hit, there)
        assert reach(walls, wall, lower, upper) >= way


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(10))
def test_a_wall_that_stops_some_rays_of_a_beam_does_not_stop_the_others(seed: int) -> None:
    """From one arm of a corner to the other and beyond its end: the walls behind the start close the chain of walls, and stop no ray."""
    random = np.random.default_rng(seed)
    room, corner = (
        tuple((Fraction(x), Fraction(y)) for x, y in ring)
        for ring in (((0, 0), (20, 0), (20, 20), (0, 20)), ((5, 5), (9, 5), (9, 6), (6, 6), (6, 9), (5, 9)))
    )
    there = Environment((Polygon(room, (corner,)),))
    walls, exactly = Walls.of(there), ExactWalls.of(there)
    for wall in range(4, 10):
        along = float(exactly.angle(wall))
        for _ in range(30):
            lower = (random.uniform(0.0, 0.9), along + random.uniform(0.05, 2.9))
            upper = (random.uniform(lower[0], 1.0), min(along + 3.1, lower[1] + random.uniform(0.0, 1.0)))
            far = reach(walls, wall, lower, upper)
            for _ in range(6):
                hit = exactly.first_hit(wall, float(random.uniform(lower[0], upper[0])), exact(float(random.uniform(lower[1], upper[1]))))
                assert hit is None or hit[2] <= far


@pytest.mark.parametrize("seed", WORLDS)
def test_a_robot_that_arrives_may_have_come_from_as_far_as_its_ray_is_free(seed: int) -> None:
    walls, exactly = Walls.of(environment(seed)), ExactWalls.of(environment(seed))
    tried = 0
    for wall, part, heading, _ in single_rays(seed, 40):
        arriving = heading - np.pi
        with mpmath.workdps(DIGITS):
            came = exactly.first_hit(wall, part, exact(arriving) + mpmath.pi)
        if came is not None:
            assert reach(walls, wall, (part, arriving), (part, arriving), back=True) >= came[2]
            tried += 1
    assert tried > 10


@pytest.mark.parametrize("seed", WORLDS)
def test_headings_along_a_wall_lead_away_from_it_and_into_it(seed: int) -> None:
    """No heading is in neither part: not the exact direction of the wall, of any turn, forwards or backwards."""
    made, exactly = Walls.of(environment(seed)), ExactWalls.of(environment(seed))
    for wall in range(len(made)):
        for turns in (-2, -1, 0, 1, 2):
            with mpmath.workdps(DIGITS):
                along = exactly.angle(wall) + 2 * mpmath.pi * turns
                back = along + mpmath.pi
            for heading, wide in ((along, 1e-14), (along, 0.1), (back, 1e-14), (back, 0.1), (along, 0.5)):
                low, high = float(heading) - wide, float(heading) + wide
                free_low, free_high, against_low, against_high = sort_out(wall, low, high, made.table[0])
                assert free_low <= heading <= free_high
                assert against_low <= heading <= against_high
            away, into = (sort_out(wall, float(along + middle) - 0.1, float(along + middle) + 0.1, made.table[0]) for middle in (0.5, -0.5))
            assert away[0] <= away[1]
            assert away[2] > away[3], "none leads into the wall"
            assert into[0] > into[1], "all lead into the wall"
            assert into[2] <= into[3]


def grazing(there: Environment, radius: Fraction, robot: RealRobot, chooser: Random) -> Fraction:
    """A heading, as a part of a full turn, in which a disk nearly misses a corner, or just does."""
    x, y, _ = map(float, robot.pose)
    corner = chooser.choice([corner for polygon in there.polygons for ring in polygon.rings for corner in ring])
    away = np.hypot(float(corner[0]) - x, float(corner[1]) - y)
    beside = np.arcsin(min(float(radius) / max(away, 1e-6), 1.0)) * chooser.choice([-1, 1]) * (1.0 - 10.0 ** chooser.uniform(-6.0, -0.5))
    return Fraction((np.arctan2(float(corner[1]) - y, float(corner[0]) - x) + beside) / (2.0 * np.pi))


@pytest.mark.slow
def test_what_a_disk_bumps_into_is_found_and_bounded_closely() -> None:
    """From places where a disk has bumped, often past corners: what it bumps into next, by a simulation that knows of no edges."""
    tried = on_arcs = sharp = 0
    for seed in range(40):
        chooser = Random(seed)
        there, robot, radius = disk_in(seed, chooser, Fraction(chooser.randint(1, 35_999), 100), Fraction(1), ExecutionBounds())
        walls = Walls.of(there, radius)
        list(robot.leg())
        for _ in range(40):
            x, y, turn = robot.pose
            if chooser.random() < 0.7:
                turn = grazing(there, radius, robot, chooser)
                robot = RealRobot(there, 360 * robot.bounce, Fraction(1), radius, start=(x, y, turn))
            begins, heading = contacts(walls, x, y), 2.0 * np.pi * float(turn)
            list(robot.leg())
            ends, way = contacts(walls, *robot.pose[:2]), float(np.hypot(float(robot.pose[0] - x), float(robot.pose[1] - y)))
            assert begins
            if len(begins) > 1:
                continue  # in a corner, or at the end of an arc
            ((wall, part),) = begins
            beam = (wall, (max(part - WIDE, 0.0), heading - WIDE), (min(part + WIDE, 1.0), heading + WIDE))
            assert reach(walls, *beam) >= way - WIDE
            hits = shot(walls, *beam, max(way - WIDE, 0.0), way + WIDE)
            assert any(at == end and low - WIDE <= there <= high + WIDE for end, there in ends for at, low, high in hits)
            tried += 1
            on_arcs += any(walls.bulge[at] > 0.0 for at, _ in ends)
            sharp += len({at for at, _, _ in shot(walls, *beam, 0.0, np.inf)}) <= 3
    assert tried > 800
    assert on_arcs > 200
    assert sharp > 0.8 * tried
