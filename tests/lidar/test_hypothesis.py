import math
from dataclasses import replace

import numpy as np
import pytest

from ial.contractors.boxes import Boxes
from ial.contractors.intervals.angle import contains_angle
from ial.contractors.intervals.trigonometric import PI_UPPER
from ial.lidar.hypothesis import Hypothesis, find_hypotheses
from ial.lidar.pose_set import PoseSet, unite
from ial.maps.grids.occupancy_grid import OccupancyGrid
from ial.pose import Pose, wrap

SMALL = Hypothesis((1.0, 2.0), (3.0, 3.5), (0.0, 0.25), 4, 0.125)


def grid(origin: Pose = Pose()) -> OccupancyGrid:  # noqa: B008  (frozen)
    return OccupancyGrid(np.zeros((10, 10), dtype=np.uint8), 1.0, origin)


def test_half_widths_and_centre() -> None:
    assert SMALL.half_widths == (0.5, 0.125)
    assert SMALL.centre == Pose(1.5, 3.25, 0.125)
    assert replace(SMALL, theta=(3.0, 4.0)).centre.theta == pytest.approx(3.5 - 2.0 * math.pi)


def test_touching_boxes_are_one_hypothesis_and_the_largest_comes_first() -> None:
    boxes = Boxes.of(
        [(0, 1), (0, 1), (0.0, 0.5)], [(5, 7), (5, 7), (1.0, 2.0)], [(1, 2), (1, 2), (0.5, 1.0)], [(8, 9), (0, 1), (0.0, 0.25)]
    )
    hypotheses = find_hypotheses(PoseSet(boxes), grid())
    assert [each.boxes for each in hypotheses] == [1, 2, 1]
    assert [each.volume for each in hypotheses] == [4.0, 1.0, 0.25]
    assert not any(each.prediction for each in hypotheses)
    assert hypotheses[1].x[0] <= 0.0
    assert hypotheses[1].x[1] >= 2.0
    assert (*hypotheses[1].x, *hypotheses[1].y, *hypotheses[1].theta) == pytest.approx((0.0, 2.0, 0.0, 2.0, 0.0, 1.0))


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
        hypotheses = find_hypotheses(PoseSet(boxes), there)
        assert sum(each.boxes for each in hypotheses) == 5
        for row in range(5):
            at = boxes.lower[row] + random.random(3) * boxes.width()[row]
            pose = there.pose_to_map(Pose(*at.tolist()))
            inside = [
                e for e in hypotheses if e.x[0] <= pose.x <= e.x[1] and e.y[0] <= pose.y <= e.y[1] and contains_angle(*e.theta, pose.theta)
            ]
            assert inside
        assert all(abs(each.theta[0]) <= PI_UPPER for each in hypotheses)


def test_a_full_circle_stays_one_in_a_turned_map() -> None:
    full = PoseSet(Boxes.of([(0, 1), (0, 1), (-PI_UPPER, PI_UPPER)]))
    hypotheses = find_hypotheses(full, grid(Pose(1.0, 2.0, 0.7)))
    assert hypotheses[0].theta == (-PI_UPPER, PI_UPPER)
    across = find_hypotheses(PoseSet(Boxes.of([(0, 1), (0, 1), (3.0, 3.5)])), grid(Pose(theta=0.5)))
    assert wrap(across[0].theta[0]) == pytest.approx(3.5 - 2.0 * math.pi)
