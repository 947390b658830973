"""Tests of the simulator: its promises are checked at the true pose, by the definitions of the guarantee."""

import math
from dataclasses import replace

import numpy as np
import pytest

from ial.datasets.in_memory import InMemoryRecording
from ial.datasets.motion import ErrorBound, MotionBounds
from ial.datasets.odometry_path import OdometryPath
from ial.datasets.recording import Reading, steps
from ial.datasets.scan import BeamClass, Mounting
from ial.datasets.simulator import Lidar, SensorErrors, Simulation, simulate
from ial.datasets.walk import random_walk
from ial.errors import ConfigError
from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, UNKNOWN, OccupancyGrid
from ial.maps.grids.ray_casting import cast_rays
from ial.pose import Pose

BOUNDS = MotionBounds(ErrorBound(0.02, 0.1, 0.05), ErrorBound(0.01, 0.02, 0.1))
LIDAR = Lidar(beams=90, angle_min=-3.0, angle_increment=0.065, range_max=6.0, mounting=Mounting(0.2, -0.1, 2.0, upside_down=True))


@pytest.fixture(scope="module")
def grid() -> OccupancyGrid:
    """A room with pillars, turned and shifted."""
    random = np.random.default_rng(11)
    cells = np.zeros((120, 160), dtype=np.uint8)
    cells[[0, -1], :] = cells[:, [0, -1]] = OCCUPIED
    cells[random.integers(1, 119, 60), random.integers(1, 159, 60)] = OCCUPIED
    cells[60:62, 20:30] = UNKNOWN
    return OccupancyGrid(cells, 0.05, Pose(-3.0, 7.0, 0.6))


def _simulate(grid: OccupancyGrid, errors: SensorErrors, seed: int, lidar: Lidar = LIDAR) -> tuple[Simulation, list[Pose]]:
    path = random_walk(grid, 15, seed, step_m=0.3, turn_rad=0.6)
    return simulate(grid, path, lidar, errors, BOUNDS, seed), path


def _bad_beams(grid: OccupancyGrid, reading: Reading, pose: Pose, range_error: float, bearing_error: float) -> int:
    """Count hits that are bad at a pose: no bearing within its bound leads to a cell at a distance within its bound."""
    scan = reading.scan
    hits = scan.classes() == BeamClass.HIT
    laser = grid.origin.inverse() @ pose @ scan.mounting.pose
    lower, upper = (bound[hits] for bound in scan.bearings())
    offsets = np.linspace(-bearing_error, bearing_error, 401 if bearing_error else 1)
    angles = laser.theta + 0.5 * (lower + upper)[:, None] + offsets
    distances = cast_rays(grid.mask(OCCUPIED), grid.resolution, laser.x, laser.y, angles)
    tolerance = range_error + scan.range_slack()[hits] + 1.1e-3  # a beam may end up to 1 mm behind the edge of its cell
    off = np.abs(distances - scan.ranges[hits].astype(np.float64)[:, None])
    return int((off.min(axis=1) > tolerance).sum())


@pytest.mark.parametrize("adversarial", [False, True])
@pytest.mark.parametrize(("range_error", "bearing_error"), [(0.0, 0.0), (0.05, 0.0), (0.05, 0.01)])
def test_at_most_the_promised_number_of_beams_is_bad(
    grid: OccupancyGrid, adversarial: bool, range_error: float, bearing_error: float
) -> None:
    for seed, outliers in ((1, 0), (2, 12)):
        simulation, path = _simulate(grid, SensorErrors(range_error, bearing_error, outliers, adversarial), seed)
        counts = [
            _bad_beams(grid, reading, pose, range_error, bearing_error)
            for reading, pose in zip(simulation.recording.readings(), path, strict=True)
        ]
        assert max(counts) <= outliers
        assert not outliers or max(counts) > 0, "outliers that are never bad would test nothing"


def test_errors_that_exceed_the_bound_would_be_noticed(grid: OccupancyGrid) -> None:
    simulation, path = _simulate(grid, SensorErrors(0.2, 0.0), 3)
    assert any(_bad_beams(grid, reading, pose, 0.02, 0.0) for reading, pose in zip(simulation.recording.readings(), path, strict=True))


@pytest.mark.parametrize("adversarial", [False, True])
@pytest.mark.parametrize("every", [1, 4])
def test_every_true_motion_lies_in_its_interval(grid: OccupancyGrid, adversarial: bool, every: int) -> None:
    for seed in range(5):
        simulation, path = _simulate(grid, SensorErrors(adversarial=adversarial), seed)
        previous = None
        for step in steps(simulation.recording, BOUNDS, every=every):
            if previous is not None and step.motion is not None:
                assert step.motion.contains(path[previous].inverse() @ path[step.index])
            previous = step.index


