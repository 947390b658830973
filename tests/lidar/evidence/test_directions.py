import itertools

import mpmath
import numpy as np
import pytest

from ial.lidar.evidence.directions import unit_vectors
from ial.lidar.evidence.end_points import relative_bounds
from ial.lidar.evidence.evidence import Evidence
from ial.lidar.margins import MARGIN, REACH


@pytest.mark.slow
def test_errors_as_large_as_a_far_reading_take_nothing_off_a_region() -> None:
    """A thousand kilometres less nearly as much: what is left is small, what was rounded is not."""
    random = np.random.default_rng(3)
    with mpmath.workdps(60):
        for _ in range(2000):
            unit = unit_vectors(random.uniform(0.2, 1.3, 1))
            x, y = (1e6 * random.uniform(0.7, 1.0, 2)).tolist()
            along = float(random.uniform(0.2, 0.3)) * 1e6
            across = (x - along * unit[0, 0] - float(random.uniform(-500.0, 500.0))) / unit[0, 1]
            out = np.empty((1, 4))
            relative_bounds(0.0, 0.0, Evidence(np.array([[x, y]]), unit, np.array([[along, across]]), 0.0, 0), 0.01, out)
            dx, dy = (mpmath.mpf(float(value)) for value in unit[0])
            for far, side in itertools.product((-along, along), (-across, across)):
                px, py = (x + far * dx - side * dy) / mpmath.mpf(0.01), (y + far * dy + side * dx) / mpmath.mpf(0.01)
                for low, value, high in zip(out[0, :2], (px, py), out[0, 2:], strict=True):
                    drawn_in = min(max(value, -REACH), REACH)
                    assert low <= drawn_in - MARGIN / 2
                    assert high >= drawn_in + MARGIN / 2


def test_unit_vectors_are_those_of_the_toolkit_whose_error_is_known() -> None:
    angles = np.concatenate([np.random.default_rng(6).uniform(-size, size, 300) for size in (1e-3, 4.0, 1e4, 1e5)])
    with mpmath.workdps(50):
        for angle, (c, s) in zip(angles.tolist(), unit_vectors(angles).tolist(), strict=True):
            assert abs(mpmath.cos(mpmath.mpf(angle)) - c) < 2.0**-53
            assert abs(mpmath.sin(mpmath.mpf(angle)) - s) < 2.0**-53
