"""The localization of a robot by one scan, written as a general problem of constraints, and the localizer beside it."""

import math
from functools import cache

import numpy as np
import pytest

from ial.contractors.algebra import relaxed
from ial.contractors.boxes import Boxes
from ial.contractors.combinators.cylinder import where
from ial.contractors.expressions.function_family import FunctionFamily
from ial.contractors.expressions.functions import cos, sin
from ial.contractors.expressions.variables import variables
from ial.contractors.intervals.interval import Interval
from ial.contractors.intervals.trigonometric import PI_UPPER
from ial.contractors.paving.paving import Paving
from ial.contractors.solving.problem import Problem
from ial.datasets.motion import MotionBounds
from ial.datasets.recording import steps
from ial.datasets.scan import BeamClass, LaserScan
from ial.datasets.simulator import Lidar, SensorErrors, simulate
from ial.datasets.walk import random_walk
from ial.lidar.configuration.config import Bounds, LocalizerConfig, Precision
from ial.lidar.localizer import Localizer
from ial.lidar.pose_set import PoseSet
from ial.maps.grids.cell_contractor import CellContractor
from ial.maps.grids.cell_index import CellIndex
from ial.maps.grids.floor_plan import floor_plan
from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, OccupancyGrid
from ial.pose import Pose

BOUNDS = Bounds(range_error_m=0.03, bearing_error_rad=0.002, map_error_m=0.02)
OUTLIERS = 3
PRECISION = Precision(0.1, math.pi / 64.0)


def localization(grid: OccupancyGrid, scan: LaserScan, bounds: Bounds, outliers: int) -> Problem:
    """Return the poses (x, y, θ) in the grid's frame at which at most so many beams of a scan are bad."""
    hits = scan.classes() == BeamClass.HIT
    reading, (first, last) = scan.ranges[hits].astype(np.float64), scan.bearings()
    ranges = Boxes.around(reading, scan.range_slack()[hits]) + Interval(-bounds.range_error_m, bounds.range_error_m)
    bearings = Boxes.column(first[hits], last[hits]) + Interval(-bounds.bearing_error_rad, bounds.bearing_error_rad)
    off = Interval(-bounds.map_error_m, bounds.map_error_m)
    walls = CellContractor(CellIndex(grid.mask(OCCUPIED), grid.resolution))
    floor = CellContractor(CellIndex(grid.mask(FREE), grid.resolution))

    x, y, theta = variables("x y theta")
    ends = FunctionFamily(x + ranges * cos(theta + bearings) + off, y + ranges * sin(theta + bearings) + off)
    return Problem(
        (x, y, theta),
        {x: Interval(0, grid.width_m), y: Interval(0, grid.height_m), theta: Interval(-PI_UPPER, PI_UPPER)},
        [where(floor, axes=(0, 1), dimension=3), relaxed(ends.preimage(walls), outliers)],
    )


@cache
def scene(seed: int) -> tuple[OccupancyGrid, LaserScan, Pose]:
    grid = floor_plan(6.0, 5.0, 0.05, seed)
    path = random_walk(grid, 1, seed, step_m=0.3, turn_rad=0.4)
    lidar = Lidar(beams=36, angle_min=-math.pi, angle_increment=math.pi / 18.0)
    errors = SensorErrors(BOUNDS.range_error_m, BOUNDS.bearing_error_rad, OUTLIERS, adversarial=True)
    (step,) = steps(simulate(grid, path, lidar, errors, MotionBounds(), seed).recording, MotionBounds())
    return grid, step.scan, grid.pose_to_grid(path[0])


@cache
def solved(seed: int) -> Paving:
    grid, scan, _ = scene(seed)
    return localization(grid, scan, BOUNDS, OUTLIERS).solve([PRECISION.position_m, PRECISION.position_m, PRECISION.heading_rad])


@cache
def located(seed: int) -> PoseSet:
    grid, scan, _ = scene(seed)
    config = LocalizerConfig(bounds=BOUNDS, outliers=OUTLIERS, precision=PRECISION)
    return Localizer(grid, config=config).locate(scan).poses


def meet(some: Boxes, others: Boxes) -> np.ndarray:
    """Return which boxes come within the precision of one of the others."""
    slack = np.array([PRECISION.position_m, PRECISION.position_m, PRECISION.heading_rad])
    near = (some.lower[:, None] <= others.upper + slack) & (others.lower - slack <= some.upper[:, None])
    return np.asarray(near.all(axis=2).any(axis=1))


@pytest.mark.parametrize("seed", [1, 2, 3, 4, 5, 6])
def test_the_problem_and_the_localizer_find_the_same_poses(seed: int) -> None:
    _, _, pose = scene(seed)
    boxes, cells = solved(seed).boxes, located(seed).boxes
    assert PoseSet(boxes).contains(pose)
    assert located(seed).contains(pose)
    assert not solved(seed).limited
    assert meet(boxes, cells).all()
    assert meet(cells, boxes).all()
    widths = boxes.width() + 2.0 * np.array([PRECISION.position_m, PRECISION.position_m, PRECISION.heading_rad])
    assert boxes.volume() <= cells.volume() <= widths.prod(axis=1).sum()


def test_more_outliers_than_allowed_exclude_the_truth() -> None:
    grid, scan, pose = scene(2)
    fewer = localization(grid, scan, BOUNDS, 0).solve(0.1)
    assert not PoseSet(fewer.boxes).contains(pose)


def test_a_robot_that_is_not_in_a_room_has_a_reason() -> None:
    grid, scan, pose = scene(2)
    problem = localization(grid, scan, BOUNDS, OUTLIERS)
    elsewhere = (0.0, pose.x - 1.0) if pose.x > 0.5 * grid.width_m else (pose.x + 1.0, grid.width_m)
    box = problem.box
    at = Boxes.of([elsewhere, (box.lower[0, 1], box.upper[0, 1]), (box.lower[0, 2], box.upper[0, 2])])
    assert not len(Problem(variables("x y theta"), at, problem.constraints).solve(0.1).boxes)
    floor, beams = problem.constraints
    assert beams in Problem(variables("x y theta"), at, problem.constraints).why_empty(0.1)
    assert Problem(variables("x y theta"), at, [floor]).solve(0.5).boxes.volume() > 0.0
