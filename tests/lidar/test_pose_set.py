import math

import numpy as np

from ial.contractors.boxes import Boxes
from ial.contractors.intervals.trigonometric import PI_UPPER
from ial.lidar.pose_set import PoseSet, unite
from ial.pose import Pose

POSES = PoseSet(Boxes.of([(0, 1), (0, 2), (3.0, 3.5)], [(5, 6), (0, 2), (-PI_UPPER, PI_UPPER)], [(0, 1), (4, 4), (0.5, 0.5)]))


def test_a_pose_is_contained_if_one_box_holds_all_of_it() -> None:
    for pose in (Pose(0.5, 1.0, 3.2), Pose(0.0, 0.0, 3.0), Pose(1.0, 2.0, 3.5), Pose(5.5, 1.0, -2.0), Pose(0.5, 4.0, 0.5)):
        assert POSES.contains(pose)
    for pose in (Pose(0.5, 1.0, 2.99), Pose(1.0 + 1e-12, 1.0, 3.2), Pose(0.5, -1e-12, 3.2), Pose(3.0, 1.0, 3.2), Pose(0.5, 4.0, 0.6)):
        assert not POSES.contains(pose)


def test_headings_are_taken_modulo_a_turn() -> None:
    for turns in (-2, -1, 0, 1, 2):
        assert POSES.contains(Pose(0.5, 1.0, 3.2 + 2.0 * math.pi * turns))
        assert not POSES.contains(Pose(0.5, 1.0, 2.9 + 2.0 * math.pi * turns))
    assert POSES.contains(Pose(0.5, 1.0, -math.pi))
    assert POSES.contains(Pose(5.0, 1.0, math.pi))


def test_no_boxes_contain_nothing() -> None:
    assert not PoseSet(Boxes.none(3)).contains(Pose())
    assert len(PoseSet(Boxes.none(3))) == 0


def test_boxes_are_confirmed_unless_it_is_said() -> None:
    assert POSES.unconfirmed.tolist() == [False] * 3


def test_a_union_remembers_what_is_only_predicted() -> None:
    confirmed, predicted = PoseSet(POSES.boxes[:2]), PoseSet(POSES.boxes[2:], limited="boxes")
    both = unite(confirmed, predicted)
    assert both.unconfirmed.tolist() == [False, False, True]
    assert (both.boxes.lower == POSES.boxes.lower).all()
    assert both.limited == "boxes"
    assert unite(PoseSet(POSES.boxes, limited="time"), predicted).limited == "time"
    assert unite(PoseSet(Boxes.none(3)), PoseSet(Boxes.none(3))).unconfirmed.dtype == np.bool_
