import math

import pytest

from ial.datasets.recording import steps
from ial.datasets.simulator import Lidar, SensorErrors, simulate
from ial.datasets.walk import random_walk
from ial.lidar.configuration.config import LocalizerConfig
from ial.maps.grids.floor_plan import floor_plan
from ial.study.reference import own_poses
from tests.study.test_bounds_survey import WHEELS


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
