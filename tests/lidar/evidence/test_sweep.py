"""Tests of where the robot was at each beam: simulated sweeps whose odometry errs as much as its bounds allow."""

import itertools
import math
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from ial.datasets.motion import ErrorBound, MotionBounds
from ial.datasets.odometry import Odometry
from ial.datasets.odometry_buffer import OdometryBuffer
from ial.datasets.odometry_path import OdometryPath
from ial.datasets.recording import Step
from ial.datasets.scan import LaserScan, Mounting
from ial.lidar.configuration.config import Bounds, FreeSpace, LocalizerConfig, Precision
from ial.lidar.evidence.beams import select_beams
from ial.lidar.evidence.sweep import sweep_boxes
from ial.lidar.localizer import Localizer
from ial.maps.grids.floor_plan import floor_plan
from ial.maps.grids.occupancy_grid import OCCUPIED, OccupancyGrid
from ial.pose import Pose

MS = 10**6
SWEEP_NS = 200 * MS
WHEELS = MotionBounds(ErrorBound(0.002, 0.1, 0.05, 0.02, 0.3), ErrorBound(0.003, 0.05, 0.1, 0.01, 0.3))
SLACK = 1e-9  # the true poses here are computed in plain doubles


def way(length: float, turn: float) -> Callable[[float], Pose]:
    """Return the pose after each share of a line, an arc, a turn on the spot, or no motion at all, all driven evenly."""

    def at(share: float) -> Pose:
        to = share * turn
        if abs(turn) < 1e-9:
            return Pose(share * length, 0.0, to)
        return Pose(length / turn * math.sin(to), length / turn * (1.0 - math.cos(to)), to)

    return at


WAYS = [(0.0, 0.0), (0.3, 0.0), (-0.2, 0.0), (0.0, 0.6), (0.3, 0.5), (0.2, -1.2), (0.5, 3.0), (1.0, -3.1)]


def driven(true: Callable[[float], Pose], shares: list[float], random: np.random.Generator) -> OdometryPath:
    """Return odometry at shares of the time, each piece wrong by almost all that its bounds allow."""
    here = Pose(3.0, -1.0, 2.5)
    rows = [(0, Odometry.of(here))]
    for start, stop in itertools.pairwise(shares):
        piece = true(start).inverse() @ true(stop)
        length, turn, seconds = math.hypot(piece.x, piece.y), abs(piece.theta), 1e-9 * SWEEP_NS * (stop - start)
        bounds = [part[:4] @ (1.0, length, turn, seconds) for part in WHEELS.parts]
        dx, dy, dtheta = (0.8 * random.choice([-1.0, 1.0], 3) * bounds).tolist()  # the bound belongs to what is recorded, a little less
        here = here @ Pose(piece.x + dx, piece.y + dy, piece.theta + dtheta)
        rows.append((round(SWEEP_NS * stop), Odometry.of(here)))
    return OdometryPath.of(rows)


def holds(box: np.ndarray, pose: Pose) -> bool:
    angle = pose.theta + 2.0 * math.pi * round((0.5 * (box[2, 0] + box[2, 1]) - pose.theta) / (2.0 * math.pi))
    return all(low - SLACK <= value <= high + SLACK for (low, high), value in zip(box, (pose.x, pose.y, angle), strict=True))


@pytest.mark.parametrize(("length", "turn"), WAYS)
@pytest.mark.parametrize("between", [0, 1, 7])
def test_every_beam_is_seen_from_where_the_robot_was(length: float, turn: float, between: int) -> None:
    true = way(length, turn)
    random = np.random.default_rng(between + 1)
    for _ in range(5):
        shares = [0.0, *np.sort(random.uniform(0.0, 1.0, between)).tolist(), 1.0]
        boxes = sweep_boxes(driven(true, shares, random), WHEELS, 90)
        assert all(holds(box, true(beam / 89)) for beam, box in enumerate(boxes))


