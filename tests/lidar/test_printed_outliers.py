"""The number of bad beams that an answer prints is the one that it was cut at: another run that is given this number agrees."""

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from ial.contractors.boxes import Boxes
from ial.datasets.motion import ErrorBound, Motion, MotionBounds
from ial.datasets.recording import Step, steps
from ial.datasets.scan import LaserScan
from ial.datasets.simulator import Lidar, SensorErrors, simulate
from ial.datasets.walk import random_walk
from ial.lidar.atlas import Atlas
from ial.lidar.configuration.config import Bounds, LocalizerConfig, Precision
from ial.lidar.evidence.beams import scan_beams
from ial.lidar.hypothesis import find_hypotheses
from ial.lidar.localizer import Localizer
from ial.lidar.model import LidarModel
from ial.lidar.pose_set import PoseSet
from ial.maps.grids.floor_plan import floor_plan
from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, OccupancyGrid

MOTION = MotionBounds(ErrorBound(0.05, 0.1), ErrorBound(0.03, 0.0, 0.1))
AUTO = LocalizerConfig(Bounds(0.03, 0.0, 0.01, MOTION), "auto", 2, 0.6, 1.0, precision=Precision(0.2, 0.1, 0))
STILL = Motion(np.array([-0.01, -0.01, -0.01]), np.array([0.01, 0.01, 0.01]))


@cache
def world() -> OccupancyGrid:
    return floor_plan(9.0, 7.0, 0.05, 3)


def drive(grid: OccupancyGrid, seed: int, outliers: int, beams: int = 72, scans: int = 3) -> list[Step]:
    lidar = Lidar(beams=beams, angle_min=-math.pi, angle_increment=2.0 * math.pi / beams)
    path = random_walk(grid, scans, seed, step_m=0.3, turn_rad=0.4)
    return list(steps(simulate(grid, path, lidar, SensorErrors(0.03, 0.0, outliers), MOTION, seed).recording, MOTION))


def nowhere() -> LaserScan:
    """Return a scan whose beams all end outside of the map."""
    ranges = np.random.default_rng(0).uniform(20.0, 25.0, 72)
    return LaserScan(99, ranges.astype(np.float32), -math.pi, math.pi / 36.0)


def confirmed(poses: PoseSet) -> list[list[float]]:
    """Return what the last scan has left, without what is only predicted, in one order."""
    boxes = poses.boxes[~poses.unconfirmed]
    return sorted(np.hstack([boxes.lower, boxes.upper]).tolist())


def allowed(config: LocalizerConfig, outliers: int) -> LocalizerConfig:
    return replace(config, outliers=outliers)


@pytest.mark.parametrize("seed", [1, 2])
def test_a_lost_scan_prints_what_its_own_search_used(seed: int) -> None:
    localizer = Localizer(world(), config=AUTO)
    for step in drive(world(), seed, 25):
        crowded = localizer.update(step.motion, step.scan).outliers_allowed
    elsewhere = drive(world(), seed + 20, 1)[0].scan
    estimate = localizer.update(STILL, elsewhere)
    assert estimate.status == "lost"
    assert estimate.outliers_allowed < crowded
    alone = Localizer(world(), config=allowed(AUTO, estimate.outliers_allowed)).locate(elsewhere)
    assert confirmed(estimate.poses) == confirmed(alone.poses)


def test_the_share_is_that_of_the_last_scan_whatever_its_beams() -> None:
    localizer = Localizer(world(), config=replace(AUTO, outliers=0.2))
    for step in drive(world(), 1, 0, beams=90):
        assert localizer.update(step.motion, step.scan).outliers_allowed == 18
    elsewhere = drive(world(), 21, 0, beams=45)[0].scan
    estimate = localizer.update(STILL, elsewhere)
    assert (estimate.status, estimate.outliers_allowed) == ("lost", 9)
    assert max(each.spare_beams or 0 for each in estimate.hypotheses) <= 9


