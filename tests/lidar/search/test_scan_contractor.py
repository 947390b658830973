from dataclasses import replace

import numpy as np
import pytest

from ial.contractors.boxes import Boxes
from ial.contractors.threads import set_threads
from ial.lidar.configuration.config import FreeSpace
from ial.lidar.evidence.beams import Beams, select_beams
from ial.lidar.search.scan_contractor import ScanContractor
from tests.lidar.twin import World

WORLDS = 600


def contractor(world: World, outliers: int) -> ScanContractor:
    return ScanContractor(world.beams(outliers), world.index())


def worlds(first: int = 0) -> list[tuple[World, np.random.Generator]]:
    made = []
    for seed in range(first, first + WORLDS):
        random = np.random.default_rng(seed)
        made.append((World.random(random), random))
    return made


@pytest.mark.slow
def test_a_box_with_a_consistent_pose_is_never_emptied() -> None:
    sharp = 0
    for seed, (world, random) in enumerate(worlds()):
        good = world.certainly_good()
        outliers = int((~good).sum())  # the fewest that the pose needs
        boxes = Boxes.concatenate([world.box_around(random) for _ in range(20)])
        assert contractor(world, outliers).fits(boxes).all(), f"world {seed}"
        sharp += outliers > 0 and not contractor(world, outliers - 1).fits(boxes).all()
    assert sharp > 0.3 * WORLDS  # with one outlier less, the same boxes are often emptied: the twin is at the edge


@pytest.mark.slow
def test_contraction_keeps_every_consistent_pose() -> None:
    """Poses on the faces and corners of boxes too: where a box is not narrowed, its bounds keep their bits."""
    lost, narrowed = [], 0
    for seed, (world, random) in enumerate(worlds()):
        outliers = int((~world.certainly_good()).sum())
        boxes = Boxes.concatenate([world.box_around(random) for _ in range(20)])
        contracted = contractor(world, outliers).contract(boxes)
        at = np.array([world.pose.x, world.pose.y])
        inside = ((contracted.lower[:, :2] <= at) & (at <= contracted.upper[:, :2])).all(axis=1)
        lost += [(seed, row) for row in np.flatnonzero(~inside).tolist()]
        narrowed += int((contracted.width()[:, :2] < 0.9 * boxes.width()[:, :2]).any(axis=1).sum())
    assert not lost, f"{len(lost)} boxes lost the pose, such as (world, box) {lost[:5]}"
    assert narrowed > 0.1 * 20 * WORLDS


@pytest.mark.slow
def test_a_pose_at_which_too_many_beams_clearly_miss_is_emptied() -> None:
    emptied = 0
    for seed, (world, _) in enumerate(worlds()):
        bad = int(world.certainly_bad().sum())
        if bad:
            point = np.array([[world.pose.x, world.pose.y, world.pose.theta]])
            assert contractor(world, bad - 1).contract(Boxes(point, point)).empty.all(), f"world {seed}"
            emptied += 1
    assert emptied > 0.3 * WORLDS


@pytest.mark.slow
def test_a_box_from_all_of_which_too_many_beams_clearly_miss_is_emptied() -> None:
    emptied = 0
    for seed, (world, random) in enumerate(worlds()):
        half = random.uniform(0.0, [0.2, 0.2, 0.1])
        bad = int(world.certainly_bad(half[:2].max(), half[2]).sum())
        if bad:
            at = np.array([world.pose.x, world.pose.y, world.pose.theta])
            assert not contractor(world, bad - 1).fits(Boxes((at - half)[None], (at + half)[None])).any(), f"world {seed}"
            emptied += 1
    assert emptied > 0.1 * WORLDS


