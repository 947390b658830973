"""The polar contractor against points computed in high precision, and against a twin that enumerates where bounds can be reached."""

import itertools
import math
from collections.abc import Iterator

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ial.contractors import Boxes, Polar
from ial.contractors.boxes import FloatArray
from ial.contractors.intervals.trigonometric import HALF_PI_UPPER, LARGEST_ANGLE, PI_UPPER

Sides = list[tuple[float, float]]
INF = math.inf
ENTIRE = (-INF, INF)
EMPTY = [(INF, -INF)] * 4
X, Y, R, THETA = range(4)


def contract(*sides: tuple[float, float]) -> Sides:
    boxes = Polar().contract(Boxes.of(sides))
    return list(zip(boxes.lower[0].tolist(), boxes.upper[0].tolist(), strict=True))


def around(exact: mpmath.mpf) -> tuple[float, float]:
    """Return the two doubles around a real number, or the one that it is."""
    nearest = float(exact)
    if nearest == exact:
        return nearest, nearest
    return (math.nextafter(nearest, -INF), nearest) if nearest > exact else (nearest, math.nextafter(nearest, INF))


def solution(r: float, theta: float) -> Sides:
    """Return the tightest doubles around the point with these polar coordinates."""
    with mpmath.workdps(700):  # enough to tell the cosine of the smallest double from 1
        return [around(r * mpmath.cos(theta)), around(r * mpmath.sin(theta)), (r, r), (theta, theta)]


def solutions(count: int, seed: int) -> Iterator[Sides]:
    rng = np.random.default_rng(seed)
    for _ in range(count):
        multiple = rng.integers(-9, 10) * math.pi / 4
        theta = rng.choice([0.0, rng.uniform(-7, 7), multiple, math.nextafter(multiple, INF), rng.uniform(-5e4, 5e4), 1e-9, 3e5])
        yield solution(float(rng.choice([0.0, 1.0, rng.uniform(0, 30), rng.uniform(0, 1e-6), 1e160, 1e-160])), float(theta))


def grown(points: FloatArray, seed: int) -> Boxes:
    """Return boxes around points: each bound by itself stays, or is moved out by a little or by a lot, or without end."""
    rng = np.random.default_rng(seed)
    moves = np.array([0.0, 1e-12, 1e-3, 0.1, 1.0, 10.0, INF])
    below, above = rng.choice(moves, (2, *points.shape[:2]), p=[0.3, 0.1, 0.1, 0.2, 0.2, 0.05, 0.05])
    return Boxes(points[:, :, 0] - below, points[:, :, 1] + above)


@pytest.fixture(scope="module")
def points() -> FloatArray:
    return np.array(list(solutions(4000, 1)))


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(5))
def test_a_point_that_satisfies_the_relation_is_never_lost(points: FloatArray, seed: int) -> None:
    boxes = grown(points, seed)
    narrowed = Polar().contract(boxes)
    lost = ((narrowed.lower > points[:, :, 0]) | (narrowed.upper < points[:, :, 1])).any(axis=1)
    assert not lost.any(), (boxes[lost][:2], points[lost][:2])
    assert ((narrowed.lower >= boxes.lower) & (narrowed.upper <= boxes.upper)).all()


@pytest.mark.slow
@given(
    st.floats(0.0, 1e9),
    st.floats(-1e5, 1e5),
    st.lists(st.floats(0.0, INF), min_size=8, max_size=8),
)
def test_a_drawn_point_is_never_lost(r: float, theta: float, moves: list[float]) -> None:
    point = solution(r, theta)
    narrowed = contract(*((low - moves[2 * i], high + moves[2 * i + 1]) for i, (low, high) in enumerate(point)))
    assert all(low <= inner_low and inner_high <= high for (inner_low, inner_high), (low, high) in zip(point, narrowed, strict=True))


def candidates(
    x: tuple[float, float], y: tuple[float, float], r: tuple[float, float], directions: list[float]
) -> Iterator[tuple[float, float]]:
    """Yield the points where two of the boundary curves of a box cross, and those where a curve turns back."""
    yield 0.0, 0.0
    yield from itertools.product(x, y)
    yield from ((each, 0.0) for each in x)
    yield from ((0.0, each) for each in y)
    for radius in r:
        for each in x:
            if abs(each) <= radius:
                other = math.sqrt(radius**2 - each**2)
                yield from ((each, other), (each, -other))
        for each in y:
            if abs(each) <= radius:
                other = math.sqrt(radius**2 - each**2)
                yield from ((other, each), (-other, each))
        yield from ((radius * math.cos(each), radius * math.sin(each)) for each in directions)
    for direction in directions:
        c, s = math.cos(direction), math.sin(direction)
        yield from ((each, each * s / c) for each in x if abs(c) > 1e-12 and each / c >= 0)
        yield from ((each * c / s, each) for each in y if abs(s) > 1e-12 and each / s >= 0)