@pytest.mark.parametrize("config", [AUTO, replace(AUTO, outliers=0.2)], ids=["auto", "share"])
def test_a_blind_scan_prints_how_many_were_allowed_in_vain(config: LocalizerConfig) -> None:
    most = scan_beams(nowhere(), config).outliers
    assert most > 0
    alone = Localizer(world(), config=config)
    assert [(each.status, each.outliers_allowed) for each in (alone.locate(nowhere()), alone.update(None, nowhere()))] == [
        ("blind", most)
    ] * 2
    tracked = Localizer(world(), config=config)
    for step in drive(world(), 1, 0):
        tracked.update(step.motion, step.scan)
    estimate = tracked.update(STILL, nowhere())
    assert (estimate.status, estimate.outliers_allowed) == ("blind", most)
    assert Atlas({"one": world()}, config).update(None, nowhere()).outliers_allowed == most


def test_a_jump_is_measured_from_the_last_scan_that_left_a_pose() -> None:
    localizer = Localizer(world(), config=replace(AUTO, max_jump=3, outlier_margin=0))
    calm, crowded = drive(world(), 1, 0), drive(world(), 1, 25)
    localizer.update(None, calm[0].scan)
    accepted = localizer.poses.accepted
    assert localizer.update(STILL, nowhere()).status == "blind"
    assert localizer.poses.accepted == accepted
    assert localizer.update(crowded[1].motion, crowded[1].scan).status == "lost"


def test_predictions_that_touch_what_was_found_do_not_count_as_spare() -> None:
    localizer = Localizer(world(), config=allowed(AUTO, 4))
    boxes = Boxes.of([(1.0, 1.2), (1.0, 1.2), (0.0, 0.1)], [(1.2, 1.4), (1.0, 1.2), (0.0, 0.1)])
    bad = np.array([3, 0], dtype=np.int16)
    mixed = PoseSet(boxes, np.array([False, True]), bad=bad, outliers=4)
    (only,) = find_hypotheses(mixed, localizer.grid)
    assert (only.spare_beams, only.prediction) == (1, False)
    (lost,) = find_hypotheses(mixed, localizer.grid, rejected=True)  # the scan has not cut all of it
    assert (lost.spare_beams, lost.prediction) == (1, True)


def furnished(grid: OccupancyGrid, seed: int) -> OccupancyGrid:
    """Return a map with furniture in it: the same rooms, so that one scan does not tell the maps apart."""
    cells = grid.cells.copy()
    random = np.random.default_rng(seed)
    for row, column in zip(random.integers(0, grid.rows, 25), random.integers(0, grid.columns, 25), strict=True):
        part = cells[row : row + 6, column : column + 6]
        part[part == FREE] = OCCUPIED
    return replace(grid, cells=cells)


@pytest.mark.parametrize("seed", [1, 2])
def test_an_atlas_cuts_all_its_maps_at_the_printed_number(seed: int) -> None:
    maps = {"bare": world(), **{f"furnished {number}": furnished(world(), number) for number in range(2)}}
    config = replace(AUTO, max_jump=0.4)
    atlas = Atlas(maps, config)
    models = {name: LidarModel(grid, config) for name, grid in maps.items()}
    calm, crowded, elsewhere = drive(world(), seed, 2), drive(world(), seed, 25), drive(world(), seed + 20, 1)
    statuses = []
    for step in (calm[0], crowded[1], crowded[2], replace(elsewhere[0], motion=STILL), elsewhere[1]):
        before = atlas.poses
        estimate = atlas.update(step.motion, step.scan)
        statuses.append(estimate.status)
        reading = scan_beams(step.scan, config).allowing(estimate.outliers_allowed)
        for name, model in models.items():
            start = model.universe() if step.motion is None or estimate.status == "lost" else model.predict(before[name], step.motion)
            expected = model.contract(start, reading)
            assert confirmed(atlas.poses[name]) == confirmed(expected), f"{name}, scan {len(statuses)}, {estimate.status}"
    assert statuses[3] == "lost"