@pytest.mark.slow
@pytest.mark.parametrize("threads", [1, 2, 3])
def test_a_batch_says_of_each_box_what_the_box_alone_says(threads: int) -> None:
    world, random = worlds(17)[0]
    boxes = Boxes.concatenate([world.box_around(random) for _ in range(2000)])
    moved = random.uniform(-0.5, 0.5, (len(boxes), 3))
    boxes = Boxes(boxes.lower + moved, boxes.upper + moved)
    scan = contractor(world, len(world.hits()) // 3)
    set_threads(threads)
    try:
        together = scan.contract(boxes)
    finally:
        set_threads(None)
    alone = [scan.contract(boxes[[row]]) for row in range(len(boxes))]
    assert (together.lower == [box.lower[0] for box in alone]).all()
    assert (together.upper == [box.upper[0] for box in alone]).all()
    assert 0 < together.empty.sum() < len(boxes)


@pytest.mark.slow
def test_kept_boxes_are_returned_as_they_are_and_the_input_is_not_modified() -> None:
    world, random = worlds(5)[0]
    boxes = Boxes.concatenate([world.box_around(random) for _ in range(50)])
    lower, upper = boxes.lower.copy(), boxes.upper.copy()
    kept = contractor(world, len(world.hits())).contract(boxes)
    for one, other in ((kept.lower, lower), (kept.upper, upper), (boxes.lower, lower), (boxes.upper, upper)):
        assert (one == other).all()


def with_silent_beams(world: World, outliers: int, silent: int) -> Beams:
    """Return the evidence of a scan to which beams without return are added, which are used beams as well."""
    ranges = np.append(world.scan.ranges, np.full(silent, np.inf, dtype=np.float32))
    return select_beams(replace(world.scan, ranges=ranges), world.bounds, outliers, len(ranges), FreeSpace(no_return_m=1.0))


@pytest.mark.slow
def test_as_many_outliers_as_hits_leave_a_box_as_it_is_however_many_beams_are_used() -> None:
    lost, kept = [], 0
    for seed, (world, random) in enumerate(worlds()[:200]):
        hits, used = len(world.hits()), len(with_silent_beams(world, 0, 2))
        boxes = Boxes.concatenate([world.box_around(random) for _ in range(10)])
        boxes = Boxes(boxes.lower + random.uniform(-1.0, 1.0, (10, 1)), boxes.upper + 1.0)  # wherever the pose is
        assert used >= hits + 2
        for outliers in (hits, used - 1, used, 10**30):
            beams = with_silent_beams(world, outliers, 2)
            narrowed = ScanContractor(beams, world.index()).contract(boxes)
            if not (np.array_equal(narrowed.lower, boxes.lower) and np.array_equal(narrowed.upper, boxes.upper)):
                lost.append((seed, outliers))
            kept += 1
    assert not lost, f"{len(lost)} of {kept} calls changed a box, such as (world, outliers) {lost[:5]}"


@pytest.mark.slow
def test_silent_beams_change_nothing_where_fewer_may_be_bad_than_hits() -> None:
    narrowed = 0
    for world, random in worlds()[:200]:
        for outliers in range(0, len(world.hits()), 5):
            boxes = Boxes.concatenate([world.box_around(random) for _ in range(5)])
            plain = contractor(world, outliers).contract(boxes)
            with_silent = ScanContractor(with_silent_beams(world, outliers, 3), world.index()).contract(boxes)
            assert np.array_equal(with_silent.lower, plain.lower)
            assert np.array_equal(with_silent.upper, plain.upper)
            narrowed += not np.array_equal(with_silent.lower, boxes.lower)
    assert narrowed > 50


@pytest.mark.slow
def test_a_negative_number_of_outliers_is_refused() -> None:
    world = worlds()[0][0]
    with pytest.raises(ValueError, match="may be bad is -1"):
        world.beams(0).allowing(-1)
    with pytest.raises(TypeError):
        replace(world.beams(0), outliers=1.5)  # type: ignore[arg-type]


@pytest.mark.slow
def test_an_end_point_that_only_touches_a_cell_is_good() -> None:
    world = worlds()[0][0]
    mask = np.zeros((8, 8), dtype=np.bool_)
    mask[4, 4] = True
    index = type(world.index())(mask, 0.25)
    one = np.ones((1, 2))
    for at, touches in [
        ((1.0, 1.0), True),
        ((1.25, 1.25), True),
        ((1.0, 1.25), True),
        ((1.0 - 1e-6, 1.1), False),
        ((1.1, 1.25 + 1e-6), False),
    ]:
        beams = Beams(0.0 * one, one * [1.0, 0.0], 0.0 * one, 0)
        point = np.array([[*at, 0.0]])
        assert ScanContractor(beams, index).fits(Boxes(point, point))[0] == touches


@pytest.mark.slow
def test_a_box_too_far_away_for_the_table_is_kept() -> None:
    world = worlds()[0][0]
    for at in ((1e9, 0.0), (0.0, -1e9), (np.inf, np.inf)):
        point = np.array([[*at, 0.0]])
        assert contractor(world, 0).fits(Boxes(point, point)).all()
