"""The distance of two points: never losing a point, and as narrow as a twin that samples."""

import math

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ial.contractors import Boxes, Distance

INF = math.inf
ENTIRE = (-INF, INF)


def around(exact: mpmath.mpf) -> tuple[float, float]:
    """Return the two doubles around a real number, or the one that it is."""
    nearest = float(exact)
    if nearest == exact:
        return nearest, nearest
    return (math.nextafter(nearest, -INF), nearest) if nearest > exact else (nearest, math.nextafter(nearest, INF))


def contract(*sides: tuple[float, float]) -> list[tuple[float, float]]:
    narrowed = Distance().contract(Boxes.of(sides))
    return list(zip(narrowed.lower[0].tolist(), narrowed.upper[0].tolist(), strict=True))


coordinate = st.one_of(st.sampled_from([0.0, 1.0, -1.0, 1e-300, 1e200]), st.floats(-100, 100))


@given(st.lists(coordinate, min_size=4, max_size=4), st.lists(st.floats(0.0, INF), min_size=10, max_size=10))
def test_a_point_that_satisfies_the_relation_is_never_lost(ends: list[float], moves: list[float]) -> None:
    ax, ay, bx, by = ends
    with mpmath.workdps(700):
        length = around(mpmath.hypot(mpmath.mpf(bx) - ax, mpmath.mpf(by) - ay))
    point = [(each, each) for each in ends] + [length]
    narrowed = contract(*((low - moves[2 * i], high + moves[2 * i + 1]) for i, (low, high) in enumerate(point)))
    assert all(low <= inner_low and inner_high <= high for (inner_low, inner_high), (low, high) in zip(point, narrowed, strict=True))


def test_no_much_narrower_box_would_do() -> None:
    rng = np.random.default_rng(2)
    steps = np.linspace(0.0, 1.0, 9)
    for _ in range(150):
        lower = np.append(rng.uniform(-2, 2, 4), rng.uniform(0, 2))
        upper = lower + rng.choice([0.2, 1.0, 2.0], 5)
        # Points of the box on a lattice; b is moved along y to where its distance from a is in range, if that is in the box.
        ax, ay, bx = (lower[i] + steps * (upper[i] - lower[i]) for i in range(3))
        d = lower[4] + np.linspace(0, 1, 33) * (upper[4] - lower[4])
        ax, ay, bx, d, sign = (grid.ravel() for grid in np.meshgrid(ax, ay, bx, d, [-1.0, 1.0]))
        with np.errstate(invalid="ignore"):
            by = ay + sign * np.sqrt(d**2 - (bx - ax) ** 2)
        points = np.stack([ax, ay, bx, by, d], axis=1)[(by >= lower[3]) & (by <= upper[3])]
        narrowed = Distance().contract(Boxes(lower[None], upper[None]))
        if not len(points):
            continue
        assert not narrowed.empty[0]
        assert (narrowed.lower[0] <= points.min(axis=0) + 1e-12).all()
        assert (narrowed.upper[0] >= points.max(axis=0) - 1e-12).all()
        # The lattice is coarse, so that its hull may be narrower by some steps; a bound that does not move at all would differ by more.
        assert (points.min(axis=0) - narrowed.lower[0] < 0.6).all()
        assert (narrowed.upper[0] - points.max(axis=0) < 0.6).all()


def test_each_variable_follows_from_the_others() -> None:
    assert contract((0, 0), (0, 0), (3, 3), (4, 4), ENTIRE)[4] == (5, 5)
    assert contract((0, 0), (0, 0), ENTIRE, (4, 4), (5, 5))[2] == (-3, 3)
    assert contract((0, 0), (0, 0), (0, INF), (4, 4), (5, 5))[2] == (3, 3)
    assert contract((-1, INF), (4, 4), (3, 3), (0, 0), (5, 5))[0] == (0, 6)
    assert contract((0, 0), (0, 9), (3, 3), (0, 0), (5, 5))[1] == pytest.approx((4, 4), rel=1e-15)


def test_two_branches_narrow_from_both_sides() -> None:
    narrowed = contract((0, 0), (0, 0), (-4, 10), (-1, 1), (5, 5))
    assert narrowed[2] == pytest.approx((math.sqrt(24), 5.0))


def test_the_distance_is_never_negative() -> None:
    assert contract((1, 1), (2, 2), (1, 1), (2, 2), (-1, 9)) == [(1, 1), (2, 2), (1, 1), (2, 2), (0, 0)]
    assert contract(ENTIRE, ENTIRE, ENTIRE, ENTIRE, (-2, -1)) == [(INF, -INF)] * 5


def test_unbounded_and_empty_rows() -> None:
    assert contract(ENTIRE, ENTIRE, ENTIRE, ENTIRE, ENTIRE) == [ENTIRE] * 4 + [(0, INF)]
    assert contract((0, 0), (0, 0), ENTIRE, ENTIRE, (1, 2))[2:] == [pytest.approx((-2, 2), rel=1e-15)] * 2 + [(1, 2)]
    assert contract((0, 0), (0, 0), (INF, -INF), ENTIRE, (1, 2)) == [(INF, -INF)] * 5
    assert contract((0, 0), (0, 0), (3, 4), (3, 4), (1, 2)) == [(INF, -INF)] * 5


def test_boxes_of_another_dimension_are_refused() -> None:
    with pytest.raises(ValueError, match="Distance needs 5"):
        Distance().contract(Boxes.of([(0, 1)]))
