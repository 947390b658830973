"""Robots with real geometry in random environments, and whether sets of pieces of walls hold them: exact, with no code of the filter."""

import random
from fractions import Fraction
from math import ceil, floor

import numpy as np

from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.rays.piece_map import PieceMap
from ial.bouncing.rays.piece_model import PieceModel
from ial.bouncing.rays.real_robot import RealRobot
from ial.maps.polygons.environment import Environment
from tests.bouncing.truth import Run, random_environment

ON_WALL = Fraction(1, 10**30)
NONE, SOME = ExecutionBounds(), ExecutionBounds(Fraction(2), Fraction(1, 50), 1)


def left_from(made: PieceMap, environment: Environment, x: Fraction, y: Fraction, turn: Fraction) -> set[int]:
    """The pieces of a robot that begins a leg at a wall, exactly; several on a line between two."""
    rings = [ring for polygon in environment.polygons for ring in polygon.rings]
    walls = [(ring[at], ring[(at + 1) % len(ring)]) for ring in rings for at in range(len(ring))]
    first = (np.cumsum(made.parts) - made.parts).tolist()
    heading = turn * made.headings
    pieces = set()
    for (a, b), parts, base in zip(walls, made.parts.tolist(), first, strict=True):
        ex, ey, px, py = b[0] - a[0], b[1] - a[1], x - a[0], y - a[1]
        along = min(max((px * ex + py * ey) / (ex * ex + ey * ey), Fraction(0)), Fraction(1))
        if (px - along * ex) ** 2 + (py - along * ey) ** 2 > ON_WALL**2:
            continue
        near = along * parts
        for part in {max(ceil(near - ON_WALL) - 1, 0), min(floor(near + ON_WALL), parts - 1)}:
            for interval in {ceil(heading) - 1, floor(heading)}:
                pieces.add(interval % made.headings * int(made.parts.sum()) + base + part)
    return pieces


def follow(seed: int, legs: int = 12) -> Run:
    """Let a robot run through a random environment, and count at how many bumps the set of pieces does not hold it.

    Every third robot starts on a lattice in a heading that is a multiple of 45°, so that it meets corners exactly and slides along walls.
    """
    chooser = random.Random(seed)
    environment = random_environment(seed)
    lattice = seed % 3 == 0
    angle = Fraction(chooser.choice([45, 90, 135, 180])) if lattice else Fraction(chooser.randint(100, 35_900), 100)
    step, bounds = chooser.choice([Fraction(1, 4), Fraction(1, 3), Fraction(1)]), chooser.choice([NONE, SOME])
    made = PieceMap.of(environment, angle, step, bounds, chooser.choice([Fraction(1, 2), Fraction(2, 3)]), chooser.choice([32, 40, 72]))
    start = None
    if lattice:
        corner, after = environment.polygons[0].outer[:2]
        start = (corner[0] + (after[0] - corner[0]) / 2, corner[1], Fraction(chooser.randrange(8), 8))
    robot, model = RealRobot(environment, angle, step, Fraction(0), bounds, seed, start), PieceModel(made)
    states, result = model.universe(), Run(legs)
    for _ in range(legs):
        for pose in robot.leg():
            states = model.step(states, None, pose.observation)
        result.losses += not left_from(made, environment, *robot.pose) & set(states.pieces.tolist())
        result.pieces = max(result.pieces, len(states))
    result.left = len(states) / len(made)
    return result
