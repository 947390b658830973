"""Coarser sets against the exact points of the finer ones; headings are compared in 60 digits, modulo a turn."""

import mpmath
import numpy as np
import pytest

from ial.bouncing.rays.ray_grid import COARSEST, coarsened, least_pieces
from ial.bouncing.rays.ray_set import RaySet
from ial.maps.polygons.walls import Walls
from tests.bouncing.exact_rays import DIGITS, exact
from tests.bouncing.truth import random_environment

TURN = 2.0 * np.pi


def beside(values: np.ndarray, random: np.random.Generator) -> np.ndarray:
    """Return the numbers or doubles next to them."""
    return np.nextafter(values, values + random.choice([-1.0, 0.0, 1.0], values.shape))


def random_set(walls: Walls, random: np.random.Generator, count: int) -> RaySet:
    """Return pieces of which many begin or end on a line of some grid, or a bit beside it; headings of several turns."""
    level = random.integers(3, 12)
    lines = random.integers(-(2**level), 2 ** (level + 1), count) * (TURN / 2**level)
    heading = beside(np.where(random.random(count) < 0.7, lines, random.uniform(-20.0, 20.0, count)), random)
    part = beside(
        np.where(random.random(count) < 0.7, random.integers(0, 8, count) / random.choice([7, 8, 30]), random.random(count)), random
    )
    lower = np.stack([np.clip(part, 0.0, 1.0), heading], axis=1)
    wide = random.choice([0.0, 1e-16, 1e-3, 0.3, 1.0], (count, 2)) * random.choice([1.0, random.random()])
    upper = np.maximum(lower, lower + wide * [1.0, TURN])
    upper[:, 0] = np.minimum(upper[:, 0], 1.0)
    steps = random.integers(0, 2, count).astype(np.int32)
    numbers = random.integers(0, len(walls), count).astype(np.int32)
    return RaySet(numbers, lower, upper, steps, random.random(count) < 0.5, np.full(count, np.inf))


def holds(states: RaySet, wall: int, steps: int, arriving: bool, part: float, heading: float) -> bool:
    """Return whether a point is in a set; exactly, but for the search for candidates."""
    turns = np.round((heading - 0.5 * (states.lower[:, 1] + states.upper[:, 1])) / TURN)
    near = (states.walls == wall) & (states.steps == steps) & (states.arriving == arriving)
    near &= (states.lower[:, 0] <= part) & (part <= states.upper[:, 0])
    for at in np.flatnonzero(near):
        with mpmath.workdps(DIGITS):
            for turn in (turns[at] - 1, turns[at], turns[at] + 1):
                angle = exact(heading) - 2 * mpmath.pi * int(turn)
                if exact(states.lower[at, 1]) <= angle <= exact(states.upper[at, 1]):
                    return True
    return False


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(24))
def test_no_point_of_a_set_is_lost_where_it_is_made_coarser(seed: int) -> None:
    random = np.random.default_rng(seed)
    walls = Walls.of(random_environment(seed))
    least = 4 * least_pieces(walls)
    fine = random_set(walls, random, 400)
    coarse = coarsened(fine, walls, int(least * random.choice([1, 3])))
    assert len(coarse) <= 3 * least
    widest = coarse.upper - coarse.lower
    assert (widest[:, 1] <= 2.0 * TURN / 2**COARSEST).all()
    for at in range(0, len(fine), 8):
        for side in ((0.0, 0.0), (1.0, 1.0), (0.0, 1.0), (1.0, 0.0), random.random(2)):
            part, heading = np.clip(fine.lower[at] + side * (fine.upper[at] - fine.lower[at]), fine.lower[at], fine.upper[at]).tolist()
            assert holds(coarse, int(fine.walls[at]), int(fine.steps[at]), bool(fine.arriving[at]), part, heading)


def test_no_piece_is_wider_than_a_cell_of_its_grid_and_a_set_of_none_stays_one() -> None:
    walls = Walls.of(random_environment(1))
    none = random_set(walls, np.random.default_rng(0), 3).only(np.zeros(3, dtype=np.bool_))
    assert len(coarsened(none, walls, least_pieces(walls))) == 0
    wide = random_set(walls, np.random.default_rng(0), 200)
    cells = coarsened(wide, walls, 4 * least_pieces(walls))
    assert (cells.upper[:, 1] - cells.lower[:, 1] <= TURN / 2**COARSEST * (1.0 + 1e-9)).all()
