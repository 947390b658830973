"""Robots with real geometry in random environments, and whether the sets of the ray mode hold them: exact, with no code of the filter."""

import math
import random
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.rays.ray_grid import least_pieces
from ial.bouncing.rays.ray_model import RayModel
from ial.bouncing.rays.ray_set import RaySet
from ial.bouncing.rays.real_robot import RealRobot
from ial.errors import MapError
from ial.maps.polygons.environment import Environment
from ial.maps.polygons.outline import outlines
from ial.maps.polygons.polygon import ExactRing, Polygon
from ial.maps.polygons.walls import Walls

_PI_DIGITS = 31415926535897932384626433832795028841971
_PI = Fraction(_PI_DIGITS, 10**40), Fraction(_PI_DIGITS + 1, 10**40)
_ON_WALL = Fraction(1, 10**30)  # metres: a simulated robot stands nearer to its wall than that
_NEAR = 1e-6


def holds_leg(environment: Environment, states: RaySet, x_m: Fraction, y_m: Fraction, turn: Fraction, arriving: bool = False) -> bool:
    """Return whether a robot that begins a leg at a wall is in the set.

    Parameters
    ----------
    environment
        The environment whose walls the set is about.
    states
        The set.
    x_m, y_m, turn
        Where the robot stands, in metres, and its heading as a part of a full turn, from 0 to 1.
    arriving
        Whether to look among robots that have not bumped yet, and bump at that place, in that heading.
    """
    rings = [ring for polygon in environment.polygons for ring in polygon.rings]
    corners = [(ring[at], ring[(at + 1) % len(ring)]) for ring in rings for at in range(len(ring))]
    angle = 2.0 * np.pi * float(turn)
    turns = np.round((0.5 * (states.lower[:, 1] + states.upper[:, 1]) - angle) / (2.0 * np.pi))
    near = (states.lower[:, 1] <= angle + turns * 2.0 * np.pi + _NEAR) & (angle + turns * 2.0 * np.pi - _NEAR <= states.upper[:, 1])
    for wall, ((ax, ay), (bx, by)) in enumerate(corners):
        ex, ey, px, py = bx - ax, by - ay, x_m - ax, y_m - ay
        square = ex * ex + ey * ey
        part = min(max((px * ex + py * ey) / square, Fraction(0)), Fraction(1))
        if (px - part * ex) ** 2 + (py - part * ey) ** 2 > _ON_WALL**2:
            continue
        for at in np.flatnonzero(near & (states.walls == wall) & (states.arriving == arriving)):
            low, high = sorted(2 * pi * (turn + int(turns[at])) for pi in _PI)
            first, last = map(Fraction, (states.lower[at, 0], states.upper[at, 0]))
            if first <= part <= last and Fraction(states.lower[at, 1]) <= low and high <= Fraction(states.upper[at, 1]):
                return True
    return False


def star(chooser: random.Random, corners: int, x: float, y: float, least: float, most: float) -> ExactRing:
    """A ring around a point, with corners at random distances."""
    begin = chooser.random()
    angles = [2.0 * math.pi * (begin + (at + 0.8 * chooser.random()) / corners) for at in range(corners)]
    sizes = [chooser.uniform(least, most) for _ in angles]
    return tuple(
        (Fraction(round(1000 * (x + size * math.cos(angle))), 1000), Fraction(round(1000 * (y + size * math.sin(angle))), 1000))
        for angle, size in zip(angles, sizes, strict=True)
    )


def random_environment(seed: int) -> Environment:
    """A star with holes, or the free cells of a small grid, whose holes and corners may touch."""
    chooser = random.Random(seed)
    if seed % 3 == 0:
        free = np.random.default_rng(seed).random((chooser.randint(2, 5), chooser.randint(2, 5))) > 0.3
        free[0, 0] = True
        width = chooser.choice([Fraction(1), Fraction(1, 3), Fraction(7, 10)])
        return Environment(outlines(free, width))
    while True:
        outer = star(chooser, chooser.randint(3, 12), 0.0, 0.0, chooser.choice([2.0, 3.5]), 6.0)
        holes = []
        for at in range(chooser.randint(0, 3)):
            angle = 2.0 * math.pi * (at + 0.5 * chooser.random()) / 3.0
            holes.append(star(chooser, chooser.randint(3, 5), 1.3 * math.cos(angle), 1.3 * math.sin(angle), 0.1, 0.7))
        try:
            return Environment((Polygon(outer, tuple(holes)),))
        except MapError:  # a hole sticks out, or crosses another one: draw again
            continue


