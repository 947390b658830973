"""Simulated robots with real geometry, and what a filter says about them: right, wrong, rejected, or not localized."""

import random
from collections import Counter
from collections.abc import Iterable, Iterator
from fractions import Fraction
from itertools import islice

import numpy as np

from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.filters.bounce_filter import BounceFilter, Place
from ial.bouncing.filters.building import free_cells
from ial.bouncing.filters.robust_filter import RobustFilter
from ial.bouncing.rays.real_robot import RealPose, RealRobot
from ial.maps.polygons.environment import Environment
from ial.maps.polygons.outline import outlines
from ial.maps.polygons.raster import Raster
from tests.bouncing.worlds import drawn

NONE = ExecutionBounds()
OUTCOMES = ("right", "wrong", "rejected", "not localized")
_FULL_DEG = 360


WORLDS = {
    name: Environment(outlines(drawn(picture), Fraction(1)))
    for name, picture in {
        "L": ".....#### .....#### .....#### ......... ......... ......... .........",
        "hall": ".....#### .....#### .....#### ..#...... ..#...... ......... .........",
        "corridors": "......## ######.# ..##...# ..##.### ..##.### ........ #.##.### ........",
        "pillars": ".......#### .......#### ......#.... ......#.... ........... ..##....#.. ........... ...........",
    }.items()
}
"""Rooms on a lattice of 1 m, with reflex corners, pillars, and corridors as wide as a cell."""

ARMS = Environment(outlines(drawn("#########. #########. .........."), Fraction(1)))
"""A long corridor and a short one, 1 m wide, where a disk that nearly fills them has few ways to go."""


def start_at_centre(made: BounceFilter, raster: Raster, chooser: random.Random) -> tuple[Fraction, Fraction, Fraction]:
    """Draw a pose at the centre of a free cell, in a heading of a filter."""
    rows, columns = np.nonzero(raster.free)
    at, headings = chooser.randrange(len(rows)), made.setting.headings.count
    return *made.setting.centre(0, int(rows[at]), int(columns[at])), Fraction(chooser.randrange(headings), headings)


def robots(
    environment: Environment, made: BounceFilter, count: int, bounds: ExecutionBounds = NONE, anywhere: bool = False
) -> Iterator[RealRobot]:
    """Yield robots as a filter assumes them, but with real geometry: from centres of cells, or from anywhere."""
    setting, chooser = made.setting, random.Random(1)
    raster = free_cells(environment, setting.cell, setting.radius)
    for seed in range(count):
        start = None if anywhere else start_at_centre(made, raster, chooser)
        angle, step = setting.headings.bounce_deg, setting.headings.step * setting.cell
        yield RealRobot(environment, angle, step, setting.radius, bounds, seed, start)


def holds(made: BounceFilter | RobustFilter, place: Place, pose: RealPose) -> bool:
    """Whether a place holds a pose: its cell, and headings up to half the distance between two."""
    half = made.setting.cell / 2
    apart = Fraction(_FULL_DEG, 2 * made.setting.headings.count)
    turned = ((degrees - _FULL_DEG * pose.turn) % _FULL_DEG for degrees in place.headings_deg)
    near = any(min(each, _FULL_DEG - each) <= apart for each in turned)
    return abs(place.x_m - pose.x_m) <= half and abs(place.y_m - pose.y_m) <= half and near


def judge(made: BounceFilter, robot: RealRobot, steps: int = 300) -> str:
    """What became of a robot: wrong if it was once said to be where it was not, else rejected, else right if it is localized in the end."""
    state, outcome = 0, "not localized"
    for pose in islice(robot.run(), steps):
        state = made.table.step(state, pose.observation)
        if state == made.table.trap:
            return "rejected"
        if made.table.is_localized(state):
            if not any(holds(made, place, pose) for place in made.where(state)):
                return "wrong"
            outcome = "right"
    return outcome


def judged(made: BounceFilter, runs: Iterable[RealRobot], steps: int = 300) -> Counter[str]:
    """How many robots came to what."""
    return Counter(judge(made, robot, steps) for robot in runs)
