import json
import math
from dataclasses import astuple, replace
from pathlib import Path

import numpy as np
import pytest

from ial.datasets.motion import ErrorBound, MotionBounds
from ial.datasets.recording import steps
from ial.datasets.simulator import Lidar, SensorErrors, simulate
from ial.datasets.walk import random_walk
from ial.lidar.configuration.config import Bounds, FreeSpace, LocalizerConfig
from ial.maps.grids.floor_plan import floor_plan
from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, OccupancyGrid
from ial.pose import Pose
from ial.results.lidar.failure_picture import draw_failures
from ial.study.bounds_survey import OUTLIERS, TOTALS_M, BoundsSurvey
from ial.study.motion_fit import RecordedStep, fitted
from ial.study.obstacles import Obstacles
from ial.study.reference import own_poses, reference_poses

WHEELS = MotionBounds(ErrorBound(0.03, 0.02, 0.02), ErrorBound(0.02, 0.01, 0.05))


def survey_of(grid: OccupancyGrid, config: LocalizerConfig, seed: int, outliers: int = 20, scans: int = 60) -> BoundsSurvey:
    path = random_walk(grid, scans, seed)
    run = simulate(grid, path, Lidar(beams=180, range_max=12.0), SensorErrors(0.05, 0.0, outliers, adversarial=True), WHEELS, seed)
    survey = BoundsSurvey(grid, config)
    for step, pose in reference_poses(run.recording, run.truth, "base", config):
        survey.add(step, pose)
    return survey


@pytest.mark.slow
def test_what_was_simulated_is_measured() -> None:
    grid = replace(floor_plan(12.0, 10.0, 0.05, 3), origin=Pose(4.0, -2.0, 0.6))
    config = LocalizerConfig(bounds=Bounds(0.05, 0.0, 0.0, WHEELS))
    survey = survey_of(grid, config, 1)
    record = survey.record()
    json.dumps(record, allow_nan=False)
    assert record["scans"] == 60
    assert record["motion"]["held"] == 1.0
    # Every scan has 20 wrong beams of 180, some of them without return; all others end within 5 cm.
    assert 0.06 < record["bad_share_of_a_scan"]["0.5"] <= 20 / 160
    assert record["held"]["0.05"]["0.15"] == 1.0
    assert record["held"]["0.05"]["0.02"] == 0.0
    assert record["held"]["0.03"]["0.2"] < 1.0
    table = survey.held()
    assert table.shape == (len(TOTALS_M), len(OUTLIERS))
    assert (np.diff(table, axis=0) >= 0.0).all()
    assert (np.diff(table, axis=1) >= 0.0).all()


def test_the_suggestion_holds() -> None:
    grid = floor_plan(12.0, 10.0, 0.05, 4)
    wrong = LocalizerConfig(bounds=Bounds(0.01, 0.0, 0.0, MotionBounds(ErrorBound(0.01, 0.01), ErrorBound(0.2, 0.2))))
    suggestion = survey_of(grid, wrong, 2, outliers=12).suggestion()
    assert suggestion.bounds.range_error_m + suggestion.bounds.map_error_m == pytest.approx(0.05)
    again = survey_of(grid, suggestion, 2, outliers=12).record()
    assert again["motion"]["held"] >= 0.98
    assert suggestion.bounds.motion.rotation.per_message < 0.2
    assert suggestion.bounds.motion.translation.per_message > 0.01


@pytest.mark.parametrize("every", [1, 4])
def test_bounds_are_fitted_over_every_message(every: int) -> None:
    grid = floor_plan(12.0, 10.0, 0.05, 4)
    path = random_walk(grid, 80, 5)
    wheels = MotionBounds(ErrorBound(0.01, 0.1, 0.0, 0.02, 0.05), ErrorBound(0.01, 0.0, 0.1, 0.02, 0.05))
    recording = simulate(grid, path, Lidar(beams=2), SensorErrors(), wheels, 5, messages=6).recording
    for start in (0.3, 5.0):
        first = MotionBounds(*(ErrorBound(*(start * part for part in astuple(bound))) for bound in (wheels.translation, wheels.rotation)))
        chosen = [
            RecordedStep(step.recorded, path[step.index - every].inverse() @ path[step.index])
            for step in steps(recording, first, every=every)
            if step.motion is not None
        ]
        assert {step.messages for step in chosen} == {6 * every}
        fitted_bounds = fitted(first, chosen, 0.99)
        held = [np.mean([step.held(bounds) for step in chosen], axis=0) for bounds in (fitted_bounds, first)]
        assert (held[0] >= 0.99).all()
        assert (start > 1.0) == (held[1] >= 0.99).all()
        ratios = [sum(astuple(bound)) / sum(astuple(other)) for bound, other in zip(_both(fitted_bounds), _both(wheels), strict=True)]
        assert max(ratios) < 1.3  # two digits are rounded up


