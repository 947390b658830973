"""What is rounded about walls and headings, against exact numbers: far from (0, 0), with short walls, and after many turns."""

from fractions import Fraction

import mpmath
import numpy as np
import pytest

from ial.bouncing.rays import ray_grid
from ial.bouncing.rays.ray_model import RayModel
from ial.bouncing.rays.ray_set import RaySet
from ial.errors import MapError
from ial.maps.polygons.environment import Environment
from ial.maps.polygons.polygon import Polygon
from ial.maps.polygons.walls import Walls

OFFSETS = [Fraction(0), Fraction(10**6) + Fraction(1, 3), Fraction(-(10**9))]


def room(*corners: tuple[Fraction | int, Fraction | int]) -> Environment:
    return Environment((Polygon(tuple((Fraction(x), Fraction(y)) for x, y in corners)),))


@pytest.mark.parametrize("offset", OFFSETS)
def test_lengths_and_directions_of_walls_are_wrong_by_no_more_than_they_say(offset: Fraction) -> None:
    random = np.random.default_rng(0)
    with mpmath.workdps(60):
        for size in (Fraction(1, 10**6), Fraction(7, 3), Fraction(10**6)):
            angles = np.sort(random.uniform(0.0, 6.28, 12)).tolist()
            corners = [(offset + size * Fraction(np.cos(angle)), offset + size * Fraction(np.sin(angle)) / 3) for angle in angles]
            walls = Walls.of(room(*corners))
            x0, y0 = walls.origin
            exact = [(px - x0, py - y0) for px, py in corners]
            for at, (px, py) in enumerate(exact):
                qx, qy = exact[(at + 1) % len(exact)]
                assert abs(Fraction(walls.x[at]) - px) <= Fraction(walls.margin) / 16
                dx, dy = (mpmath.mpf(part.numerator) / part.denominator for part in (qx - px, qy - py))
                assert abs(mpmath.hypot(dx, dy) - walls.lengths[at]) <= walls.margin / 4
                assert abs(mpmath.atan2(dy, dx) - mpmath.mpf(walls.angles[at])) <= walls.slants[at]
                assert max(px, py, mpmath.hypot(dx, dy)) <= walls.scale


def test_a_wall_that_rounding_might_turn_is_refused() -> None:
    near = Fraction(1, 10**9)
    Walls.of(room((0, 0), (10, 0), (10, 10), (near, 10), (0, 10 - near)))
    for tiny in (Fraction(1, 10**13), Fraction(1, 10**30)):
        with pytest.raises(MapError, match="leave out corners that lie so close together"):
            Walls.of(room((0, 0), (10, 0), (10, 10), (tiny, 10), (0, 10 - tiny)))


@pytest.mark.parametrize("turns", [0, 1, -1, 9, 1000, 1591, -1591, 15_000])
def test_headings_are_turned_back_outward(turns: int) -> None:
    random = np.random.default_rng(1)
    with mpmath.workdps(60):
        starts = np.array([float(2 * mpmath.pi * turns) for _ in range(300)]) + random.uniform(0.0, 6.28, 300)
        stops = starts + random.choice([0.0, 1e-9, 0.1], 300)
        parts, none = np.zeros(300), np.zeros(300, dtype=np.int32)
        states = RaySet(none, np.stack([parts, starts], axis=1), np.stack([parts, stops], axis=1), none, none > 0, parts)
        turned = ray_grid._normal(states)
        for start, stop, low, high in zip(starts, stops, turned.lower[:, 1], turned.upper[:, 1], strict=True):
            assert -1e-9 < low < 6.5
            back = 2 * mpmath.pi * round((start - low) / (2.0 * np.pi))
            assert 0 <= mpmath.mpf(start) - back - low < 1e-10
            assert 0 <= high - (mpmath.mpf(stop) - back) < 1e-10


def test_a_bouncing_angle_and_headings_of_many_turns_are_those_less_the_turns() -> None:
    square, turns = room((0, 0), (4, 0), (4, 3), (0, 3)), 360 * 1592  # of 10^4 radians
    models = [
        RayModel(
            square, Fraction(100) + more, Fraction(1, 2), most_pieces=2200, headings_deg=((Fraction(350) + more, Fraction(370) + more),)
        )
        for more in (0, turns, -turns)
    ]
    answers = [model.leg(model.leg(model.universe(), 3), 4) for model in models]
    for each in answers[1:]:
        assert np.array_equal(each.walls, answers[0].walls)
        assert np.array_equal(each.lower, answers[0].lower)
        assert np.array_equal(each.upper, answers[0].upper)
