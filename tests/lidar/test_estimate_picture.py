import math

import pytest
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle, Wedge

from ial.contractors.boxes import Boxes
from ial.lidar.estimate import Estimate
from ial.lidar.estimate_picture import draw_hypotheses
from ial.lidar.hypothesis import Hypothesis
from ial.lidar.pose_set import PoseSet
from ial.pose import Pose

ONE = Hypothesis((1.0, 2.0), (3.0, 3.5), (3.0, 3.5), 1, 0.25)


def test_each_hypothesis_is_its_hull_and_its_headings() -> None:
    ax = Figure().add_subplot()
    draw_hypotheses(ax, (ONE, Hypothesis((5.0, 6.0), (0.0, 1.0), (-math.pi, math.pi), 1, 0.1)), None, "two")
    hulls = [each for each in ax.patches if isinstance(each, Rectangle)]
    fans = [each for each in ax.patches if isinstance(each, Wedge)]
    assert [(*each.get_xy(), each.get_width(), each.get_height()) for each in hulls] == [(1.0, 3.0, 1.0, 0.5), (5.0, 0.0, 1.0, 1.0)]
    assert [(each.theta1, each.theta2) for each in fans] == [(math.degrees(3.0), math.degrees(3.5)), (-180.0, 180.0)]
    assert ax.get_title() == "two"


@pytest.mark.slow
def test_what_is_left_out_is_said() -> None:
    ax = Figure().add_subplot()
    draw_hypotheses(ax, [ONE] * 2001, None, "many")
    assert len(ax.patches) == 4000
    assert ax.get_title() == "many, the 2000 largest shown"


@pytest.mark.parametrize("hypotheses", [(), (ONE,)])
def test_a_notebook_shows_an_estimate(hypotheses: tuple[Hypothesis, ...]) -> None:
    poses = PoseSet(Boxes.of([(1, 2), (3, 3.5), (3, 3.5)]) if hypotheses else Boxes.none(3))
    pose = Pose(1.5, 3.25, 3.25) if hypotheses else None
    made = Estimate(0, "localized" if hypotheses else "blind", hypotheses, pose, poses, 180, 10, False, "", 0.1)
    assert made._repr_png_().startswith(b"\x89PNG")
    assert f"{len(hypotheses)} hypothes" in repr(made)