def _both(bounds: MotionBounds) -> tuple[ErrorBound, ErrorBound]:
    return bounds.translation, bounds.rotation


def test_distances_are_those_to_closed_cells() -> None:
    random = np.random.default_rng(5)
    cells = (random.random((20, 30)) < 0.05).astype(np.uint8) * OCCUPIED
    grid = OccupancyGrid(cells, 0.1)
    points = random.uniform(-0.5, 3.5, (300, 2))
    occupied = np.argwhere(cells == OCCUPIED)[:, ::-1] * 0.1
    aside = np.maximum(np.maximum(occupied - points[:, None], points[:, None] - occupied - 0.1), 0.0)
    expected = np.hypot(aside[..., 0], aside[..., 1]).min(axis=1)
    assert Obstacles(grid).distances(points) == pytest.approx(expected, abs=1e-12)


def test_what_has_come_and_what_has_gone_is_found_on_the_map(tmp_path: Path) -> None:
    cells = np.full((100, 100), FREE, dtype=np.uint8)
    cells[[0, -1]] = cells[:, [0, -1]] = OCCUPIED
    then, now = cells.copy(), cells.copy()
    then[60:70, 20:22] = OCCUPIED
    now[30:40, 70:72] = OCCUPIED
    old, new = OccupancyGrid(then, 0.05), OccupancyGrid(now, 0.05)
    path = [Pose(2.5, 1.0 + 0.1 * step, 0.3 * step) for step in range(20)]
    all_around = Lidar(beams=180, angle_min=-math.pi, angle_increment=math.pi / 90.0)
    run = simulate(new, path, all_around, SensorErrors(0.01, 0.0), WHEELS, 1)
    config = LocalizerConfig(bounds=Bounds(0.02, 0.0, 0.0, WHEELS), free_space=FreeSpace(margin_m=0.03, max_rays=180))
    survey = BoundsSurvey(old, config)
    for step, pose in reference_poses(run.recording, run.truth, "base", config):
        survey.add(step, pose)
    failures = survey.failures
    rows, columns = np.nonzero(failures.ended)
    assert failures.cell_m * rows.min() > 1.4
    assert failures.cell_m * rows.max() < 2.1
    assert failures.cell_m * columns.min() > 3.2
    rows, columns = np.nonzero(failures.passed)
    assert failures.cell_m * rows.min() > 2.7
    assert failures.cell_m * columns.max() < 1.2
    assert failures.ended.sum() > 20
    assert failures.passed.sum() > 20
    assert np.nanmax(failures.share) == 1.0
    failures.save(tmp_path / "failures.npz")
    with np.load(tmp_path / "failures.npz") as file:
        assert np.array_equal(file["passed"], failures.passed)
        assert file["cell_m"] == failures.cell_m
    draw_failures(tmp_path / "picture.png", old, "run", failures.cell_m, failures.good, failures.ended, failures.passed)
    assert (tmp_path / "picture.png").stat().st_size > 10_000


@pytest.mark.slow
def test_the_localizers_own_poses_stand_in_for_a_reference() -> None:
    grid = floor_plan(12.0, 10.0, 0.05, 3)
    path = random_walk(grid, 12, 1)
    run = simulate(grid, path, Lidar(beams=360, angle_min=-math.pi, angle_increment=math.pi / 180.0), SensorErrors(), WHEELS, 1)
    config = LocalizerConfig()
    pairs = list(own_poses(run.recording, grid, config))
    assert [step.index for step, _ in pairs] == [step.index for step in steps(run.recording, config.bounds.motion)]
    poses = [(pose, path[step.index]) for step, pose in pairs if pose is not None]
    assert len(poses) > 6
    assert all(math.hypot(pose.x - true.x, pose.y - true.y) < 0.5 for pose, true in poses)
