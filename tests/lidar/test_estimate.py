import math
from dataclasses import replace

import mpmath
import numpy as np
import pytest

from ial.contractors.boxes import Boxes
from ial.contractors.intervals.angle import contains_angle
from ial.contractors.intervals.trigonometric import PI_UPPER
from ial.lidar.configuration.config import LocalizedSize
from ial.lidar.estimate import judge, radius
from ial.lidar.hypotheses import Hypothesis, find_hypotheses
from ial.lidar.pose_set import PoseSet, unite
from ial.maps.grids.occupancy_grid import OccupancyGrid
from ial.pose import Pose, wrap

SMALL = Hypothesis((1.0, 2.0), (3.0, 3.5), (0.0, 0.25), 4, 0.125)
SIZE = LocalizedSize(0.5, 0.125)


def grid(origin: Pose = Pose()) -> OccupancyGrid:  # noqa: B008  (frozen)
    return OccupancyGrid(np.zeros((10, 10), dtype=np.uint8), 1.0, origin)


@pytest.mark.parametrize(
    ("hypotheses", "rejected", "found", "status"),
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
def test_the_status_is_as_defined(hypotheses: tuple[Hypothesis, ...], rejected: bool, found: bool, status: str) -> None:
    assert judge(hypotheses, SIZE, rejected=rejected, found=found) == status


def test_half_widths_and_centre() -> None:
    assert SMALL.half_widths == (0.5, 0.125)
    assert SMALL.centre == Pose(1.5, 3.25, 0.125)
    assert replace(SMALL, theta=(3.0, 4.0)).centre.theta == pytest.approx(3.5 - 2.0 * math.pi)


def test_touching_boxes_are_one_hypothesis_and_the_largest_comes_first() -> None:
    boxes = Boxes.of(
        [(0, 1), (0, 1), (0.0, 0.5)], [(5, 7), (5, 7), (1.0, 2.0)], [(1, 2), (1, 2), (0.5, 1.0)], [(8, 9), (0, 1), (0.0, 0.25)]
    )
    found = find_hypotheses(PoseSet(boxes), grid())
    assert [each.boxes for each in found] == [1, 2, 1]
    assert [each.volume for each in found] == [4.0, 1.0, 0.25]
    assert not any(each.prediction for each in found)
    assert found[1].x[0] <= 0.0
    assert found[1].x[1] >= 2.0
    assert (*found[1].x, *found[1].y, *found[1].theta) == pytest.approx((0.0, 2.0, 0.0, 2.0, 0.0, 1.0))


def test_a_hypothesis_is_a_prediction_only_if_all_of_it_is() -> None:
    near, far, beside = ([(at, at + 1), (0, 1), (0.0, 0.5)] for at in (0, 5, 1))
    poses = unite(PoseSet(Boxes.of(near)), PoseSet(Boxes.of(far, beside)))
    flags = {each.boxes: each.prediction for each in find_hypotheses(poses, grid())}
    assert flags == {2: False, 1: True}


def test_no_poses_are_no_hypotheses() -> None:
    assert find_hypotheses(PoseSet(Boxes.none(3)), grid()) == ()


def test_the_hull_in_the_map_frame_holds_every_pose_of_the_set() -> None:
    for seed in range(30):
        random = np.random.default_rng(seed)
        there = grid(Pose(*random.uniform(-50.0, 50.0, 2).tolist(), float(random.uniform(-math.pi, math.pi))))
        lower = np.column_stack([random.uniform(0.0, 9.0, (5, 2)), random.uniform(-math.pi, math.pi, 5)])
        boxes = Boxes(lower, lower + random.uniform(0.1, 0.9, (5, 3)))
        found = find_hypotheses(PoseSet(boxes), there)
        assert sum(each.boxes for each in found) == 5
        for row in range(5):
            at = boxes.lower[row] + random.random(3) * boxes.width()[row]
            pose = there.pose_to_map(Pose(*at.tolist()))
            inside = [
                e for e in found if e.x[0] <= pose.x <= e.x[1] and e.y[0] <= pose.y <= e.y[1] and contains_angle(*e.theta, pose.theta)
            ]
            assert inside
        assert all(abs(each.theta[0]) <= PI_UPPER for each in found)


def test_a_full_circle_stays_one_in_a_turned_map() -> None:
    full = PoseSet(Boxes.of([(0, 1), (0, 1), (-PI_UPPER, PI_UPPER)]))
    found = find_hypotheses(full, grid(Pose(1.0, 2.0, 0.7)))
    assert found[0].theta == (-PI_UPPER, PI_UPPER)
    across = find_hypotheses(PoseSet(Boxes.of([(0, 1), (0, 1), (3.0, 3.5)])), grid(Pose(theta=0.5)))
    assert wrap(across[0].theta[0]) == pytest.approx(3.5 - 2.0 * math.pi)


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
        found = radius(PoseSet(Boxes(lower[None], upper[None])), pose, there)
        assert far <= found <= far + 1e-13 * (2.0 * abs(origin.x) + 2.0 * abs(origin.y) + 60.0)