def hull_of_solutions(lower: list[float], upper: list[float]) -> tuple[FloatArray, FloatArray] | None:
    """Return the hull of the solutions in a bounded box, to about nine digits: the twin."""
    x, y, r, theta = zip(lower, upper, strict=True)
    r = max(r[0], 0.0), r[1]
    quarter = math.pi / 2
    directions = [*theta, *(k * quarter for k in range(math.ceil(theta[0] / quarter), math.floor(theta[1] / quarter) + 1))]
    solutions = []
    for a, b in candidates(x, y, r, directions):
        radius, angle = math.hypot(a, b), math.atan2(b, a)
        turns = range(math.ceil((theta[0] - angle) / (2 * math.pi) - 1e-9), math.floor((theta[1] - angle) / (2 * math.pi) + 1e-9) + 1)
        angles = [angle + 2 * math.pi * k for k in turns] if radius > 1e-12 else list(theta)
        solutions += [(a, b, radius, each) for each in angles]
    points = np.array(solutions)
    inside = (np.array([x[0], y[0], r[0], theta[0]]) - 1e-9 <= points) & (points <= np.array([x[1], y[1], r[1], theta[1]]) + 1e-9)
    points = points[inside.all(axis=1)]
    return (points.min(axis=0), points.max(axis=0)) if len(points) else None


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2))
def test_no_narrower_box_would_do(seed: int) -> None:
    rng = np.random.default_rng(seed)
    count = 3000
    r, theta = rng.uniform(0, 3, count), rng.uniform(-9, 9, count)
    centre = np.stack([r * np.cos(theta), r * np.sin(theta), r, theta], axis=1)
    centre += rng.normal(size=centre.shape) * rng.choice([0.0, 0.3, 1.0], size=(count, 1))
    below, above = rng.choice([0.05, 0.3, 1.0, 3.0, 12.0], (2, count, 4), p=[0.3, 0.3, 0.2, 0.15, 0.05]) * rng.random((2, count, 4))
    boxes = Boxes(centre - below, centre + above)
    narrowed = Polar().contract(boxes)
    assert 0.2 < narrowed.empty.mean() < 0.8
    for i in range(count):
        twin = hull_of_solutions(boxes.lower[i].tolist(), boxes.upper[i].tolist())
        assert narrowed.empty[i] == (twin is None), boxes[[i]]
        if twin is not None:
            assert np.abs([narrowed.lower[i] - twin[0], narrowed.upper[i] - twin[1]]).max() < 1e-8, (boxes[[i]], narrowed[[i]], twin)


KNOWN = solution(5.0, 0.8)


@pytest.mark.parametrize("unknown", [(X, Y), (X, R), (Y, R), (R, THETA), (X, THETA), (Y, THETA)])
def test_two_coordinates_follow_from_the_two_others(unknown: tuple[int, int]) -> None:
    first_quadrant = [(0.0, INF), (0.0, INF), ENTIRE, (0.0, 1.5)]
    narrowed = contract(*(first_quadrant[i] if i in unknown else side for i, side in enumerate(KNOWN)))
    for i in unknown:
        assert narrowed[i] == pytest.approx(KNOWN[i], abs=4e-15)


def test_the_length_and_the_angle_of_a_point_are_enclosed_exactly() -> None:
    rng = np.random.default_rng(8)
    with mpmath.workdps(60):
        for x, y in (rng.uniform(-1.0, 1.0, (300, 2)) * 10.0 ** rng.integers(-6, 6, (300, 1))).tolist():
            sides = contract((x, x), (y, y), (0.0, INF), (-PI_UPPER, PI_UPPER))
            assert sides[R][0] <= mpmath.hypot(x, y) <= sides[R][1]
            assert sides[THETA][0] <= mpmath.atan2(y, x) <= sides[THETA][1]
            assert sides[R][1] - sides[R][0] <= 2.0**-51 * abs(x + 1j * y)


