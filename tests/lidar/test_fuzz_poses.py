"""No consistent pose is lost, whatever the robot undergoes; `bench/fuzz_poses.py` tries a hundred times as many.

Errors are planted, too: a fuzzer that finds nothing has to be able to find something.
"""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from ial.contractors.boxes import Boxes
from ial.lidar import Estimate, Localizer, PoseSet
from tests.lidar import pose_fuzzer
from tests.lidar.box_index import BoxIndex
from tests.lidar.fuzz_drives import MODES, random_drive
from tests.lidar.pose_fuzzer import ALL_MODES, Tally, fuzz

SLOW = {"sections"}  # the tables of a large map; bench/fuzz_poses.py has them


def fuzzed(mode: str, poses: int) -> Tally:
    tally, seed = Tally(), 1000
    while tally.tried < poses and not tally.losses:
        fuzz(mode, seed, tally, effort=60)
        seed += 1
    return tally


@pytest.mark.slow
@pytest.mark.parametrize("mode", [mode for mode in ALL_MODES if mode not in SLOW])
def test_no_consistent_pose_is_lost(mode: str) -> None:
    tally = fuzzed(mode, 1000)
    assert not tally.losses, f"{len(tally.losses)}, such as {tally.losses[0]}"
    assert not tally.wrong
    assert tally.drives > 0


def without_a_box(estimate: Estimate) -> Estimate:
    poses = estimate.poses
    return replace(estimate, poses=PoseSet(poses.boxes[:-1], poses.unconfirmed[:-1], poses.limited, bad=poses.bad[:-1]))


def with_one_more(estimate: Estimate) -> Estimate:
    return replace(estimate, outliers_allowed=estimate.outliers_allowed + 1)


def without_a_hypothesis(estimate: Estimate) -> Estimate:
    return replace(estimate, hypotheses=estimate.hypotheses[1:])


def with_half_the_radius(estimate: Estimate) -> Estimate:
    return replace(estimate, radius_m=estimate.radius_m and 0.5 * estimate.radius_m)


@pytest.mark.slow
@pytest.mark.parametrize("change", [without_a_box, with_one_more, without_a_hypothesis, with_half_the_radius])
def test_an_answer_that_claims_too_much_is_seen(change: Callable[[Estimate], Estimate], monkeypatch: pytest.MonkeyPatch) -> None:
    class Boaster(Localizer):
        def update(self, *given: Any) -> Estimate:
            return change(super().update(*given))

    monkeypatch.setattr(pose_fuzzer, "Localizer", Boaster)
    assert fuzzed("fine", 100_000).losses


@pytest.mark.parametrize("mode", MODES)
def test_a_drive_is_made_again_from_its_seed(mode: str) -> None:
    one, other = random_drive(mode, 7), random_drive(mode, 7)
    assert one.config == other.config
    for first, second in zip(one.moments, other.moments, strict=True):
        np.testing.assert_array_equal(first.scan.ranges, second.scan.ranges)
        np.testing.assert_array_equal(first.pose, second.pose)


def test_the_index_finds_what_a_look_at_every_box_finds() -> None:
    random = np.random.default_rng(0)
    for count in (0, 1, 200):
        lower = random.uniform(-3.0, 3.0, (count, 3))
        boxes = Boxes(lower, lower + random.choice([0.1, 1.0, 7.0], (count, 3)))
        turn = 2.0 * np.pi * random.integers(-1, 2, (count, 3)) * [0.0, 0.0, 1.0]
        inside = lower + random.uniform(0.01, 0.99, (count, 3)) * boxes.width() + turn
        poses = np.vstack([random.uniform(-4.0, 4.0, (500, 3)), inside])
        for margin in (0.0, 0.04):
            low, high = lower + margin, boxes.upper - margin
            headings = poses[:, None, 2, None] + 2.0 * np.pi * np.arange(-3, 4)
            turned = ((low[:, 2, None] <= headings) & (headings <= high[:, 2, None])).any(axis=2)
            places = ((low[:, :2] <= poses[:, None, :2]) & (poses[:, None, :2] <= high[:, :2])).all(axis=2)
            assert BoxIndex(boxes).contains(poses, margin).tolist() == (places & turned).any(axis=1).tolist()
