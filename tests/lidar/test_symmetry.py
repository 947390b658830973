"""Maps that look the same after a rotation: every image of the truth stays possible, and the status says so."""

import math
from dataclasses import replace

import numpy as np
import pytest

from ial.contractors.boxes import Boxes
from ial.datasets.motion import ErrorBound, Motion, MotionBounds
from ial.datasets.recording import steps
from ial.datasets.simulator import Lidar, SensorErrors, simulate
from ial.datasets.walk import random_walk
from ial.lidar.configuration.config import Bounds, LocalizerConfig, Precision
from ial.lidar.localizer import Localizer
from ial.lidar.run import localize
from ial.pose import Pose
from tests.maps.grids.test_symmetry import ORIGIN, hall, symmetries_of

MOTION = MotionBounds(ErrorBound(0.03, 0.1, 0.0), ErrorBound(0.02, 0.0, 0.1))
CONFIG = LocalizerConfig(bounds=Bounds(0.02, 0.0, 0.01, MOTION), outliers=2, precision=Precision(0.1, 0.05))
LIDAR = Lidar(beams=90, angle_min=-math.pi, angle_increment=math.pi / 45.0)


@pytest.mark.parametrize("turns", [2, 4])
def test_all_images_stay_to_the_end(turns: int) -> None:
    grid = hall(turns)
    path = random_walk(grid, 12, 5, step_m=0.3, turn_rad=0.4)
    recording = simulate(grid, path, LIDAR, SensorErrors(0.02, 0.0, 2), MOTION, 0).recording
    images = [ORIGIN @ each @ ORIGIN.inverse() for each in symmetries_of(grid)]
    statuses = []
    for (_, estimate), pose in zip(localize(recording, Localizer(grid, config=CONFIG)), path, strict=True):
        for place in (pose, *(image @ pose for image in images)):
            assert estimate.poses.contains(grid.pose_to_grid(place))
        statuses.append(estimate.status)
        assert estimate.pose is None
    assert set(statuses[4:]) == {"symmetric"}


def test_nearly_symmetric_all_until_the_feature_is_seen_then_one_and_never_the_wrong_one_alone() -> None:
    grid = hall(2, feature=True)
    lidar = Lidar(beams=90, angle_min=-0.5 * math.pi, angle_increment=math.pi / 90.0, range_max=3.0)
    # From the image of the truth, at (2, 6), the feature could not be seen at first; while the robot turns it should come into view.
    path = [ORIGIN @ Pose(6.0, 2.0, math.pi - 0.25 * i) for i in range(13)]
    recording = simulate(grid, path, lidar, SensorErrors(0.02, 0.0, 2), MOTION, 0).recording
    counts = []
    for (_, estimate), pose in zip(localize(recording, Localizer(grid, config=CONFIG)), path, strict=True):
        assert estimate.poses.contains(grid.pose_to_grid(pose))
        assert estimate.status != "symmetric"
        counts.append(len(estimate.hypotheses))
    assert counts[1:3] == [2, 2]
    assert counts[-1] == 1


def two_regions(centre: Pose, wide: float, narrow: float) -> Boxes:
    """Return a wide region around a pose of the hall, and a narrow one around its image after half a turn."""
    image = Pose(8.0 - centre.x, 8.0 - centre.y, centre.theta + math.pi)
    rows = [
        [(at.x - half, at.x + half), (at.y - half, at.y + half), (at.theta - 0.05, at.theta + 0.05)]
        for at, half in ((centre, wide), (image, narrow))
    ]
    return hall(2).boxes_to_map(Boxes.of(*rows))


def test_regions_that_are_no_images_are_not_symmetric_and_the_next_scan_may_tell_them_apart() -> None:
    grid = hall(2)
    path = [ORIGIN @ Pose(6.0, 2.0 + 0.1 * i, 0.3) for i in range(2)]
    first, second = steps(simulate(grid, path, LIDAR, SensorErrors(0.02, 0.0, 2), MOTION, 0).recording, MOTION)
    nothing = replace(first.scan, ranges=np.full(LIDAR.beams, np.inf, dtype=np.float32))
    # The middles are images of each other to the last bit; the truth is in the wide region, and its image not in the narrow one.
    for outliers in (2, "auto"):
        localizer = Localizer(grid, config=replace(CONFIG, outliers=outliers), initial=two_regions(Pose(6.4, 1.6, 0.3), 0.5, 0.1))  # type: ignore[arg-type]
        statuses = [localizer.update(step.motion, scan).status for step, scan in ((first, nothing), (second, second.scan))]
        assert statuses == ["ambiguous", "localized"]


def test_a_start_in_a_part_of_the_map_and_a_set_of_unknown_origin_are_never_called_symmetric() -> None:
    """They may hold a pose and not its image by less than a cell; only all of the map is known to hold both."""
    grid = hall(2)
    (step,) = steps(simulate(grid, [ORIGIN @ Pose(6.0, 2.0, 0.3)], LIDAR, SensorErrors(0.02, 0.0, 2), MOTION, 0).recording, MOTION)
    localizer = Localizer(grid, config=CONFIG)
    assert localizer.update(None, step.scan).status == "symmetric"
    poses = localizer.poses
    localizer.resume(poses, same_start=True)
    assert localizer.update(Motion.identity(), step.scan).status == "symmetric"
    localizer.resume(poses)
    assert localizer.update(Motion.identity(), step.scan).status == "ambiguous"
    assert localizer.locate(step.scan).status == "symmetric"
    localizer.reset()
    assert localizer.update(None, step.scan).status == "symmetric"
    within = Localizer(grid, config=CONFIG, initial=two_regions(Pose(6.0, 2.0, 0.3), 0.2, 0.2))
    assert within.update(None, step.scan).status == "ambiguous"
    assert within.locate(step.scan).status == "ambiguous"


def test_whatever_a_scan_leaves_of_a_symmetric_answer_the_images_of_the_truth_are_in_it() -> None:
    """The claim of the word: from a scan that is called symmetric on, no later answer that holds the truth lacks an image."""
    called = 0
    for seed in range(4):
        grid = hall(2 if seed % 2 else 4)
        path = random_walk(grid, 8, seed, step_m=0.3, turn_rad=0.4)
        recording = simulate(grid, path, LIDAR, SensorErrors(0.02, 0.0, 2), MOTION, seed).recording
        symmetric = False
        for (_, estimate), pose in zip(localize(recording, Localizer(grid, config=replace(CONFIG, outliers="auto"))), path, strict=True):
            symmetric = symmetric or estimate.status == "symmetric"
            called += symmetric
            truth = grid.pose_to_grid(pose)
            if symmetric and estimate.poses.contains(truth):
                assert all(estimate.poses.contains(turn @ truth) for turn in symmetries_of(grid))
    assert called > 16
