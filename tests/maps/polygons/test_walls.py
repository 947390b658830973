"""Walls as doubles against the exact environment."""

from fractions import Fraction

import mpmath
import numpy as np
import pytest

from ial.maps.polygons.environment import Environment
from ial.maps.polygons.polygon import Polygon
from ial.maps.polygons.walls import Walls
from tests.bouncing.exact_rays import DIGITS, ExactWalls, exact
from tests.bouncing.truth import random_environment


def moved(environment: Environment, x: Fraction, y: Fraction, size: Fraction) -> Environment:
    """Return the same environment, larger or smaller, elsewhere."""
    rings = [[tuple((px * size + x, py * size + y) for px, py in ring) for ring in each.rings] for each in environment.polygons]
    return Environment(tuple(Polygon.trusted(outer, tuple(holes)) for outer, *holes in rings))


@pytest.mark.parametrize("seed", range(30))
def test_what_is_known_of_a_wall_is_wrong_by_less_than_is_said(seed: int) -> None:
    sizes = (Fraction(1), Fraction(1, 3), Fraction(1000, 7), Fraction(1, 10**4))
    there = moved(random_environment(seed), Fraction(10**6, 3), Fraction(-(10**5), 7), sizes[seed % 4])
    walls, exactly = Walls.of(there), ExactWalls.of(there)
    assert walls.origin == there.bounds[:2]
    with mpmath.workdps(DIGITS):
        farthest = max(mpmath.hypot(ax - bx, ay - by) for ax, ay in exactly.starts for bx, by in exactly.starts)
        assert farthest <= exact(walls.scale) <= 2 * farthest
        for at, ((ax, ay), (bx, by)) in enumerate(zip(exactly.starts, exactly.ends, strict=True)):
            length = mpmath.hypot(bx - ax, by - ay)
            rounding = walls.margin / 100  # the rest is for what is computed from these numbers
            assert abs(exact(walls.x[at]) - ax) <= rounding
            assert abs(exact(walls.y[at]) - ay) <= rounding
            assert abs(exact(walls.lengths[at]) - length) <= rounding
            assert abs(exact(walls.angles[at]) - exactly.angle(at)) <= walls.slants[at]
            number, links = (each[at] for each in walls.table)
            assert number.tolist() == [
                walls.x[at],
                walls.y[at],
                *(side[walls.after[at]] - side[at] for side in (walls.x, walls.y)),
                walls.lengths[at],
                walls.angles[at],
                walls.slants[at],
                0.0,
                0.0,
            ]
            assert abs(mpmath.atan2(exact(number[3]), exact(number[2])) - exactly.angle(at)) <= walls.slants[at]
            assert links.tolist() == [walls.after[at], walls.before[at], walls.bend[at]]
            assert exactly.starts[walls.after[at]] == exactly.ends[at]
            assert exactly.ends[walls.before[at]] == exactly.starts[at]


@pytest.mark.many
def test_the_slant_covers_a_direction_that_the_rounding_of_both_ends_has_turned() -> None:
    """Short walls far from the corner from which coordinates are counted: their ends are rounded by as much as a part of their length."""
    worst = 0.0
    for size in (10, 10**3, 10**6, 10**9):
        for seed in range(60):
            random = np.random.default_rng(seed)
            far = [Fraction(int(each), 10**15) for each in random.integers(2 * 10**14, 10**15, 2)]
            dx, dy = (Fraction(int(each), 7 * 10**3 * size) for each in random.integers(1, 1000, 2))
            corners = ((Fraction(0), Fraction(0)), (2 + far[0], Fraction(0)), (2 + far[0], far[1]), (2 + far[0] - dx, far[1] + dy))
            there = Environment((Polygon.trusted((*corners, (Fraction(0), far[1] + dy)), ()),))
            walls, exactly = Walls.of(there), ExactWalls.of(there)
            for at in range(len(walls)):
                wrong = abs(exact(walls.angles[at]) - exactly.angle(at))
                assert wrong <= walls.slants[at]
                worst = max(worst, float(wrong / walls.slants[at]))
    assert worst > 0.01, "the bound is not an empty one"


@pytest.mark.parametrize(("corner", "bend"), [((2, 1), -1), ((4, 2), 0), ((5, 3), 1)])
def test_a_corner_is_convex_or_reflex_or_none(corner: tuple[int, int], bend: int) -> None:
    ring = tuple((Fraction(x), Fraction(y)) for x, y in ((0, 0), (4, 0), corner, (4, 4), (0, 4)))
    walls = Walls.of(Environment((Polygon(ring),)))
    assert walls.bend.tolist()[2] == bend
    assert walls.bend.tolist()[:2] == [1, 1]
