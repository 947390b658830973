from fractions import Fraction

import mpmath
import numpy as np
import pytest

from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.rays.legs import Legs, radians
from ial.bouncing.rays.ray_set import RaySet
from ial.bouncing.start import ANYWHERE, Start
from ial.errors import ConfigError
from ial.maps.polygons.walls import Walls
from tests.bouncing.exact_rays import DIGITS, exact
from tests.bouncing.rays.test_real_robot import ROOM


def on_wall(count: int, reach: float = np.inf, heading: float = 4.7) -> RaySet:
    """A robot in the middle of the lowest wall, after so many steps."""
    at = np.array([[0.5, heading]])
    return RaySet(np.zeros(1, np.int32), at, at, np.array([count], np.int32), np.ones(1, np.bool_), np.array([reach]))


def test_the_way_of_a_leg_lies_between_exact_bounds() -> None:
    """k steps of at least (1 − e)·h and at most (1 + e)·h, give or take what the clock may have missed, and part of another step."""
    for step, error, missed in (
        (Fraction(1, 10), Fraction(1, 50), 1),
        (Fraction(1, 3), Fraction(0), 0),
        (Fraction(7, 9), Fraction(1, 7), 2),
    ):
        legs = Legs(Walls.of(ROOM), Fraction(90), step, ExecutionBounds(Fraction(0), error, missed))
        for count in range(200):
            ((least,), (most,)) = legs.ways(on_wall(count))
            assert Fraction(least) <= max(count - missed, 0) * step * (1 - error) <= Fraction(least) + Fraction(1, 10**9)
            assert Fraction(most) - Fraction(1, 10**9) <= (count + missed + 1) * step * (1 + error) <= Fraction(most)


def test_a_robot_that_has_not_bumped_may_stand_within_its_reach() -> None:
    legs = Legs(Walls.of(ROOM), Fraction(90), Fraction(1, 2), ExecutionBounds(count=1))
    ((least,), (most,)) = legs.driven(on_wall(4))
    assert (least, most) == pytest.approx((1.5, 2.5))
    ((least,), (most,)) = legs.driven(on_wall(4, reach=2.0))
    assert (least, most) == pytest.approx((1.5, 2.0))


def test_who_arrives_has_come_from_its_start_by_so_many_steps() -> None:
    """Down to the middle of a wall of 4 m, from 1 m above it or more."""
    legs, down = Legs(Walls.of(ROOM), Fraction(90), Fraction(1, 2), ExecutionBounds()), 1.5 * np.pi
    above = Start((Fraction(1), Fraction(1), Fraction(3), Fraction(2)))
    assert [bool(legs.can_have_come(on_wall(count, heading=down), above)[0]) for count in (0, 1, 2, 3, 4, 5)] == [
        False,
        True,
        True,
        True,
        True,
        False,
    ]
    assert legs.can_have_come(on_wall(5, heading=down), ANYWHERE)[0]
    assert not legs.can_have_come(on_wall(5, reach=2.4, heading=down), ANYWHERE)[0]
    assert not legs.can_have_come(on_wall(2, heading=down), Start((Fraction(3), Fraction(1), Fraction(4), Fraction(2))))[0]


def test_degrees_are_enclosed_in_radians() -> None:
    for low in (Fraction(-1000, 7), Fraction(0), Fraction(1, 3), Fraction(90), Fraction(359)):
        for wide in (Fraction(0), Fraction(1, 9), Fraction(180)):
            first, last = radians(low, low + wide)
            with mpmath.workdps(DIGITS):
                assert exact(first) <= exact(low) * mpmath.pi / 180 <= exact(first) + mpmath.mpf(10) ** -14
                assert exact(last) - mpmath.mpf(10) ** -14 <= exact(low + wide) * mpmath.pi / 180 <= exact(last)


def test_what_cannot_be_meant_is_refused() -> None:
    with pytest.raises(ConfigError, match="step is 0 m"):
        Legs(Walls.of(ROOM), Fraction(90), Fraction(0), ExecutionBounds())
    with pytest.raises(ConfigError, match="multiple of 360°"):
        Legs(Walls.of(ROOM), Fraction(720), Fraction(1), ExecutionBounds())
