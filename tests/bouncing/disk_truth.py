"""Disks with real geometry in random environments, and whether the sets of the filters hold them, with no code of the filters."""

import random
from fractions import Fraction
from math import ceil, floor

import numpy as np

from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.filters.goal import Goal
from ial.bouncing.filters.piece_filter import PieceFilter
from ial.bouncing.rays.piece_map import PieceMap
from ial.bouncing.rays.piece_model import PieceModel
from ial.bouncing.rays.ray_grid import least_pieces
from ial.bouncing.rays.ray_model import RayModel
from ial.bouncing.rays.ray_set import RaySet
from ial.bouncing.rays.real_robot import RealRobot
from ial.errors import MapError
from ial.maps.polygons.environment import Environment
from ial.maps.polygons.walls import Walls
from tests.bouncing.judged_runs import WORLDS
from tests.bouncing.truth import Run, extent, holds_place, random_environment

NEAR = 1e-10
"""Edges of disks are no exact numbers: so far from an edge a robot may be that stands on it, in metres or parts of the edge."""

NONE, SOME = ExecutionBounds(), ExecutionBounds(Fraction(2), Fraction(1, 50), 1)


def contacts(walls: Walls, x_m: Fraction, y_m: Fraction) -> list[tuple[int, float]]:
    """The edges over which the centre of a disk is, no farther than they bulge, and on which part of each its foot is."""
    x, y = (float(place - origin) for place, origin in zip((x_m, y_m), walls.origin, strict=True))
    dx, dy = walls.x[walls.after] - walls.x, walls.y[walls.after] - walls.y
    length = np.hypot(dx, dy)
    part = ((x - walls.x) * dx + (y - walls.y) * dy) / length**2
    height = ((y - walls.y) * dx - (x - walls.x) * dy) / length
    over = (part >= -NEAR) & (part <= 1.0 + NEAR) & (height >= -NEAR) & (height <= walls.bulge + NEAR) & walls.stopping
    return [(int(at), float(part[at])) for at in np.flatnonzero(over)]


def disk_in(
    seed: int, chooser: random.Random, angle: Fraction, step: Fraction, bounds: ExecutionBounds
) -> tuple[Environment, RealRobot, Fraction]:
    """A disk that fits into a random environment; on a lattice, it often touches several things at once."""
    environment = random_environment(seed)
    while True:
        radius = chooser.choice([Fraction(1, 2), Fraction(1, 3), Fraction(1, 5), Fraction(1, 10), Fraction(chooser.randint(1, 600), 1000)])
        try:
            return (
                environment,
                RealRobot(environment, angle, step, radius, bounds, seed, _start(chooser, environment, radius, seed)),
                radius,
            )
        except MapError:
            continue


def _start(chooser: random.Random, environment: Environment, radius: Fraction, seed: int) -> tuple[Fraction, Fraction, Fraction] | None:
    """Every third time a place beside the first wall, in a heading that is a multiple of 45°, if the disk fits there."""
    heading = Fraction(chooser.randrange(8), 8)
    if seed % 3:
        return None
    (ax, ay), (bx, _) = environment.polygons[0].outer[:2]
    trial = (ax + (bx - ax) / 2, ay + radius, heading)
    try:
        RealRobot(environment, Fraction(90), Fraction(1), radius, start=trial)
    except Exception:
        return None
    return trial


def pieces_of(made: PieceMap, x_m: Fraction, y_m: Fraction, turn: Fraction) -> set[int]:
    """The pieces of a disk that begins a leg; several on a line between two."""
    heading, first, pieces = turn * made.headings, np.cumsum(made.parts) - made.parts, set()
    for wall, part in contacts(made.walls, x_m, y_m):
        parts = int(made.parts[wall])
        for each in {max(ceil(part * parts - NEAR) - 1, 0), min(floor(part * parts + NEAR), parts - 1)}:
            for interval in {ceil(heading) - 1, floor(heading)}:
                pieces.add(interval % made.headings * int(made.parts.sum()) + int(first[wall]) + each)
    return pieces


def follow_pieces(seed: int, legs: int = 12) -> Run:
    """Let a disk run, and count at how many bumps the set of pieces does not hold it."""
    chooser = random.Random(seed)
    lattice = seed % 3 == 0
    angle = Fraction(chooser.choice([45, 90, 135, 180])) if lattice else Fraction(chooser.randint(100, 35_900), 100)
    step, bounds = chooser.choice([Fraction(1, 4), Fraction(1, 3), Fraction(1)]), chooser.choice([NONE, SOME])
    environment, robot, radius = disk_in(seed, chooser, angle, step, bounds)
    part, headings = chooser.choice([Fraction(1, 2), Fraction(2, 3)]), chooser.choice([32, 40, 72])
    made = PieceMap.of(environment, angle, step, bounds, part, headings, radius)
    model = PieceModel(made)
    states, result = model.universe(), Run(legs)
    for _ in range(legs):
        for pose in robot.leg():
            states = model.step(states, None, pose.observation)
        result.losses += not pieces_of(made, *robot.pose) & set(states.pieces.tolist())
        result.pieces = max(result.pieces, len(states))
    result.left = len(states) / len(made)
    return result


