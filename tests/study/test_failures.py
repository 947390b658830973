import math
from pathlib import Path

import numpy as np

from ial.datasets.simulator import Lidar, SensorErrors, simulate
from ial.lidar.configuration.config import Bounds, FreeSpace, LocalizerConfig
from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, OccupancyGrid
from ial.pose import Pose
from ial.results.lidar.failure_picture import draw_failures
from ial.study.bounds_survey import BoundsSurvey
from ial.study.reference import reference_poses
from tests.study.test_bounds_survey import WHEELS


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
