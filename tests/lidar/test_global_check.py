import math
import time
from dataclasses import replace

import numpy as np
import pytest

from ial.contractors.boxes import Boxes
from ial.datasets.motion import Motion, MotionBounds
from ial.datasets.scan import LaserScan
from ial.datasets.simulator import Lidar, SensorErrors, simulate
from ial.errors import MapError
from ial.lidar.configuration.config import Bounds, FreeSpace, LocalizerConfig
from ial.lidar.evidence.beams import Beams, scan_beams
from ial.lidar.global_check import check_everywhere
from ial.lidar.localizer import Localizer
from ial.lidar.model import LidarModel
from ial.lidar.pose_set import PoseSet
from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, OccupancyGrid
from ial.pose import Pose

CONFIG = LocalizerConfig(bounds=Bounds(0.02, 0.0, 0.0), outliers=0.4, free_space=FreeSpace(use=False))
STILL = Motion.identity()


def two_rooms() -> OccupancyGrid:
    """Two rooms of one shape; in the right one stands a cupboard."""
    cells = np.full((60, 121), FREE, dtype=np.uint8)
    cells[[0, -1], :] = cells[:, [0, 60, -1]] = OCCUPIED
    cells[:, 59] = cells[:, 61] = OCCUPIED
    cells[1:20, 1:6] = cells[1:20, 62:67] = OCCUPIED
    cells[25:35, 110:120] = OCCUPIED
    return OccupancyGrid(cells, 0.05, Pose(1.0, 2.0, 0.3))


def seen_from(grid: OccupancyGrid, pose: Pose) -> LaserScan:
    lidar = Lidar(beams=120, angle_min=-math.pi, angle_increment=math.pi / 60.0)
    (reading,) = simulate(grid, [grid.pose_to_map(pose)], lidar, SensorErrors(0.01, 0.0), MotionBounds(), 3).recording.readings()
    return reading.scan


def around(pose: Pose) -> Boxes:
    return two_rooms().boxes_to_map(Boxes.around([(pose.x, pose.y, pose.theta)], [0.2, 0.2, 0.1]))


LEFT, RIGHT = Pose(1.5, 1.6, 0.2), Pose(1.5 + 61 * 0.05, 1.6, 0.2)


def test_a_robot_in_the_right_place_sees_no_better_one() -> None:
    grid = two_rooms()
    localizer = Localizer(grid, config=CONFIG, initial=around(RIGHT))
    scan = seen_from(grid, RIGHT)
    localizer.update(None, scan)
    check = localizer.check(scan)
    assert check is not None
    assert not check.better
    assert check.elsewhere is None or check.elsewhere == check.inside


def test_a_robot_in_the_twin_of_the_right_place_is_told_where_it_fits_better() -> None:
    grid = two_rooms()
    localizer = Localizer(grid, config=CONFIG, initial=around(LEFT))
    scan = seen_from(grid, RIGHT)
    estimate = localizer.update(None, scan)
    assert estimate.status == "localized", "forty percent of outliers hide the cupboard"
    check = localizer.check(scan)
    assert check is not None
    assert check.better
    assert check.elsewhere is not None
    assert check.elsewhere < check.inside - 5
    assert check.best is not None
    truth = grid.pose_to_map(RIGHT)
    assert check.best.x[0] <= truth.x <= check.best.x[1]
    assert check.best.y[0] <= truth.y <= check.best.y[1]


def test_checks_come_as_often_as_configured_and_change_nothing() -> None:
    grid = two_rooms()
    scan = seen_from(grid, RIGHT)
    with_checks = Localizer(grid, config=replace(CONFIG, check_every=3), initial=around(LEFT))
    without = Localizer(grid, config=CONFIG, initial=around(LEFT))
    for number in range(7):
        one, other = (each.update(STILL if number else None, scan) for each in (with_checks, without))
        assert (one.check is not None) == (number % 3 == 2)
        assert other.check is None
        assert one.hypotheses == other.hypotheses


def test_nothing_is_said_where_the_bad_beams_are_unknown() -> None:
    grid = two_rooms()
    localizer = Localizer(grid, config=CONFIG, initial=around(LEFT))
    blind = LaserScan(1, np.full(30, np.nan, dtype=np.float32), 0.0, 0.1)
    localizer.update(None, blind)
    assert localizer.check(blind) is None
    beams = scan_beams(seen_from(grid, RIGHT), CONFIG)
    limited = replace(localizer.poses, limited="boxes")
    assert check_everywhere(localizer.model, limited, beams) is None


@pytest.mark.parametrize("radius", [0.0, 0.1, 0.3])
def test_a_robot_of_some_radius_keeps_off_the_walls(radius: float) -> None:
    grid = two_rooms()
    model = Localizer(grid, config=replace(CONFIG, robot_radius_m=radius)).model
    occupied = np.argwhere(grid.cells == OCCUPIED)[:, ::-1] * grid.resolution
    random = np.random.default_rng(8)
    excluded = 0
    for x, y in random.uniform(0.05, (6.0, 2.95), (3000, 2)).tolist():
        aside = np.maximum(np.maximum(occupied - (x, y), (x, y) - occupied - grid.resolution), 0.0)
        distance = float(np.hypot(aside[:, 0], aside[:, 1]).min())
        if distance >= radius and distance > 0.0:
            assert model.in_domain(Pose(x, y, 0.0)), "a place with enough room is never left out"
        elif distance < radius - 2.0 * grid.resolution:
            assert not model.in_domain(Pose(x, y, 0.0))
            excluded += 1
    assert excluded > 100 if radius > 0.2 else excluded == 0


def test_a_robot_too_large_for_the_map_is_refused() -> None:

    with pytest.raises(MapError, match="fits nowhere"):
        Localizer(two_rooms(), config=replace(CONFIG, robot_radius_m=4.0))


def test_a_check_has_time_of_its_own(monkeypatch: pytest.MonkeyPatch) -> None:
    """The search of the scan takes all the time that it is given."""
    now, at, given = [100.0], Pose(1.5, 1.4, 0.2), []
    monkeypatch.setattr(time, "monotonic", lambda: now[0])
    localizer = Localizer(two_rooms(), config=replace(CONFIG, check_every=1, max_seconds=8.0), initial=around(at))

    def contract(self: LidarModel, states: PoseSet, reading: Beams) -> PoseSet:
        given.append(reading.deadline.left_s)
        now[0] += 4.0
        return states

    monkeypatch.setattr(LidarModel, "contract", contract)
    assert localizer.update(None, seen_from(two_rooms(), at)).elapsed_s >= 4.0
    assert given == [4.0, 4.0]
