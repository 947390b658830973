"""An answer of which hardly anything is left says so."""

import math

import numpy as np
import pytest

from ial.contractors.boxes import Boxes
from ial.datasets.motion import Motion
from ial.datasets.simulator import Lidar, SensorErrors, simulate
from ial.lidar.beams import scan_beams
from ial.lidar.config import Bounds, LocalizerConfig, Precision
from ial.lidar.localizer import Localizer
from ial.lidar.pose_set import PoseSet
from ial.lidar.vanishing import is_vanishing, leeway
from ial.maps.floor_plan import floor_plan
from ial.pose import Pose

GRID = floor_plan(9.0, 7.0, 0.05, 3)
LIDAR = Lidar(beams=72, angle_min=-math.pi, angle_increment=math.pi / 36.0)
CONFIG = LocalizerConfig(Bounds(0.03, 0.0, 0.03), 4, precision=Precision(0.1, 0.05, 4))
AT = Pose(4.5, 3.5, 0.3)
SCAN = next(simulate(GRID, [AT], LIDAR, SensorErrors(0.0, 0.0, 0), CONFIG.bounds.motion, 1).recording.readings()).scan


def test_the_leeway_is_what_the_errors_leave_open() -> None:
    beams = scan_beams(SCAN, CONFIG)
    distance = float(np.hypot(*beams.ends.T).mean())
    assert leeway(beams, 0.03) == pytest.approx(0.12**2 * 2.0 * 0.06 / distance, rel=1e-3)
    assert leeway(beams, 0.06) > leeway(beams, 0.03)


def test_an_answer_with_room_is_not_vanishing_and_one_at_the_edge_of_its_bounds_is() -> None:
    whole = Localizer(GRID, config=CONFIG).locate(SCAN)
    assert not whole.vanishing
    edge = Boxes.of([(AT.x + 0.09, AT.x + 0.095), (AT.y, AT.y + 0.005), (AT.theta, AT.theta + 0.001)])
    beams = scan_beams(SCAN, CONFIG)
    assert is_vanishing([PoseSet(edge)], beams, 0.03)
    assert is_vanishing([PoseSet(Boxes.none(3))], beams, 0.03)
    assert not is_vanishing([PoseSet(edge), whole.poses], beams, 0.03)


def test_what_is_coarse_or_only_predicted_is_not_called_so() -> None:
    edge, beams = Boxes.of([(0.0, 1e-6), (0.0, 1e-6), (0.0, 1e-6)]), scan_beams(SCAN, CONFIG)
    assert not is_vanishing([PoseSet(edge, limited="boxes")], beams, 0.03)
    assert not is_vanishing([PoseSet(edge, np.array([True]))], beams, 0.03)
    assert not is_vanishing([PoseSet(edge)], beams.allowing(len(beams)), 0.03)


def test_a_tracked_robot_that_has_left_its_bounds_is_flagged() -> None:
    """The motion leads to where the scan just still fits: what is left has hardly any room."""
    flagged = localized = 0
    for far in np.linspace(0.05, 0.2, 16):
        localizer = Localizer(GRID, config=CONFIG, initial=Boxes.around([(AT.x, AT.y, AT.theta)], [0.01, 0.01, 0.01]))
        moved = Motion(np.array([far, -0.01, -0.01]), np.array([far + 0.02, 0.01, 0.01]))
        localizer.update(None, SCAN)
        estimate = localizer.update(moved, SCAN)
        flagged += estimate.vanishing
        localized += estimate.status == "localized"
    assert 0 < flagged < localized