def test_the_motion_to_the_last_beam_is_that_to_a_scan_without_its_part() -> None:
    path = driven(way(0.3, 0.5), [0.0, 0.3, 0.6, 1.0], np.random.default_rng(2))
    whole = WHEELS.along(path)
    widths = (whole.upper - whole.lower) - 0.6
    box = sweep_boxes(path, WHEELS, 20)[-1]
    assert box[:, 1] - box[:, 0] == pytest.approx(widths, abs=2 * 0.16 * 0.2 * 0.3)
    assert (box[:, 1] - box[:, 0] >= widths - SLACK).all()


@pytest.mark.parametrize(("length", "turn"), WAYS)
def test_interpolated_ends_are_as_wrong_as_they_say(length: float, turn: float) -> None:
    """The odometry is exact, but has no message at the first and the last beam."""
    true = way(2.0 * length, 2.0 * turn if abs(turn) < 1.5 else turn)  # from −100 to 300 ms
    none = MotionBounds(ErrorBound(), ErrorBound())
    for stamps in ([-100, 300], [-100, 100, 300], [-100, 10, 50, 180, 260]):
        buffer = OdometryBuffer([(stamp * MS, Odometry.of(true((stamp + 100) / 400))) for stamp in stamps])
        path = buffer.sweep(0, SWEEP_NS)
        assert path is not None
        boxes = sweep_boxes(path, none, 60)
        start = true(0.25).inverse()
        for beam, box in enumerate(boxes):
            assert holds(box, start @ true(0.25 + 0.5 * beam / 59))


def test_a_lidar_that_turns_backwards_in_time_is_the_same() -> None:
    true = way(0.3, 0.5)
    path = driven(true, [0.0, 0.4, 1.0], np.random.default_rng(1))
    back = OdometryPath(-path.stamps_ns, path.numbers)
    assert np.array_equal(sweep_boxes(path, WHEELS, 30), sweep_boxes(back, WHEELS, 30))


@pytest.mark.parametrize("seed", range(24))
def test_a_moving_robots_true_end_points_lie_in_the_error_region(seed: int) -> None:
    random = np.random.default_rng(seed)
    arm = 0.5 * bool(seed % len(WAYS) > 2)  # on a line, and without an arm, both coordinates are wrong by almost all that is allowed
    mounting = Mounting(*random.uniform(-arm, arm, 2).tolist(), float(random.uniform(-4.0, 4.0)), bool(random.integers(2)))
    true = way(*WAYS[seed % len(WAYS)])
    path = driven(true, [0.0, *np.sort(random.uniform(0.0, 1.0, seed % 3)).tolist(), 1.0], random)
    count = int(random.integers(2, 200))
    recorded = LaserScan(0, random.uniform(0.2, 20.0, count), -2.0, 4.0 / count, time_increment=1e-4, mounting=mounting, sweep=path)
    beams = select_beams(recorded, Bounds(0.02, 0.003, 0.0, WHEELS), 0, count, FreeSpace(max_rays=count))
    assert beams.rays is not None
    lower, upper = recorded.bearings()
    for i in range(count):
        laser = true(i / (count - 1)) @ mounting.pose
        angle = laser.theta + 0.5 * (lower[i] + upper[i]) + 0.003 * random.choice([-1.0, 1.0])
        reading = float(recorded.ranges[i]) + 0.02 * random.choice([-1.0, 1.0])
        aside = np.array([laser.x + reading * math.cos(angle), laser.y + reading * math.sin(angle)]) - beams.ends[i]
        direction = beams.directions[i]
        assert abs(aside @ direction) <= beams.errors[i, 0] + SLACK
        assert abs(aside @ (-direction[1], direction[0])) <= beams.errors[i, 1] + SLACK
        assert math.hypot(laser.x - beams.rays.origins[i, 0], laser.y - beams.rays.origins[i, 1]) <= beams.rays.margins[i] - 0.1 + SLACK
        assert abs(math.remainder(angle - beams.rays.angles[i], 2.0 * math.pi)) <= beams.rays.turns[i] + SLACK
        # A ray that begins elsewhere ends, along the beam, before the true one does.
        ahead = (laser.x - beams.rays.origins[i, 0]) * math.cos(angle) + (laser.y - beams.rays.origins[i, 1]) * math.sin(angle)
        assert beams.rays.lengths[i] <= float(recorded.ranges[i]) - 0.02 - 0.1 + ahead + SLACK


