import itertools
import math

import numpy as np
import pytest

from ial.datasets.motion import ErrorBound, Motion, MotionBounds
from ial.datasets.odometry_path import OdometryPath


def test_a_path_is_the_composition_of_its_pieces() -> None:
    random = np.random.default_rng(4)
    parts = [(0.01, 0.1, 0.2, 0.3), (0.02, 0.2, 0.1, 0.05), (0.0, 0.0, 1.0, 0.0)]
    once = np.array([0.5, 0.1, 0.4])
    apart = MotionBounds(*(ErrorBound(*part) for part in parts))
    bounds = MotionBounds(*(ErrorBound(*part, scan) for part, scan in zip(parts, once[[0, 2, 1]], strict=True)))
    for count in (2, 3, 9):
        stamps = np.cumsum(random.integers(1, 10**9, count))
        path = OdometryPath(stamps, np.concatenate([random.normal(size=(count, 4)), random.uniform(0.0, 0.1, (count, 2))], axis=1))
        expected = Motion.identity()
        for (start, first), (stop, second) in itertools.pairwise(path):
            piece = apart.enclose(Motion.between(first, second), 1e-9 * float(stop - start))
            expected = piece if start == stamps[0] else expected.compose(piece)
        motion = bounds.along(path)
        assert motion.lower[:2] == pytest.approx(expected.lower[:2] - once[:2], abs=1e-9)
        assert motion.upper[:2] == pytest.approx(expected.upper[:2] + once[:2], abs=1e-9)
        assert motion.upper[2] - motion.lower[2] == pytest.approx(min(2.0 * math.pi, expected.upper[2] - expected.lower[2] + 0.8), abs=1e-9)