def test_many_messages_a_scan_keep_their_bounds_each(grid: OccupancyGrid) -> None:
    path = random_walk(grid, 25, 2)
    bounds = MotionBounds(ErrorBound(0.002, 0.1, 0.05, 0.01, 0.02), ErrorBound(0.001, 0.02, 0.1, 0.01, 0.01))
    run = simulate(grid, path, LIDAR, SensorErrors(adversarial=True), bounds, 3, messages=8)
    assert {len(reading.messages) for reading in list(run.recording.readings())[1:]} == {7}
    for every in (1, 3):
        chosen = list(steps(run.recording, bounds, every=every))
        assert all(
            step.motion.contains(path[step.index - every].inverse() @ path[step.index]) for step in chosen if step.motion is not None
        )
    # The net motion alone would not do.
    readings = [replace(reading, messages=OdometryPath.of()) for reading in run.recording.readings()]
    net = list(steps(InMemoryRecording("net", readings), bounds))
    assert not all(step.motion.contains(path[step.index - 1].inverse() @ path[step.index]) for step in net if step.motion is not None)
    with pytest.raises(ConfigError, match="at least one odometry message"):
        simulate(grid, path, LIDAR, SensorErrors(), bounds, 3, messages=0)


def test_adversarial_odometry_comes_near_its_bounds(grid: OccupancyGrid) -> None:
    simulation, path = _simulate(grid, SensorErrors(adversarial=True), 4)
    tight = MotionBounds(replace(BOUNDS.translation, per_message=0.5 * BOUNDS.translation.per_message), BOUNDS.rotation)
    missed = [
        step.motion is not None and not step.motion.contains(path[step.index - 1].inverse() @ path[step.index])
        for step in steps(simulation.recording, tight)
    ]
    assert any(missed)


def test_truth_is_the_path_and_the_seed_decides_every_bit(grid: OccupancyGrid, canonical_steps) -> None:  # type: ignore[no-untyped-def]
    first, path = _simulate(grid, SensorErrors(outliers=5), 6)
    second, _ = _simulate(grid, SensorErrors(outliers=5), 6)
    assert [first.truth[row] for row in range(len(path))] == path
    assert canonical_steps(first.recording) == canonical_steps(second.recording)
    other = simulate(grid, path, LIDAR, SensorErrors(outliers=5), BOUNDS, 7)
    assert canonical_steps(first.recording) != canonical_steps(other.recording)
    assert first.truth.stamps_ns.tolist() == [reading.stamp_ns for reading in first.recording.readings()]


def test_far_walls_give_no_return(grid: OccupancyGrid) -> None:
    simulation, _ = _simulate(grid, SensorErrors(), 8, replace(LIDAR, range_max=1.0))
    classes = np.concatenate([reading.scan.classes() for reading in simulation.recording.readings()])
    assert (classes == BeamClass.NO_RETURN).any()


def test_a_path_outside_free_space_is_refused(grid: OccupancyGrid) -> None:
    inside_unknown = grid.origin @ Pose(25 * 0.05, 61 * 0.05)
    for pose in (inside_unknown, grid.origin @ Pose(-1.0, 1.0), grid.origin @ Pose(0.01, 0.01)):
        with pytest.raises(ConfigError, match="pose 0 of the path"):
            simulate(grid, [pose], LIDAR, SensorErrors(), BOUNDS, 1)


def test_bounds_below_rounding_are_refused(grid: OccupancyGrid) -> None:
    path = random_walk(grid, 10, 1)
    with pytest.raises(ConfigError, match="smaller than the rounding errors"):
        simulate(grid, path, LIDAR, SensorErrors(), MotionBounds(ErrorBound(0.0), ErrorBound(0.0)), 1)


@pytest.mark.parametrize("bad", [{"range_error_m": -0.1}, {"bearing_error_rad": math.nan}, {"outliers": -1}])
def test_bounds_must_not_be_negative(bad: dict[str, float]) -> None:
    with pytest.raises(ConfigError, match=next(iter(bad))):
        SensorErrors(**bad)  # type: ignore[arg-type]


def test_all_classes_of_cells_are_in_the_test_map(grid: OccupancyGrid) -> None:
    assert all(grid.mask(kind).any() for kind in (FREE, OCCUPIED, UNKNOWN))
