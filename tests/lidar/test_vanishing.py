"""An answer of which hardly anything is left says so."""

import math
from collections.abc import Iterator
from dataclasses import replace
from itertools import product
from pathlib import Path

import numpy as np
import pytest

from ial.contractors.boxes import Boxes
from ial.datasets.motion import Motion
from ial.datasets.opening import open_recording
from ial.datasets.recording import steps
from ial.datasets.simulator import Lidar, SensorErrors, simulate
from ial.datasets.walk import random_walk
from ial.lidar.atlas import Atlas
from ial.lidar.configuration.config import Bounds, LocalizerConfig, Precision
from ial.lidar.estimate import Estimate
from ial.lidar.evidence.beams import scan_beams
from ial.lidar.localizer import Localizer
from ial.lidar.pose_set import PoseSet
from ial.lidar.run import localize
from ial.lidar.vanishing import is_vanishing, leeway
from ial.maps.grids.floor_plan import floor_plan
from ial.maps.grids.map_file import read_map
from ial.pose import Pose
from ial.study.good_beams import bad_beams
from ial.study.obstacles import Obstacles
from ial.study.used_beams import UsedBeams

GRID = floor_plan(9.0, 7.0, 0.05, 3)
LIDAR = Lidar(beams=72, angle_min=-math.pi, angle_increment=math.pi / 36.0)
CONFIG = LocalizerConfig(Bounds(0.03, 0.0, 0.03), 4, precision=Precision(0.1, 0.05, 4))
AT = Pose(4.5, 3.5, 0.3)
SCAN = next(simulate(GRID, [AT], LIDAR, SensorErrors(0.0, 0.0, 0), CONFIG.bounds.motion, 1).recording.readings()).scan


def test_the_leeway_is_what_the_errors_leave_open() -> None:
    beams = scan_beams(SCAN, CONFIG)
    distance = float(np.hypot(*beams.ends.T).mean())
    assert leeway(beams) == pytest.approx(0.12**2 * 2.0 * 0.06 / distance, rel=1e-3)
    assert leeway(replace(beams, map_error_m=0.06)) > leeway(beams)


def test_an_answer_with_room_is_not_vanishing_and_one_at_the_edge_of_its_bounds_is() -> None:
    whole = Localizer(GRID, config=CONFIG).locate(SCAN)
    assert not whole.vanishing
    edge = Boxes.of([(AT.x + 0.09, AT.x + 0.095), (AT.y, AT.y + 0.005), (AT.theta, AT.theta + 0.001)])
    beams = scan_beams(SCAN, CONFIG)
    assert is_vanishing([PoseSet(edge)], beams)
    assert is_vanishing([PoseSet(Boxes.none(3))], beams)
    assert not is_vanishing([PoseSet(edge), whole.poses], beams)


def test_what_is_coarse_or_only_predicted_is_not_called_so() -> None:
    edge, beams = Boxes.of([(0.0, 1e-6), (0.0, 1e-6), (0.0, 1e-6)]), scan_beams(SCAN, CONFIG)
    assert not is_vanishing([PoseSet(edge, limited="boxes")], beams)
    assert not is_vanishing([PoseSet(edge, np.array([True]))], beams)
    assert not is_vanishing([PoseSet(edge)], beams.allowing(len(beams)))


def test_a_tracked_robot_that_has_left_its_bounds_is_flagged() -> None:
    """The motion leads to where the scan just still fits: what is left has hardly any room."""
    flagged = localized = 0
    for far in np.linspace(0.05, 0.2, 16):
        localizer = Localizer(GRID, config=CONFIG, initial=Boxes.around([(AT.x, AT.y, AT.theta)], [0.01, 0.01, 0.01]))
        moved = Motion(np.array([far, -0.01, -0.01]), np.array([far + 0.02, 0.01, 0.01]))
        localizer.update(None, SCAN)
        estimate = localizer.update(moved, SCAN)
        flagged += estimate.vanishing
        localized += estimate.status == "localized"
    assert 0 < flagged < localized


