import math

import pytest

from ial.contractors.boxes import Boxes
from ial.lidar.images import are_images
from ial.lidar.pose_set import PoseSet
from ial.pose import Pose

TURN = Pose(8.0, 8.0) @ Pose(0.0, 0.0, math.pi)  # half a turn about (4, 4)
QUARTER = Pose(8.0, 0.0) @ Pose(0.0, 0.0, 0.5 * math.pi)


def at(pose: Pose, half: float = 0.1) -> list[tuple[float, float]]:
    return [(pose.x - half, pose.x + half), (pose.y - half, pose.y + half), (pose.theta - half, pose.theta + half)]


@pytest.mark.parametrize(
    ("boxes", "symmetries", "images"),
    [
        (Boxes.of(at(Pose(1.0, 2.0, 3.0)), at(TURN @ Pose(1.0, 2.0, 3.0))), (TURN,), True),
        (Boxes.of(at(Pose(1.0, 2.0, 3.0)), at(TURN @ Pose(1.1, 2.1, 3.1), 0.02)), (TURN,), True),  # they touch, and nothing else does
        (Boxes.of(at(Pose(1.0, 2.0, 3.0)), at(TURN @ Pose(1.3, 2.0, 3.0))), (TURN,), False),
        (Boxes.of(at(Pose(1.0, 2.0, 3.0)), at(TURN @ Pose(1.0, 2.0, 2.7))), (TURN,), False),
        (Boxes.of(at(Pose(1.0, 2.0, 3.0)), at(TURN @ Pose(1.0, 2.0, 3.0))), (), False),
        (Boxes.of(at(Pose(1.0, 2.0, 3.0))), (TURN,), False),
        (Boxes.none(3), (TURN,), False),
        # Two pairs of images, which no turn leads into each other; and a box that meets the images of two.
        (Boxes.of(*(at(turn @ Pose(x, 2.0, 3.0)) for x in (1.0, 3.0) for turn in (Pose(), TURN))), (TURN,), False),
        (
            Boxes.of(*(at(turn @ Pose(x, 2.0, 3.0)) for x in (1.0, 3.0) for turn in (Pose(), TURN))),
            (QUARTER, TURN, QUARTER @ TURN),
            False,
        ),
        (Boxes.of(at(Pose(1.0, 2.0, 3.0)), at(Pose(1.3, 2.0, 3.0)), at(TURN @ Pose(1.15, 2.0, 3.0), 0.3)), (QUARTER, TURN), False),
        (
            Boxes.of(*(at(turn @ Pose(1.0, 2.0, 3.0)) for turn in (Pose(), QUARTER, TURN, QUARTER @ TURN))),
            (QUARTER, TURN, QUARTER @ TURN),
            True,
        ),
        # Two hypotheses that lie around the middle, of both headings each, and no longer so if a piece lies beside one of them.
        (Boxes.of(*(at(turn @ Pose(4.0, 4.0, 3.0)) for turn in (Pose(), QUARTER))), (QUARTER, TURN, QUARTER @ TURN), False),
        (Boxes.of(*(at(turn @ Pose(4.0, 4.0, 3.0)) for turn in (Pose(), TURN))), (QUARTER, TURN, QUARTER @ TURN), True),
    ],
)
def test_images_are_what_meets_one_to_one(boxes: Boxes, symmetries: tuple[Pose, ...], images: bool) -> None:
    assert are_images(PoseSet(boxes), symmetries, 16.0) is images
