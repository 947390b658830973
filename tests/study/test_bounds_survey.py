import json
from dataclasses import replace

import numpy as np
import pytest

from ial.datasets.motion import ErrorBound, MotionBounds
from ial.datasets.simulator import Lidar, SensorErrors, simulate
from ial.datasets.walk import random_walk
from ial.lidar.configuration.config import Bounds, LocalizerConfig
from ial.maps.grids.floor_plan import floor_plan
from ial.maps.grids.occupancy_grid import OccupancyGrid
from ial.pose import Pose
from ial.study.bounds_survey import OUTLIERS, TOTALS_M, BoundsSurvey
from ial.study.reference import reference_poses

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


@pytest.mark.slow
def test_the_suggestion_holds() -> None:
    grid = floor_plan(12.0, 10.0, 0.05, 4)
    wrong = LocalizerConfig(bounds=Bounds(0.01, 0.0, 0.0, MotionBounds(ErrorBound(0.01, 0.01), ErrorBound(0.2, 0.2))))
    suggestion = survey_of(grid, wrong, 2, outliers=12).suggestion()
    assert suggestion.bounds.range_error_m + suggestion.bounds.map_error_m == pytest.approx(0.05)
    again = survey_of(grid, suggestion, 2, outliers=12).record()
    assert again["motion"]["held"] >= 0.98
    assert suggestion.bounds.motion.rotation.per_message < 0.2
    assert suggestion.bounds.motion.translation.per_message > 0.01


def test_bounds_of_beams_stay_as_they_are_where_no_total_is_kept() -> None:
    grid = floor_plan(12.0, 10.0, 0.05, 4)
    loose = MotionBounds(ErrorBound(0.06, 0.04, 0.04), ErrorBound(0.04, 0.02, 0.1))
    config = LocalizerConfig(bounds=Bounds(0.02, 0.0, 0.04, loose), max_outliers=0.25)
    kept, broken = (survey_of(grid, config, 2, outliers, scans=10) for outliers in (4, 60))
    assert kept.total_m() == kept.record()["suggested_total_m"] == 0.05
    assert kept.suggestion().bounds.map_error_m == 0.03
    assert broken.held()[-1, OUTLIERS.index(0.1)] < 0.95
    assert broken.total_m() is broken.record()["suggested_total_m"] is None
    suggestion = broken.suggestion()
    assert suggestion.bounds.motion != loose
    assert replace(suggestion, bounds=replace(suggestion.bounds, motion=loose)) == config
