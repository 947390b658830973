import math
from collections.abc import Iterator

import mpmath
import numpy as np
import pytest

from ial.contractors import Boxes, RangeBearing
from ial.contractors.boxes import FloatArray
from ial.contractors.intervals.trigonometric import PI_UPPER

Sides = list[tuple[float, float]]
ENTIRE = (-math.inf, math.inf)
X, Y, THETA, R, BEARING, WX, WY = range(7)


def around(exact: mpmath.mpf) -> tuple[float, float]:
    """Return the two doubles around a real number, or the one that it is."""
    nearest = float(exact)
    if nearest == exact:
        return nearest, nearest
    return (math.nextafter(nearest, -math.inf), nearest) if nearest > exact else (nearest, math.nextafter(nearest, math.inf))


def solution(x: float, y: float, theta: float, r: float, bearing: float) -> Sides:
    """Return the tightest doubles around a point that satisfies the relation."""
    with mpmath.workdps(50):
        angle = mpmath.mpf(theta) + mpmath.mpf(bearing)
        w = (x + r * mpmath.cos(angle), y + r * mpmath.sin(angle))
        return [(value, value) for value in (x, y, theta, r, bearing)] + [around(value) for value in w]


def solutions(count: int, seed: int) -> Iterator[Sides]:
    rng = np.random.default_rng(seed)
    for _ in range(count):
        x, y = rng.uniform(-20, 20, 2) * rng.choice([0, 1])
        theta = rng.choice([rng.uniform(-7, 7), rng.integers(-8, 9) * math.pi / 4, rng.uniform(-500, 500)])
        bearing = rng.choice([0.0, rng.uniform(-3, 3), rng.integers(-4, 5) * math.pi / 4])
        r = rng.choice([0.0, rng.uniform(0, 30), 1.0, rng.uniform(0, 1e-6)])
        yield solution(float(x), float(y), float(theta), float(r), float(bearing))


def grown(points: FloatArray, seed: int) -> tuple[FloatArray, FloatArray]:
    """Return boxes around points: each side by itself stays, or is moved out by a little or by a lot, or without end."""
    rng = np.random.default_rng(seed)
    shape = points.shape[:2]
    moves = np.array([0.0, 0.0, 1e-12, 1e-3, 0.1, 1.0, 10.0, np.inf])
    chance = [0.2, 0.1, 0.1, 0.1, 0.2, 0.2, 0.05, 0.05]
    return points[:, :, 0] - rng.choice(moves, shape, p=chance), points[:, :, 1] + rng.choice(moves, shape, p=chance)


def contract(*sides: tuple[float, float]) -> Sides:
    boxes = RangeBearing().contract(Boxes.of(sides))
    return list(zip(boxes.lower[0].tolist(), boxes.upper[0].tolist(), strict=True))


@pytest.fixture(scope="module")
def points() -> FloatArray:
    return np.array(list(solutions(4000, 1)))


@pytest.mark.parametrize("seed", range(5))
def test_a_point_that_satisfies_the_relation_is_never_lost(points: FloatArray, seed: int) -> None:
    lower, upper = grown(points, seed)
    narrowed = RangeBearing().contract(Boxes(lower, upper))
    lost = ((narrowed.lower > points[:, :, 0]) | (narrowed.upper < points[:, :, 1])).any(axis=1)
    assert not lost.any(), (lower[lost][:2], upper[lost][:2], points[lost][:2])


@pytest.mark.parametrize("seed", range(3))
def test_the_result_is_at_least_as_narrow_as_the_input(points: FloatArray, seed: int) -> None:
    shifted = points + np.random.default_rng(seed).normal(size=(len(points), 7, 1)) * 0.3
    lower, upper = grown(shifted, seed)
    before = lower.copy(), upper.copy()
    narrowed = RangeBearing().contract(Boxes(lower, upper))
    assert (narrowed.lower >= lower).all()
    assert (narrowed.upper <= upper).all()
    assert (np.isposinf(narrowed.lower[narrowed.empty]) & np.isneginf(narrowed.upper[narrowed.empty])).all()
    assert 0 < narrowed.empty.sum() < len(lower)
    assert (lower == before[0]).all()
    assert (upper == before[1]).all()


