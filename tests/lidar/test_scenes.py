import numpy as np
import pytest

from ial.contractors.intervals.angle import contains_angle
from ial.datasets.recording import steps
from ial.lidar.estimate import Estimate
from ial.lidar.localizer import Localizer
from ial.pose import Pose
from tests.lidar.scenes import Scene, random_scene

STATIC, MOVING = 1000, 100
CHUNK = 50  # scenes a test, so that they can be shared among processes
SCANS = 6


def located(scene: Scene) -> Estimate:
    (reading,) = scene.recording.readings()
    return Localizer(scene.grid, config=scene.config).locate(reading.scan)


def holds(estimate: Estimate, truth: Pose, scene: Scene) -> bool:
    """Whether the scan was not rejected and the truth is in the set, both in its boxes and in the hull of a hypothesis."""
    hulls = [
        hypothesis.x[0] <= truth.x <= hypothesis.x[1]
        and hypothesis.y[0] <= truth.y <= hypothesis.y[1]
        and contains_angle(*hypothesis.theta, truth.theta)
        for hypothesis in estimate.hypotheses
    ]
    inside = estimate.poses.contains(scene.grid.origin.inverse() @ truth)
    return estimate.status not in ("lost", "blind") and inside and any(hulls)


@pytest.mark.slow
@pytest.mark.parametrize("first", range(0, STATIC, CHUNK))
def test_the_truth_is_in_the_answer_to_one_scan(first: int) -> None:
    failed = []
    for seed in range(first, first + CHUNK):
        scene = random_scene(seed)
        if not holds(located(scene), scene.path[0], scene):
            failed.append(seed)
    assert failed == []


@pytest.mark.slow
@pytest.mark.parametrize("first", range(0, MOVING, CHUNK))
def test_the_truth_stays_in_the_set_while_the_robot_moves(first: int) -> None:
    failed = []
    for seed in range(first, first + CHUNK):
        scene = random_scene(seed, SCANS)
        localizer = Localizer(scene.grid, config=scene.config)
        run = zip(steps(scene.recording, scene.config.bounds.motion), scene.path, strict=True)
        if not all(holds(localizer.update(step.motion, step.scan), truth, scene) for step, truth in run):
            failed.append(seed)
    assert failed == []


@pytest.mark.slow
def test_the_scenes_would_show_a_localizer_that_trusts_too_much() -> None:
    scenes = [random_scene(seed, excess=8.0) for seed in range(CHUNK)]
    kept = sum(holds(located(scene), scene.path[0], scene) for scene in scenes)
    assert kept < 0.6 * CHUNK


@pytest.mark.slow
def test_the_answers_are_small() -> None:
    shares = []
    for seed in range(CHUNK):
        scene = random_scene(seed)
        volume = 2.0 * np.pi * scene.grid.width_m * scene.grid.height_m
        shares.append(located(scene).poses.boxes.volume() / volume)
    assert np.median(shares) < 0.01
