import math
from dataclasses import replace

import numpy as np
import pytest

from ial.contractors.threads import set_threads
from ial.datasets.motion import MotionBounds
from ial.datasets.scan import LaserScan, Mounting
from ial.datasets.simulator import Lidar, SensorErrors, simulate
from ial.datasets.walk import random_walk
from ial.errors import ConfigError, MapError, RecordingError
from ial.maps.grids.floor_plan import floor_plan
from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, OccupancyGrid
from ial.particles.brute_force import BruteForce
from ial.particles.likelihood_field import BeamModel
from ial.pose import Pose, wrap

ALL_AROUND = Lidar(beams=180, angle_min=-math.pi, angle_increment=math.pi / 90.0, mounting=Mounting(0.2, -0.1, 2.0, upside_down=True))


def scene(seed: int, side_m: float = 10.0) -> tuple[OccupancyGrid, Pose, LaserScan]:
    """A turned map, a pose in it, and a scan with errors and outliers."""
    plan = floor_plan(side_m, side_m, 0.05, seed)
    grid = replace(plan, origin=Pose(-30.0, 12.0, 0.7 * seed))
    return grid, *seen(grid, random_walk(grid, 1, seed)[0], seed)


def seen(grid: OccupancyGrid, pose: Pose, seed: int) -> tuple[Pose, LaserScan]:
    simulation = simulate(grid, [pose], ALL_AROUND, SensorErrors(0.05, 0.002, 18), MotionBounds(), seed)
    (reading,) = simulation.recording.readings()
    return pose, reading.scan


def off(pose: Pose, truth: Pose) -> tuple[float, float]:
    return math.hypot(pose.x - truth.x, pose.y - truth.y), abs(wrap(pose.theta - truth.theta))


@pytest.mark.many
@pytest.mark.parametrize("seed", range(12))
def test_the_true_pose_is_found(seed: int) -> None:
    grid, truth, scan = scene(seed)
    match = BruteForce(grid).locate(scan)
    distance, turn = off(match.best.pose, truth)
    assert distance < 0.15
    assert turn < 0.06
    assert match.runner_up is None or match.runner_up.score <= match.best.score


def test_the_answer_does_not_depend_on_threads() -> None:
    grid, _, scan = scene(3)
    search = BruteForce(grid)
    try:
        answers = []
        for threads in (1, 2, 5):
            set_threads(threads)
            answers.append(search.locate(scan))
    finally:
        set_threads(None)
    assert answers[0] == answers[1] == answers[2]


def test_refinement_is_better_than_the_lattice_allows() -> None:
    grid, truth, scan = scene(5)
    coarse = BruteForce(grid, candidates=1).locate(scan).best
    assert off(coarse.pose, truth)[0] < 0.15
    assert coarse.score <= BruteForce(grid).locate(scan).best.score


def test_every_free_position_is_tried_with_every_heading() -> None:
    search = BruteForce(OccupancyGrid(np.pad(np.full((198, 198), FREE, np.uint8), 1, constant_values=OCCUPIED), 0.05))
    assert search.headings == 36
    assert search.locate(LaserScan(0, np.full(8, 3.0, np.float32), 0.0, 0.5)).poses == 50 * 50 * 36


def test_the_runner_up_of_a_symmetric_room_is_the_opposite_pose() -> None:
    room = OccupancyGrid(np.pad(np.full((60, 100), FREE, np.uint8), 1, constant_values=OCCUPIED), 0.05)
    truth, scan = seen(room, Pose(1.5, 1.0, 0.4), 1)
    match = BruteForce(room).locate(scan)
    opposite = Pose(room.width_m - truth.x, room.height_m - truth.y, wrap(truth.theta + math.pi))
    assert match.runner_up is not None
    places = sorted((match.best.pose, match.runner_up.pose), key=lambda pose: off(pose, truth))
    for pose, place in zip(places, (truth, opposite), strict=True):
        distance, turn = off(pose, place)
        assert distance < 0.1
        assert turn < 0.06
    assert match.best.score - match.runner_up.score < 0.1


def test_a_scan_without_a_hit_is_refused() -> None:
    grid, _, _ = scene(0)
    with pytest.raises(RecordingError, match="no usable beam"):
        BruteForce(grid).locate(LaserScan(0, np.array([np.nan, np.inf, 0.0], np.float32), 0.0, 0.1))


@pytest.mark.parametrize("wrong", [{"position_m": 0.0}, {"position_m": math.nan}, {"heading_rad": -1.0}, {"candidates": 0}])
def test_a_lattice_that_cannot_be_made_is_refused(wrong: dict[str, float]) -> None:
    grid, _, _ = scene(0)
    with pytest.raises(ConfigError, match=r"lattice|candidates"):
        BruteForce(grid, **wrong)


def test_a_lattice_that_misses_the_free_space_is_refused() -> None:
    cells = np.full((100, 100), OCCUPIED, np.uint8)
    cells[0, 0] = FREE
    with pytest.raises(ConfigError, match="smaller position_m"):
        BruteForce(OccupancyGrid(cells, 0.05), position_m=1.0)


def test_a_map_without_obstacles_is_refused() -> None:
    with pytest.raises(MapError, match="no occupied cell"):
        BruteForce(OccupancyGrid(np.full((10, 10), FREE, np.uint8), 0.05), BeamModel())
