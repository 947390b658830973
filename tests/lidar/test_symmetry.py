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
from ial.lidar.images import are_images
from ial.lidar.localizer import Localizer
from ial.lidar.pose_set import PoseSet
from ial.lidar.run import localize
from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, UNKNOWN, OccupancyGrid
from ial.maps.grids.symmetry import symmetries
from ial.pose import Pose

MOTION = MotionBounds(ErrorBound(0.03, 0.1, 0.0), ErrorBound(0.02, 0.0, 0.1))
CONFIG = LocalizerConfig(bounds=Bounds(0.02, 0.0, 0.01, MOTION), outliers=2, precision=Precision(0.1, 0.05))
LIDAR = Lidar(beams=90, angle_min=-math.pi, angle_increment=math.pi / 45.0)
ORIGIN = Pose(12.0, -5.0, 0.7)


def hall(turns: int, feature: bool = False) -> OccupancyGrid:
    """Return a hall of 8 m a side with pillars that looks the same after each of so many turns; a feature in a corner breaks that."""
    cells = np.full((160, 160), FREE, dtype=np.uint8)
    cells[[0, -1], :] = cells[:, [0, -1]] = OCCUPIED
    pillars = np.zeros((160, 160), dtype=np.bool_)
    pillars[30:44, 50:58] = pillars[60:64, 20:40] = pillars[100:104, 20:24] = True
    for quarters in range(0, 4, 4 // turns):
        cells[np.rot90(pillars, quarters)] = OCCUPIED
    if feature:
        cells[120:140, 1:20] = OCCUPIED
    return OccupancyGrid(cells, 0.05, ORIGIN)


def symmetries_of(grid: OccupancyGrid) -> tuple[Pose, ...]:
    return symmetries(grid, (FREE,))


@pytest.mark.parametrize("turns", [1, 2, 4])
def test_quarter_turns_are_found_and_map_walls_onto_walls(turns: int) -> None:
    grid = hall(turns)
    symmetries = symmetries_of(grid)
    assert len(symmetries) == turns - 1
    rows, columns = np.nonzero(grid.mask(OCCUPIED))
    for turn in symmetries:
        for row, column in zip(rows[::97].tolist(), columns[::97].tolist(), strict=True):
            at = turn @ Pose((column + 0.5) * 0.05, (row + 0.5) * 0.05)
            assert grid.mask(OCCUPIED)[math.floor(at.y / 0.05), math.floor(at.x / 0.05)]


def test_a_feature_anywhere_or_an_empty_map_has_no_symmetry() -> None:
    assert symmetries_of(hall(4, feature=True)) == ()
    assert symmetries_of(OccupancyGrid(np.full((5, 7), UNKNOWN, dtype=np.uint8), 0.1)) == ()


def test_the_rotations_are_those_of_the_turned_arrays() -> None:
    random = np.random.default_rng(1)
    numbers = set()
    for _ in range(300):
        side, other = random.integers(1, 5, 2)
        shape = (side, side if random.random() < 0.7 else other)
        part = random.choice([FREE, OCCUPIED, UNKNOWN], shape, p=[0.4, 0.4, 0.2]).astype(np.uint8)
        if random.random() < 0.5:
            part = np.concatenate([part, np.rot90(part, 2)], axis=int(random.integers(2)))
        cells = np.full((part.shape[0] + 3, part.shape[1] + 2), UNKNOWN, dtype=np.uint8)
        cells[1:-2, 1:-1] = part
        grid = OccupancyGrid(cells, 1.0)
        rows, columns = (np.flatnonzero((cells != UNKNOWN).any(axis=axis)) for axis in (1, 0))
        expected: list[float] = []
        if len(rows):
            inner = cells[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]
            expected = [0.5 * math.pi * turns for turns in (1, 2, 3) if np.array_equal(np.rot90(inner, turns), inner)]
        symmetries = symmetries_of(grid)
        assert [each.theta % (2.0 * math.pi) for each in symmetries] == pytest.approx(expected)
        numbers.add(len(symmetries))
    assert numbers == {0, 1, 3}


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


TURN = Pose(8.0, 8.0) @ Pose(0.0, 0.0, math.pi)  # half a turn about (4, 4)
QUARTER = Pose(8.0, 0.0) @ Pose(0.0, 0.0, 0.5 * math.pi)


def at(pose: Pose, half: float = 0.1) -> list[tuple[float, float]]:
    return [(pose.x - half, pose.x + half), (pose.y - half, pose.y + half), (pose.theta - half, pose.theta + half)]


@pytest.mark.parametrize(
    ("boxes", "symmetries", "images"),
    [
        (Boxes.of(at(Pose(1.0, 2.0, 3.0)), at(TURN @ Pose(1.0, 2.0, 3.0))), (TURN,), True),
        (Boxes.of(at(Pose(1.0, 2.0, 3.0)), at(TURN @ Pose(1.1, 2.1, 3.1), 0.02)), (TURN,), True),  # they touch, and nothing else does
        (Boxes.of(at(Pose(1.0, 2.0, 3.0)), at(TURN @ Pose(1.3, 2.0, 3.0))), (TURN,), False),
        (Boxes.of(at(Pose(1.0, 2.0, 3.0)), at(TURN @ Pose(1.0, 2.0, 2.7))), (TURN,), False),
        (Boxes.of(at(Pose(1.0, 2.0, 3.0)), at(TURN @ Pose(1.0, 2.0, 3.0))), (), False),
        (Boxes.of(at(Pose(1.0, 2.0, 3.0))), (TURN,), False),
        (Boxes.none(3), (TURN,), False),
        # Two pairs of images, which no turn leads into each other; and a box that meets the images of two.
        (Boxes.of(*(at(turn @ Pose(x, 2.0, 3.0)) for x in (1.0, 3.0) for turn in (Pose(), TURN))), (TURN,), False),
        (
            Boxes.of(*(at(turn @ Pose(x, 2.0, 3.0)) for x in (1.0, 3.0) for turn in (Pose(), TURN))),
            (QUARTER, TURN, QUARTER @ TURN),
            False,
        ),
        (Boxes.of(at(Pose(1.0, 2.0, 3.0)), at(Pose(1.3, 2.0, 3.0)), at(TURN @ Pose(1.15, 2.0, 3.0), 0.3)), (QUARTER, TURN), False),
        (
            Boxes.of(*(at(turn @ Pose(1.0, 2.0, 3.0)) for turn in (Pose(), QUARTER, TURN, QUARTER @ TURN))),
            (QUARTER, TURN, QUARTER @ TURN),
            True,
        ),
        # Two hypotheses that lie around the middle, of both headings each, and no longer so if a piece lies beside one of them.
        (Boxes.of(*(at(turn @ Pose(4.0, 4.0, 3.0)) for turn in (Pose(), QUARTER))), (QUARTER, TURN, QUARTER @ TURN), False),
        (Boxes.of(*(at(turn @ Pose(4.0, 4.0, 3.0)) for turn in (Pose(), TURN))), (QUARTER, TURN, QUARTER @ TURN), True),
    ],
)
def test_images_are_what_meets_one_to_one(boxes: Boxes, symmetries: tuple[Pose, ...], images: bool) -> None:
    assert are_images(PoseSet(boxes), symmetries, 16.0) is images


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