def holds(states: RaySet, walls: Walls, x_m: Fraction, y_m: Fraction, turn: Fraction, arriving: bool = False) -> bool:
    """Whether a disk that begins a leg, or ends its first one, is in the set."""
    angle = 2.0 * np.pi * float(turn)
    turns = np.round((0.5 * (states.lower[:, 1] + states.upper[:, 1]) - angle) / (2.0 * np.pi)) * 2.0 * np.pi
    facing = (states.lower[:, 1] <= angle + turns + NEAR) & (angle + turns - NEAR <= states.upper[:, 1]) & (states.arriving == arriving)
    for wall, part in contacts(walls, x_m, y_m):
        there = (states.walls == wall) & (states.lower[:, 0] - NEAR <= part) & (part <= states.upper[:, 0] + NEAR)
        if (facing & there).any():
            return True
    return False


def follow(seed: int, legs: int = 6) -> Run:
    """Let a disk run, and count at how many bumps, or at a step of each leg, the set of the ray mode does not hold it."""
    chooser = random.Random(seed)
    lattice = seed % 12 == 0
    angle = Fraction(chooser.choice([45, 90, 135, 180])) if lattice else Fraction(chooser.randint(1, 35_999), 100)
    step, bounds = chooser.choice([Fraction(1, 10), Fraction(1, 3), Fraction(1), Fraction(5, 2)]), chooser.choice([NONE, SOME])
    environment, robot, radius = disk_in(seed, chooser, angle, step, bounds)
    region, headings = None, ()
    if chooser.random() < 0.3:
        x, y, turn = robot.pose
        region = (x - Fraction(1, 5), y - Fraction(2), x + Fraction(1), y)
        headings = ((360 * turn - 100, 360 * turn), (360 * turn + 10, 360 * turn + 50))
    most = chooser.choice([1, 1, 2]) * least_pieces(Walls.of(environment, radius))
    model = RayModel(environment, angle, step, bounds, most, headings, region, radius)
    states, result, arriving = model.universe(), Run(legs), True
    everything = extent(model, states)
    for _ in range(legs):
        turned = robot.pose[2]
        poses = list(robot.leg())
        here = poses[-1].x_m, poses[-1].y_m
        if arriving:
            result.losses += not holds(states, model.walls, *here, turned, arriving)
        asked = chooser.randrange(max(len(poses) - 1, 1))
        for at, pose in enumerate(poses[:-1]):
            states = model.step(states, None, pose.observation)
            if not arriving and at == asked:
                result.losses += not holds_place(model, states, pose.x_m, pose.y_m, pose.turn)
        states = model.step(states, None, 1)
        result.losses += not holds(states, model.walls, *here, robot.pose[2])
        arriving = False
        result.pieces = max(result.pieces, len(states))
    result.left = extent(model, states) / everything
    return result


TEN_WORLDS = {**WORLDS, **{f"polygon {seed}": random_environment(seed) for seed in (1, 4, 7, 10, 13, 16)}}
"""Rooms on a lattice of 1 m, and polygons with holes, in which walls lead in all directions."""


def filter_of(name: str, radius: Fraction, bounds: ExecutionBounds = SOME) -> PieceFilter:
    """The filter of a disk that is localized where the place of its last bump is known to 2 m."""
    robot = Fraction(100), Fraction(1, 4), bounds
    made = PieceMap.of(TEN_WORLDS[name], *robot, Fraction(1, 4), 72, radius)
    return PieceFilter(made, name, *robot, Goal(width=Fraction(2)), radius)


def judge(made: PieceFilter, seed: int, legs: int = 30) -> str:
    """What became of a disk with errors: lost if outside of its set, wrong if told to be elsewhere, localized if it once was."""
    robot = RealRobot(TEN_WORLDS[made.name], made.bounce_deg, made.step_m, made.radius_m, made.bounds, seed)
    model = PieceModel(made.map)
    states, localized = model.universe(), False
    for _ in range(legs):
        states = model.leg(states, len(list(robot.leg())) - 1)
        x, y, turn = robot.pose
        if not pieces_of(made.map, x, y, turn) & set(states.pieces.tolist()):
            return "lost"
        told = made.is_localized(states)
        localized |= told
        x0, y0, x1, y1 = map(Fraction, made.box(states) or (1, 1, 0, 0))
        if told and not (x0 <= x <= x1 and y0 <= y <= y1):
            return "wrong"
    return "localized" if localized else "not localized"
