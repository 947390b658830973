import math
from dataclasses import replace

import mpmath
import numpy as np
import pytest

from ial.contractors.boxes import Boxes
from ial.lidar.configuration.config import LocalizedSize
from ial.lidar.estimate import judge, radius
from ial.lidar.hypothesis import Hypothesis
from ial.lidar.pose_set import PoseSet
from ial.maps.grids.occupancy_grid import OccupancyGrid
from ial.pose import Pose

SMALL = Hypothesis((1.0, 2.0), (3.0, 3.5), (0.0, 0.25), 4, 0.125)
SIZE = LocalizedSize(0.5, 0.125)


def grid(origin: Pose = Pose()) -> OccupancyGrid:  # noqa: B008  (frozen)
    return OccupancyGrid(np.zeros((10, 10), dtype=np.uint8), 1.0, origin)


@pytest.mark.parametrize(
    ("hypotheses", "rejected", "confirmed", "status"),
    [
        ((SMALL,), False, True, "localized"),
        ((replace(SMALL, x=(1.0, 2.0 + 1e-9)),), False, True, "ambiguous"),
        ((replace(SMALL, y=(2.0, 3.0 + 1e-9)),), False, True, "ambiguous"),
        ((replace(SMALL, theta=(0.0, 0.25 + 1e-9)),), False, True, "ambiguous"),
        ((SMALL, SMALL), False, True, "ambiguous"),
        ((), False, True, "ambiguous"),
        ((SMALL,), True, True, "lost"),
        ((SMALL, SMALL), True, True, "lost"),
        ((SMALL,), True, False, "blind"),
        ((), True, False, "blind"),
    ],
)
def test_the_status_is_as_defined(hypotheses: tuple[Hypothesis, ...], rejected: bool, confirmed: bool, status: str) -> None:
    assert judge(hypotheses, SIZE, rejected=rejected, confirmed=confirmed) == status


def test_no_position_of_a_set_is_farther_than_the_radius() -> None:
    """The distance in 200 bits, from the pose in the map to each corner of a box, turned and moved into the map."""
    for seed in range(300):
        random = np.random.default_rng(seed)
        origin = Pose(*(random.uniform(-1.0, 1.0, 2) * 10.0 ** random.integers(0, 7)).tolist(), float(random.uniform(-math.pi, math.pi)))
        there = grid(origin if seed % 3 else Pose(origin.x, origin.y))
        lower = np.array([*random.uniform(0.0, 9.0, 2), 0.0])
        upper = lower + random.choice([0.0, 1e-9, 0.5]) * random.random(3)
        pose = there.pose_to_map(Pose(*(lower[:2] + random.choice([0.0, 1e-9, 2.0]) * random.random(2)).tolist(), 0.0))
        with mpmath.workprec(200):
            c, s = mpmath.cos(there.origin.theta), mpmath.sin(there.origin.theta)
            corners = [(mpmath.mpf(x), mpmath.mpf(y)) for x in (lower[0], upper[0]) for y in (lower[1], upper[1])]
            far = max(mpmath.hypot(origin.x + c * x - s * y - pose.x, origin.y + s * x + c * y - pose.y) for x, y in corners)
        bound = radius(PoseSet(Boxes(lower[None], upper[None])), pose, there)
        assert far <= bound <= far + 1e-13 * (2.0 * abs(origin.x) + 2.0 * abs(origin.y) + 60.0)
