import math
from dataclasses import replace

import numpy as np
import pytest

from ial.contractors.boxes import Boxes
from ial.datasets.in_memory import InMemoryRecording
from ial.datasets.motion import ErrorBound, MotionBounds
from ial.datasets.odometry import Odometry
from ial.datasets.recording import Reading, steps
from ial.datasets.scan import LaserScan
from ial.datasets.simulator import Lidar, SensorErrors, Simulation, simulate
from ial.datasets.walk import random_walk
from ial.errors import RecordingError
from ial.lidar.configuration.config import Bounds, FreeSpace, LocalizerConfig, Precision
from ial.lidar.localizer import Localizer
from ial.lidar.run import localize
from ial.maps.grids.floor_plan import floor_plan
from ial.pose import Pose

MOTION = MotionBounds(ErrorBound(0.05, 0.1, 0.0), ErrorBound(0.03, 0.0, 0.1))
CONFIG = LocalizerConfig(bounds=Bounds(0.03, 0.0, 0.01, MOTION), outliers=2, precision=Precision(0.2, 0.1))
GRID = floor_plan(6.0, 5.0, 0.05, 4)
LIDAR = Lidar(beams=60, angle_min=-math.pi, angle_increment=math.pi / 30.0)


@pytest.fixture(scope="module")
def simulation() -> Simulation:
    path = random_walk(GRID, 8, 5, step_m=0.2, turn_rad=0.3)
    return simulate(GRID, path, LIDAR, SensorErrors(0.03, 0.0, 2), MOTION, 0)


def test_every_scan_is_localized_with_the_motion_since_the_last(simulation: Simulation) -> None:
    answers = list(localize(simulation.recording, Localizer(GRID, config=CONFIG)))
    assert [step.index for step, _ in answers] == list(range(8))
    byhand = Localizer(GRID, config=CONFIG)
    for (step, estimate), expected in zip(answers, steps(simulation.recording, MOTION), strict=True):
        assert step.stamp_ns == estimate.stamp_ns == expected.stamp_ns
        assert estimate.poses.boxes.lower.tobytes() == byhand.update(expected.motion, expected.scan).poses.boxes.lower.tobytes()
        truth = simulation.truth.at(step.stamp_ns)
        assert truth is not None
        assert estimate.poses.contains(truth)


def test_a_part_of_the_scans_is_chosen_like_a_slice(simulation: Simulation) -> None:
    answers = list(localize(simulation.recording, Localizer(GRID, config=CONFIG), start=1, stop=7, every=2))
    assert [step.index for step, _ in answers] == [1, 3, 5]
    assert answers[0][0].motion is None
    for step, estimate in answers:
        truth = simulation.truth.at(step.stamp_ns)
        assert truth is not None
        assert estimate.poses.contains(truth)


def test_static_localizes_each_scan_by_itself(simulation: Simulation) -> None:
    localizer = Localizer(GRID, config=CONFIG)
    for step, estimate in localize(simulation.recording, localizer, static=True):
        alone = Localizer(GRID, config=CONFIG).locate(step.scan)
        assert estimate.poses.boxes.lower.tobytes() == alone.poses.boxes.lower.tobytes()
    assert localizer.poses is localizer.model.universe()


def test_a_recording_without_the_chosen_scans_is_refused(simulation: Simulation) -> None:
    with pytest.raises(RecordingError, match="no scan"):
        list(localize(simulation.recording, Localizer(GRID, config=CONFIG), start=100))


def test_a_start_that_is_given_is_used(simulation: Simulation) -> None:
    truth = simulation.truth[0]
    region = Boxes.of([(truth.x - 0.2, truth.x + 0.2), (truth.y - 0.2, truth.y + 0.2), (truth.theta - 0.2, truth.theta + 0.2)])
    _, first = next(localize(simulation.recording, Localizer(GRID, config=CONFIG, initial=region)))
    assert first.status == "localized"


def test_a_recording_in_which_no_beam_returns_is_usable_only_where_such_beams_are_used() -> None:
    scans = [LaserScan(stamp, np.full(30, np.inf, dtype=np.float32), -3.0, 0.2, range_max=1.0) for stamp in (1, 2)]
    recording = InMemoryRecording("an open place", [Reading(i, scan.stamp_ns, Odometry.of(Pose()), scan) for i, scan in enumerate(scans)])
    used = replace(CONFIG, free_space=FreeSpace(no_return_m=0.5))
    assert [estimate.uninformative for _, estimate in localize(recording, Localizer(GRID, config=used))] == [False, False]
    for free_space in (FreeSpace(), FreeSpace(use=False, no_return_m=0.5)):
        with pytest.raises(RecordingError, match="usable beam"):
            list(localize(recording, Localizer(GRID, config=replace(CONFIG, free_space=free_space))))
