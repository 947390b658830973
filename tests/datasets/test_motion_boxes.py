"""What is too small for a test of motions: the last bit of headings and of their sums."""

from fractions import Fraction

import mpmath
import numpy as np

from ial.datasets.motion_boxes import compose, heading


def test_a_heading_is_that_of_the_quaternion_within_its_error_to_the_last_bit() -> None:
    random = np.random.default_rng(1)
    with mpmath.workprec(200):
        for _ in range(500):
            z, w = random.normal(size=2).tolist()
            error = float(random.choice([1e-3, 0.1, 1.0]) * random.random())
            lower, upper = heading(np.array([0.0, 0.0, z, w, 0.0, error]))
            exact = 2 * mpmath.atan2(z, w)
            assert lower <= exact - mpmath.mpf(error)
            assert exact + mpmath.mpf(error) <= upper
            assert upper - lower <= 2.0 * error + 1e-14


def test_the_sum_of_headings_is_outward_to_the_last_bit() -> None:
    random = np.random.default_rng(2)
    for _ in range(500):
        first, second = (np.sort(random.uniform(-1.0, 1.0, (3, 2)) * 10.0 ** random.uniform(-3, 1), axis=1) for _ in range(2))
        composed = np.empty((3, 2))
        compose(first, second, composed)
        low, high = (Fraction(float(first[2, side])) + Fraction(float(second[2, side])) for side in (0, 1))
        assert Fraction(float(composed[2, 0])) <= low
        assert high <= Fraction(float(composed[2, 1]))
        assert composed[2, 1] - composed[2, 0] <= float(high - low) + 1e-14