@pytest.mark.slow
def test_what_is_refuted_piece_by_piece_is_rejected() -> None:
    """Cells are left, but none of their pieces: so the scan fits nowhere in the start, as a twin finds, too."""
    errors = SensorErrors(0.1, 0.02, 9, adversarial=True)  # more than the bounds allow
    start, refuted = Boxes.around([(AT.x, AT.y, AT.theta)], [0.2, 0.2, 0.1]), 0
    poses = np.random.default_rng(0).uniform(start.lower[0], start.upper[0], (300, 3))
    for seed, outliers in product(range(6), range(15, 22)):
        scan = next(simulate(GRID, [AT], LIDAR, errors, CONFIG.bounds.motion, seed).recording.readings()).scan
        config = replace(CONFIG, outliers=outliers, precision=Precision(0.05, 0.025, 3))
        localizer, beams = Localizer(GRID, config=config, initial=start), scan_beams(scan, config)
        cells = localizer.model.contract(localizer.poses, beams)
        if len(cells) and not len(localizer.model.refine(cells, beams)):
            refuted += 1
            assert (bad_beams(UsedBeams.of(scan, config), poses, Obstacles(GRID)) > outliers).all()
            assert localizer.update(None, scan).status in ("lost", "blind")
            restarted = Localizer(GRID, config=replace(config, recovery="restart"), initial=start).update(None, scan)
            assert restarted.status == "blind" or not restarted.poses.unconfirmed.any()
    assert refuted > 5


def drives(aside_m: float) -> Iterator[tuple[bool, Estimate, bool]]:
    """Yield the last answers of short drives: whether the truth is held, the estimate, and what an atlas says of it.

    The last motion is wrong by so much.
    """
    lidar = Lidar(beams=180, angle_min=-math.pi, angle_increment=math.pi / 90.0, range_max=25.0)
    wrong = np.array([0.0, aside_m, 0.0])
    for seed in range(10):
        world = floor_plan(15.0, 12.0, 0.05, seed)
        localizer, atlas = Localizer(world), Atlas({"here": world})
        path = random_walk(world, 4, seed, step_m=0.3, turn_rad=0.3)
        motion = localizer.config.bounds.motion
        for step in steps(simulate(world, path, lidar, SensorErrors(0.03, 0.005, 9, adversarial=True), motion, seed).recording, motion):
            moved = step.motion
            if moved is not None and step.index == 3:
                moved = Motion(moved.lower + wrong, moved.upper + wrong)
            estimate, everywhere = localizer.update(moved, step.scan), atlas.update(moved, step.scan)
        yield estimate.poses.contains(world.pose_to_grid(path[-1])), estimate, everywhere.vanishing


@pytest.mark.slow
def test_a_prediction_beside_the_truth_leaves_hardly_anything() -> None:
    answers = list(drives(0.6))
    missed = [estimate.vanishing for held, estimate, _ in answers if not held and estimate.status == "localized"]
    assert len(missed) > 4
    assert sum(missed) > 0.6 * len(missed)
    assert [estimate.vanishing for _, estimate, _ in answers] == [everywhere for _, _, everywhere in answers]


@pytest.mark.slow
def test_answers_seldom_vanish_while_all_bounds_hold() -> None:
    answers = list(drives(0.0))
    assert all(held for held, _, _ in answers)
    assert sum(estimate.vanishing for _, estimate, _ in answers) < 0.3 * len(answers)


def test_the_recorded_scan_that_asked_for_this(data_folder: Path) -> None:
    recording = open_recording(data_folder / "intel_lab" / "intel-corrected.log.gz")
    localizer = Localizer(read_map(data_folder / "intel_lab" / "map_even.yaml"))
    run = list(localize(recording, localizer, start=731, stop=770, every=2))
    assert [step.index for step, estimate in run if estimate.vanishing] == [761]