@pytest.mark.parametrize("deskew", [False, True])
def test_a_robot_that_stands_between_two_messages_is_not_lost(deskew: bool) -> None:
    """Messages at 0 and 0.4 s are 0.4 m apart; the scan is from 0.1 to 0.2 s, when the robot had not moved yet."""
    cells = np.zeros((80, 80), dtype=np.uint8)
    cells[[0, -1]] = cells[:, [0, -1]] = OCCUPIED
    angles = np.arange(90) * (math.pi / 45.0)
    at = Pose(1.5, 2.1, 0.0)
    with np.errstate(divide="ignore"):
        along = np.where(np.cos(angles) > 0, 3.95 - at.x, 0.05 - at.x) / np.cos(angles)
        across = np.where(np.sin(angles) > 0, 3.95 - at.y, 0.05 - at.y) / np.sin(angles)
    ranges = np.minimum(along, across) + 0.01
    buffer = OdometryBuffer([(0, Odometry(0.0, 0.0)), (400 * MS, Odometry(0.4, 0.0))])
    path = buffer.sweep(100 * MS, 200 * MS)
    assert path is not None
    scan = LaserScan(100 * MS, ranges, 0.0, math.pi / 45.0, time_increment=0.1 / 89, sweep=path)
    none = MotionBounds(ErrorBound(), ErrorBound())
    config = LocalizerConfig(bounds=Bounds(0.02, 0.0, 0.0, none), outliers=0, deskew=deskew)
    step = Step(0, scan.stamp_ns, None, scan, Odometry(*path.numbers[0].tolist()))
    assert Localizer(OccupancyGrid(cells, 0.05), config=config).update(step.motion, step.scan).poses.contains(at)


@pytest.mark.parametrize("error", [1e15, 1e40, 1e160, 1.7e308])
def test_motion_that_may_lead_anywhere_excludes_nothing(error: float) -> None:
    grid = floor_plan(6.0, 5.0, 0.1, 2)
    anything = MotionBounds(ErrorBound(error), ErrorBound(error))
    config = LocalizerConfig(Bounds(0.01, 0.0, 0.0, anything), 0, deskew=True, precision=Precision(0.5, 0.5, 0))
    path = OdometryPath.of([(0, Odometry.of(Pose())), (10**8, Odometry.of(Pose(0.3, -0.1, 2.0)))])
    scan = LaserScan(0, np.full(40, 3.0, np.float32), -3.0, 0.15, sweep=path)
    estimate = Localizer(grid, config=config).locate(scan)
    assert estimate.status == "ambiguous"
    # Only the first beam, at which the robot has not moved yet, says anything.
    still = Localizer(grid, config=replace(config, deskew=False)).locate(replace(scan, ranges=scan.ranges[:1], sweep=None))
    assert {tuple(each) for each in still.poses.boxes.lower.tolist()} <= {tuple(each) for each in estimate.poses.boxes.lower.tolist()}


@pytest.mark.parametrize("beams", [4, 7, 90])
def test_a_beam_has_exactly_its_share_of_a_turn(beams: int) -> None:
    """Without any error, half a radian in 0.2 s: the share of each beam is a fraction, and stamps are whole nanoseconds."""
    path = OdometryPath(np.array([0, SWEEP_NS]), np.array([Odometry.of(Pose(0.0, 0.0, turned)).numbers for turned in (0.0, 0.5)]))
    boxes = sweep_boxes(path, MotionBounds(ErrorBound(), ErrorBound()), beams)
    turned = boxes[-1, 2]
    for beam, box in enumerate(boxes):
        share = Fraction(beam, beams - 1)
        assert Fraction(float(box[2, 0])) <= share * Fraction(float(turned[1]))
        assert share * Fraction(float(turned[0])) <= Fraction(float(box[2, 1]))
        assert box[2, 1] - box[2, 0] <= 1e-6