@dataclass
class Run:
    """What became of one robot."""

    legs: int = 0
    losses: int = 0
    pieces: int = 0
    left: float = 1.0


def follow(seed: int, legs: int = 6) -> Run:
    """Let a robot run through a random environment, and count at how many bumps, or at a step of each leg, its set does not hold it.

    Angles, steps, bounds of errors, bounds of sizes and regions at the start vary with the seed. Every fourth robot starts at a corner of a
    lattice in a heading that is a multiple of 45°, so that it meets corners exactly and slides along walls.
    """
    chooser = random.Random(seed)
    environment = random_environment(seed)
    lattice = seed % 12 == 0
    angle = Fraction(chooser.choice([45, 90, 135, 180])) if lattice else Fraction(chooser.randint(1, 35_999), 100)
    step = chooser.choice([Fraction(1, 10), Fraction(1, 3), Fraction(1), Fraction(5, 2)])
    bounds = (
        ExecutionBounds()
        if seed % 2 == 0
        else ExecutionBounds(
            Fraction(chooser.choice([0, 1, 3]), chooser.choice([1, 10])),
            Fraction(chooser.choice([0, 1, 5]), 100),
            chooser.choice([0, 0, 1, 2]),
        )
    )
    start = None
    if lattice:
        middle = environment.polygons[0].outer[0]
        cell = environment.polygons[0].outer[1][0] - middle[0]
        start = (middle[0] + cell / 2, middle[1], Fraction(chooser.randrange(8), 8))
    robot = RealRobot(environment, angle, step, Fraction(0), bounds, seed, start)
    region, headings = None, ()
    if chooser.random() < 0.3:
        x, y, turn = robot.pose
        region = (x - Fraction(1, 5), y - Fraction(2), x + Fraction(1), y)
        headings = ((360 * turn - 100, 360 * turn), (360 * turn + 10, 360 * turn + 50))
    least = least_pieces(Walls.of(environment))
    model = RayModel(environment, angle, step, bounds, chooser.choice([least, least, 2 * least]), headings, region)
    states, result = model.universe(), Run(legs)
    everything = extent(model, states)
    arriving = True
    for _ in range(legs):
        turned = robot.pose[2]
        poses = list(robot.leg())
        here = poses[-1].x_m, poses[-1].y_m
        if arriving:
            result.losses += not holds_leg(environment, states, *here, turned, arriving)
        asked = chooser.randrange(max(len(poses) - 1, 1))
        for at, pose in enumerate(poses[:-1]):
            states = model.step(states, None, pose.observation)
            if not arriving and at == asked:
                result.losses += not holds_place(model, states, pose.x_m, pose.y_m, pose.turn)
        states = model.step(states, None, 1)
        result.losses += not holds_leg(environment, states, *here, robot.pose[2])
        arriving = False
        result.pieces = max(result.pieces, len(states))
    result.left = extent(model, states) / everything
    return result


def extent(model: RayModel, states: RaySet) -> float:
    """The area of a set, in metres of wall times radians."""
    widths = states.upper - states.lower
    return float((widths[:, 0] * model.walls.lengths[states.walls] * widths[:, 1]).sum())


def holds_place(model: RayModel, states: RaySet, x_m: Fraction, y_m: Fraction, turn: Fraction) -> bool:
    """Whether one of the boxes of the current places holds a pose."""
    boxes = model.places(states)
    angle = 2.0 * np.pi * float(turn)
    middle = np.array([float(x_m), float(y_m), angle])
    turns = np.round((0.5 * (boxes.lower[:, 2] + boxes.upper[:, 2]) - angle) / (2.0 * np.pi))
    moved = np.stack([np.zeros_like(turns), np.zeros_like(turns), 2.0 * np.pi * turns], axis=1) + middle
    near = (boxes.lower - _NEAR <= moved) & (moved <= boxes.upper + _NEAR)
    for at in np.flatnonzero(near.all(axis=1)):  # those that are decided exactly
        low, high = ([Fraction(value) for value in side[at]] for side in (boxes.lower, boxes.upper))
        first, last = sorted(2 * pi * (turn + int(turns[at])) for pi in _PI)
        if low[0] <= x_m <= high[0] and low[1] <= y_m <= high[1] and low[2] <= first and last <= high[2]:
            return True
    return False
