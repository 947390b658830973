import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ial.contractors.geometry.orientation import orientation

coordinate = st.one_of(
    st.integers(-3, 3).map(float), st.floats(-1e6, 1e6).filter(lambda x: x == 0.0 or abs(x) > 1e-100), st.sampled_from([0.1, 0.2, 0.3])
)


def exact(ax: float, ay: float, bx: float, by: float, cx: float, cy: float) -> float:
    a, b, c, d, e, f = (Fraction(each) for each in (ax, ay, bx, by, cx, cy))
    turn = (a - e) * (d - f) - (b - f) * (c - e)
    return float((turn > 0) - (turn < 0))


@pytest.mark.slow
@settings(max_examples=500)
@given(st.lists(coordinate, min_size=6, max_size=6))
def test_orientation_is_exact(points: list[float]) -> None:
    assert orientation(*points) == exact(*points)


def test_orientation_is_exact_next_to_the_line() -> None:
    rng = np.random.default_rng(4)
    undecided_by_rounding = 0
    for _ in range(3000):
        ax, ay, bx, by = rng.uniform(-10, 10, 4).tolist()
        t = rng.uniform(-1, 2)
        cx, cy = ax + t * (bx - ax), ay + t * (by - ay)
        cy = math.nextafter(cy, rng.choice([-math.inf, math.inf]))
        expected = exact(ax, ay, bx, by, cx, cy)
        assert orientation(ax, ay, bx, by, cx, cy) == expected
        undecided_by_rounding += ((ax - cx) * (by - cy) - (ay - cy) * (bx - cx) > 0) - (
            (ax - cx) * (by - cy) - (ay - cy) * (bx - cx) < 0
        ) != expected
    assert undecided_by_rounding > 100  # or the test would ask nothing that plain arithmetic cannot answer


@pytest.mark.parametrize("scale", [1e-320, 1e-200, 1e200, 1e300])
def test_extreme_coordinates_are_never_answered_wrongly(scale: float) -> None:
    rng = np.random.default_rng(5)
    for _ in range(300):
        points = (rng.integers(-3, 4, 6) * scale).tolist()
        assert orientation(*points) in (0.0, exact(*points))