def test_points_on_an_axis_are_found_without_any_width_across_it() -> None:
    assert contract(ENTIRE, ENTIRE, (2.0, 2.0), (0.0, 0.0))[Y] == (0.0, 0.0)
    assert contract((3.0, 3.0), (0.0, 0.0), ENTIRE, (-3.0, 3.0)) == [(3.0, 3.0), (0.0, 0.0), (3.0, 3.0), (0.0, 0.0)]
    assert contract((0.0, 0.0), (1.0, 2.0), ENTIRE, (0.0, 3.0))[THETA] == (math.pi / 2, HALF_PI_UPPER)


def test_an_angle_is_found_in_each_turn_that_its_interval_meets() -> None:
    for turn in range(-3, 4):
        centre = 0.8 + 2 * math.pi * turn
        assert contract(KNOWN[X], KNOWN[Y], ENTIRE, (centre - 3, centre + 3))[THETA] == pytest.approx((centre, centre), abs=1e-13)
    many = contract(KNOWN[X], KNOWN[Y], ENTIRE, (-50.0, 50.0))[THETA]
    assert many == pytest.approx((0.8 - 16 * math.pi, 0.8 + 14 * math.pi))
    assert many[0] > -50.0
    assert many[1] < 50.0


def test_angles_across_the_cut() -> None:
    narrowed = contract((-5, -4), (-1, 1), ENTIRE, (2.0, 4.5))
    assert narrowed[THETA] == pytest.approx((math.pi - math.atan(0.25), math.pi + math.atan(0.25)))
    assert narrowed[R] == pytest.approx((4.0, math.hypot(5, 1)))


def test_the_origin_has_every_direction() -> None:
    assert contract((0, 0), (0, 0), (0, 5), (-100, 1e4)) == [(0, 0), (0, 0), (0, 0), (-100, 1e4)]
    assert contract((-1, 1), (-1, 1), (0, 0), (1, 2)) == [(0, 0), (0, 0), (0, 0), (1, 2)]
    assert contract((0, 0), (0, 0), (1, 2), (-4, 4)) == EMPTY


def test_the_length_is_never_negative() -> None:
    assert contract(ENTIRE, ENTIRE, (-3, 2), (-PI_UPPER, PI_UPPER)) == [(-2, 2), (-2, 2), (0, 2), (-PI_UPPER, PI_UPPER)]
    assert contract(ENTIRE, ENTIRE, (-3, -1), ENTIRE) == EMPTY


def test_unbounded_boxes() -> None:
    assert contract(ENTIRE, ENTIRE, ENTIRE, ENTIRE) == [ENTIRE, ENTIRE, (0, INF), ENTIRE]
    assert contract(ENTIRE, ENTIRE, (1, 2), ENTIRE) == [(-2, 2), (-2, 2), (1, 2), ENTIRE]
    assert contract((1, INF), (2, INF), ENTIRE, (0, 1.5))[R] == pytest.approx((math.sqrt(5), INF))
    assert contract((1, INF), (-INF, 0), ENTIRE, (0, 1)) == [(1, INF), (0, 0), (1, INF), (0, 0)]


def test_angles_beyond_the_range_of_the_sine() -> None:
    far = 2 * LARGEST_ANGLE
    assert contract(KNOWN[X], KNOWN[Y], ENTIRE, (far, far + 1))[THETA] == (far, far + 1)
    assert contract((9, 10), KNOWN[Y], (0, 5), (far, far + 1)) == EMPTY
    half = contract(KNOWN[X], KNOWN[Y], ENTIRE, (-INF, 1.0))
    assert half[THETA] == pytest.approx((-INF, 0.8))
    assert contract(ENTIRE, ENTIRE, (1, 1), (LARGEST_ANGLE - 1, far))[X] == (-1, 1)


def test_an_empty_row_stays_empty_and_others_are_kept_in_order() -> None:
    boxes = Boxes.of(KNOWN, EMPTY, KNOWN, [(9, 10), *KNOWN[1:]])
    before = boxes.lower.copy()
    narrowed = Polar().contract(boxes)
    assert narrowed.empty.tolist() == [False, True, False, True]
    assert (narrowed.lower[[1, 3]] == INF).all()
    assert (narrowed.upper[[1, 3]] == -INF).all()
    assert (boxes.lower == before).all()


def test_boxes_of_another_dimension_are_refused() -> None:
    with pytest.raises(ValueError, match="Polar needs 4"):
        Polar().contract(Boxes.of([(0, 1)]))