# Each variable in turn is unknown, the others are points: the robot at (1, 2), heading 0.3, sees at bearing 0.5 a point 5 m away.
KNOWN = solution(1.0, 2.0, 0.3, 5.0, 0.5)


@pytest.mark.parametrize("unknown", [X, Y, R, WX, WY])
def test_one_unknown_is_found_from_the_six_others(unknown: int) -> None:
    narrowed = contract(*(ENTIRE if variable == unknown else side for variable, side in enumerate(KNOWN)))
    assert narrowed[unknown] == pytest.approx(KNOWN[unknown], abs=1e-12)


@pytest.mark.parametrize("unknown", [THETA, BEARING])
@pytest.mark.parametrize("turn", [-1.0, 0.0, 1.0])
def test_an_unknown_angle_is_found_in_any_turn(unknown: int, turn: float) -> None:
    centre = KNOWN[unknown][0] + 2 * math.pi * turn
    sides = [(centre - 3.0, centre + 3.0) if variable == unknown else side for variable, side in enumerate(KNOWN)]
    assert contract(*sides)[unknown] == pytest.approx((centre, centre), abs=1e-12)


def test_a_heading_is_narrowed_across_the_cut_at_half_a_turn() -> None:
    narrowed = contract((0, 0), (0, 0), (2.0, 4.5), (0, 10), (0, 0), (-5, -5), (-0.5, 0.5))
    assert narrowed[THETA] == pytest.approx((math.pi - math.atan(0.1), math.pi + math.atan(0.1)))
    assert narrowed[R] == pytest.approx((5.0, math.hypot(5.0, 0.5)))


def test_a_heading_that_fits_in_two_turns_becomes_their_hull() -> None:
    narrowed = contract((0, 0), (0, 0), (-4.0, 4.0), (1, 1), (0, 0), (-1, -0.9), (-0.1, 0.1))
    assert narrowed[THETA] == pytest.approx((-math.pi - math.acos(0.99), math.pi + math.acos(0.99)), abs=0.05)


def test_the_range_is_never_negative() -> None:
    assert contract((0, 0), (0, 0), (0, 0), (-3, 2), (0, 0), ENTIRE, ENTIRE)[R] == (0.0, 2.0)
    assert contract((0, 0), (0, 0), (0, 0), (-3, -2), (0, 0), ENTIRE, ENTIRE) == [(math.inf, -math.inf)] * 7


def test_a_range_of_zero_leaves_the_angles_free() -> None:
    circle = (-PI_UPPER, PI_UPPER)
    narrowed = contract((1, 1), (2, 2), circle, (0, 5), (-0.1, 0.1), (1, 1), (2, 2))
    assert narrowed[THETA] == circle
    assert narrowed[BEARING] == (-0.1, 0.1)
    assert narrowed[R] == (0.0, 0.0)


def test_the_range_is_divided_out_when_one_coordinate_is_free() -> None:
    narrowed = contract((0, 0), (0, 0), (math.pi / 3, math.pi / 3), (0, 100), (0, 0), (1, 2), ENTIRE)
    assert narrowed[R] == pytest.approx((2.0, 4.0))


def test_a_point_out_of_reach_empties_the_row() -> None:
    assert contract((0, 1), (0, 1), (-3, 3), (0, 2), (-1, 1), (5, 6), (0, 1)) == [(math.inf, -math.inf)] * 7


def test_an_empty_row_stays_empty_and_others_are_kept_in_order() -> None:
    boxes = Boxes.of(KNOWN, [(math.inf, -math.inf)] * 7, KNOWN)
    assert RangeBearing().contract(boxes).empty.tolist() == [False, True, False]


def test_boxes_of_another_dimension_are_refused() -> None:
    with pytest.raises(ValueError, match="RangeBearing needs 7"):
        RangeBearing().contract(Boxes.of([(0, 1)]))
