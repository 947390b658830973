"""Tests of several lidars on one robot, each with its own mounting and its own errors."""

import math
from dataclasses import replace

import numpy as np
import pytest

from ial.contractors.intervals.angle import contains_angle
from ial.datasets.in_memory import InMemoryRecording
from ial.datasets.motion import ErrorBound, MotionBounds
from ial.datasets.scan import Mounting
from ial.datasets.simulator import Lidar, SensorErrors, simulate
from ial.datasets.walk import random_walk
from ial.errors import ConfigError
from ial.lidar.configuration.config import Bounds, LidarBounds, LocalizerConfig
from ial.lidar.evidence.beams import scan_beams
from ial.lidar.localizer import Localizer
from ial.lidar.run import localize
from ial.maps.grids.floor_plan import floor_plan
from ial.maps.grids.occupancy_grid import OccupancyGrid
from ial.pose import Pose

MOTION = MotionBounds(ErrorBound(0.02, 0.05, 0.0), ErrorBound(0.02, 0.0, 0.05))
LIDARS = {"front": LidarBounds(0.01, 0.001), "rear": LidarBounds(0.1, 0.02)}
PLACES = {"front": Mounting(0.3, 0.0, 0.0), "rear": Mounting(-0.3, 0.05, math.pi, upside_down=True)}


def run_of_two(seed: int, excess: float = 1.0) -> tuple[OccupancyGrid, InMemoryRecording, list[Pose]]:
    """Return a map, scans of a front and a rear lidar in turn, each seeing a half of the circle, and the true poses."""
    grid = floor_plan(10.0, 8.0, 0.05, seed)
    path = random_walk(grid, 8, seed, step_m=0.3, turn_rad=0.5, clearance_m=0.25)
    runs = []
    for frame, own in LIDARS.items():
        lidar = Lidar(beams=90, angle_min=-0.5 * math.pi, angle_increment=math.pi / 90.0, range_max=20.0, mounting=PLACES[frame])
        errors = SensorErrors(excess * own.range_error_m, excess * own.bearing_error_rad, outliers=5, adversarial=True)
        runs.append([(frame, reading) for reading in simulate(grid, path, lidar, errors, MOTION, seed).recording.readings()])
    readings = []
    for index in range(len(path)):
        frame, reading = runs[index % 2][index]
        readings.append(replace(reading, odometry=runs[0][index][1].odometry, scan=replace(reading.scan, frame_id=frame)))
    return grid, InMemoryRecording("two lidars", readings), path


def lost(seed: int, bounds: Bounds, excess: float = 1.0) -> bool:
    """Whether the true pose is missing from a set, or a scan is rejected."""
    grid, recording, path = run_of_two(seed, excess)
    localizer = Localizer(grid, config=LocalizerConfig(bounds=bounds, outliers=5))
    for step, estimate in localize(recording, localizer):
        truth = path[step.index]
        held = any(
            each.x[0] <= truth.x <= each.x[1] and each.y[0] <= truth.y <= each.y[1] and contains_angle(*each.theta, truth.theta)
            for each in estimate.hypotheses
        )
        if estimate.status in ("lost", "blind") or not held:
            return True
    return False


@pytest.mark.slow
def test_the_truth_is_never_lost_with_the_errors_of_each_lidar() -> None:
    bounds = Bounds(0.0, 0.0, 0.0, MOTION, LIDARS)
    assert [seed for seed in range(40) if lost(seed, bounds)] == []


def test_with_the_errors_of_the_better_one_for_both_it_is_lost() -> None:
    better = LIDARS["front"]
    bounds = Bounds(better.range_error_m, better.bearing_error_rad, 0.0, MOTION)
    assert any(lost(seed, bounds) for seed in range(10))


def test_the_errors_are_those_of_the_scan_that_is_used() -> None:
    _, recording, _ = run_of_two(0)
    front, rear = (reading.scan for reading in list(recording.readings())[:2])
    config = LocalizerConfig(bounds=Bounds(0.05, 0.01, 0.0, MOTION, {"rear": LIDARS["rear"]}))
    alone = replace(config, bounds=Bounds(0.1, 0.02, 0.0, MOTION))
    np.testing.assert_array_equal(scan_beams(rear, config).errors, scan_beams(rear, alone).errors)
    assert (scan_beams(front, config).errors < scan_beams(front, alone).errors).all()


def test_errors_that_are_none_are_refused() -> None:
    with pytest.raises(ConfigError, match=r"LidarBounds\.range_error_m is -1"):
        LidarBounds(-1.0, 0.0)
