"""The motions until each beam, worked out by hand, and held against the boxes of the localizer."""

import math
from dataclasses import replace

import numpy as np
import pytest

from ial.datasets.motion import ErrorBound, MotionBounds
from ial.datasets.odometry import Odometry
from ial.datasets.odometry_path import OdometryPath
from ial.lidar.evidence.sweep import sweep_boxes
from ial.pose import Pose
from ial.study.possible_motions import possible_motions
from tests.study.scans import swept

EXACT = MotionBounds(ErrorBound(), ErrorBound())


def test_a_beam_has_the_share_of_its_piece() -> None:
    corner = swept(Pose(1.0, 0.0, math.pi / 2.0), Pose(1.0, 2.0, math.pi / 2.0))
    moves = possible_motions(corner, EXACT, np.array([0.0, 0.25, 0.5, 0.75, 1.0]))
    assert moves.shape == (5, 1, 3)
    quarter = math.pi / 4.0
    expected = [[0, 0, 0], [0.5, 0, quarter], [1, 0, 2 * quarter], [1, 1, 2 * quarter], [1, 2, 2 * quarter]]
    assert moves[:, 0] == pytest.approx(np.array(expected, dtype=np.float64), abs=1e-12)


def test_the_boxes_of_the_localizer_hold_them() -> None:
    random = np.random.default_rng(0)
    for _ in range(60):
        count, beams = int(random.integers(1, 5)), int(random.integers(2, 12))
        numbers = [
            Odometry.of(Pose(*random.normal(0.0, 0.5, 3).tolist()), *random.uniform(0.0, 0.05, 2).tolist()) for _ in range(count + 1)
        ]
        stamps = np.cumsum(random.integers(1, 10**9, count + 1))
        path = OdometryPath.of(zip(stamps.tolist(), numbers, strict=True))
        bounds = MotionBounds(ErrorBound(*random.uniform(0.0, 0.1, 5).tolist()), ErrorBound(*random.uniform(0.0, 0.1, 5).tolist()))
        bounds = replace(bounds, sideways=ErrorBound(*random.uniform(0.0, 0.1, 5).tolist()) if random.integers(2) else None)
        moves = possible_motions(path, bounds, np.arange(beams) / (beams - 1))
        boxes = sweep_boxes(path, bounds, beams)
        turned = moves[:, :, 2] - 2.0 * math.pi * np.round((moves[:, :, 2] - boxes[:, None, 2].mean(axis=2)) / (2.0 * math.pi))
        moves = np.concatenate([moves[:, :, :2], turned[:, :, None]], axis=2)
        assert (boxes[:, None, :, 0] - 1e-9 <= moves).all()
        assert (moves <= boxes[:, None, :, 1] + 1e-9).all()
