"""Several maps at once: the right one is never excluded, the others are."""

import itertools
import math
import time
from dataclasses import replace

import pytest

from ial.datasets.motion import ErrorBound, Motion, MotionBounds
from ial.datasets.odometry import Odometry
from ial.datasets.recording import steps
from ial.datasets.simulator import Lidar, SensorErrors, Simulation, simulate
from ial.datasets.walk import random_walk
from ial.errors import ConfigError
from ial.lidar.atlas import Atlas
from ial.lidar.configuration.config import Bounds, LocalizerConfig
from ial.lidar.evidence.beams import Beams
from ial.lidar.localizer import Localizer
from ial.lidar.model import LidarModel
from ial.lidar.pose_set import PoseSet
from ial.maps.grids.floor_plan import floor_plan
from ial.maps.grids.occupancy_grid import OccupancyGrid
from ial.pose import Pose

MOTION = MotionBounds(ErrorBound(0.05, 0.1), ErrorBound(0.04, 0.0, 0.1))
LIDAR = Lidar(beams=120, angle_min=-math.pi, angle_increment=math.pi / 60.0, range_max=15.0)
BOUNDS = Bounds(0.03, 0.003, 0.01, MOTION)


def floors() -> dict[str, OccupancyGrid]:
    return {
        f"floor {number}": replace(floor_plan(9.0, 8.0, 0.05, number), origin=Pose(float(number), -2.0, 0.1 * number))
        for number in range(3)
    }


def drive(grid: OccupancyGrid, seed: int, scans: int = 12) -> Simulation:
    return simulate(grid, random_walk(grid, scans, seed), LIDAR, SensorErrors(0.03, 0.003, 6), MOTION, seed)


@pytest.mark.parametrize("outliers", ["auto", 0.08])
@pytest.mark.parametrize("seed", range(4))
def test_the_map_of_the_robot_is_never_excluded_and_the_others_soon_are(seed: int, outliers: float | str) -> None:
    maps = floors()
    home = f"floor {seed % 3}"
    run = drive(maps[home], seed)
    atlas = Atlas(maps, LocalizerConfig(bounds=BOUNDS, outliers=outliers))  # type: ignore[arg-type]
    for step in steps(run.recording, MOTION):
        estimate = atlas.update(step.motion, step.scan)
        truth = run.truth.at(step.stamp_ns)
        assert truth is not None
        assert home in estimate.possible
        assert atlas.poses[home].contains(maps[home].pose_to_grid(truth))
        assert (estimate.pose is None) == (estimate.map is None) == (estimate.status != "localized")
    assert (estimate.status, estimate.map, estimate.possible) == ("localized", home, (home,))
    assert estimate.pose is not None
    assert math.hypot(estimate.pose.x - truth.x, estimate.pose.y - truth.y) < 0.5


def test_one_map_gives_what_the_localizer_gives() -> None:
    grid = floors()["floor 1"]
    run = drive(grid, 5)
    config = LocalizerConfig(bounds=BOUNDS)
    atlas, localizer = Atlas({"only": grid}, config), Localizer(grid, config=config)
    for step in steps(run.recording, MOTION):
        answer, estimate = atlas.update(step.motion, step.scan), localizer.update(step.motion, step.scan)
        assert answer.hypotheses["only"] == estimate.hypotheses
        assert (answer.status, answer.pose, answer.outliers_allowed) == (estimate.status, estimate.pose, estimate.outliers_allowed)


def test_a_robot_that_took_the_lift_is_found_on_the_other_floor() -> None:
    maps = floors()
    atlas = Atlas(maps, LocalizerConfig(bounds=BOUNDS))
    runs = [("floor 0", drive(maps["floor 0"], 1)), ("floor 2", drive(maps["floor 2"], 2, 25))]
    statuses = []
    for name, run in runs:
        for step in steps(run.recording, MOTION):
            in_lift = MOTION.enclose(Motion.between(Odometry.of(Pose()), Odometry.of(Pose())))
            motion = step.motion if step.motion is not None or name == "floor 0" else in_lift
            estimate = atlas.update(motion, step.scan)
            statuses.append(estimate.status)
            truth = run.truth.at(step.stamp_ns)
            assert truth is not None
            if name == "floor 0" or "lost" in statuses:
                assert atlas.poses[name].contains(maps[name].pose_to_grid(truth))
    assert "lost" in statuses[12:15]
    assert (estimate.map, estimate.possible) == ("floor 2", ("floor 2",))


def test_the_order_of_the_maps_does_not_matter() -> None:
    maps = floors()
    run = drive(maps["floor 2"], 3, 6)
    answers = []
    for order in itertools.permutations(maps):
        atlas = Atlas({name: maps[name] for name in order}, LocalizerConfig(bounds=BOUNDS))
        answers.append([atlas.update(step.motion, step.scan).hypotheses for step in steps(run.recording, MOTION)])
    assert all(answer == answers[0] for answer in answers)


def test_an_atlas_needs_a_map() -> None:
    with pytest.raises(ConfigError, match="at least one"):
        Atlas({})


def test_every_map_has_its_part_of_the_time(monkeypatch: pytest.MonkeyPatch) -> None:
    """The first maps take all the time that they are given; the last one has as much."""
    now = [100.0]
    monkeypatch.setattr(time, "monotonic", lambda: now[0])
    atlas = Atlas(floors(), LocalizerConfig(bounds=BOUNDS, outliers=5, max_seconds=6.0))
    given = []

    def contract(self: LidarModel, states: PoseSet, reading: Beams) -> PoseSet:
        left = reading.deadline.left_s
        assert left is not None
        given.append(left)
        now[0] += left
        return states

    monkeypatch.setattr(LidarModel, "contract", contract)
    atlas.update(None, next(drive(floors()["floor 0"], 0, 1).recording.readings()).scan)
    assert given == pytest.approx([1.0, 1.0, 1.0])
