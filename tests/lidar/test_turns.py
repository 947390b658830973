"""Intervals of headings of any turn, at every border: what comes out is as if they had been given in the form of the definition."""

import math
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from ial.contractors.boxes import Boxes
from ial.contractors.intervals.trigonometric import PI_UPPER
from ial.contractors.paving.clusters import cluster
from ial.contractors.paving.paver import pave
from ial.datasets.mark import Mark
from ial.datasets.motion import Motion
from ial.datasets.odometry import Odometry
from ial.datasets.scan import LaserScan
from ial.lidar.checkpoint import Checkpoint, fingerprint
from ial.lidar.configuration.config import Bounds, LocalizerConfig, Precision
from ial.lidar.estimate import Estimate
from ial.lidar.evidence.beams import Beams, scan_beams
from ial.lidar.localizer import Localizer
from ial.lidar.model import LidarModel
from ial.lidar.pose_set import PoseSet
from ial.lidar.search.lattice import Lattice
from ial.lidar.search.pose_contractor import PoseContractor
from ial.lidar.search.prediction import move
from ial.lidar.search.scan_contractor import ScanContractor
from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, OccupancyGrid
from ial.maps.grids.ray_casting import cast_rays
from ial.pose import Pose

CONFIG = LocalizerConfig(bounds=Bounds(0.02, 0.0, 0.01), outliers=0, precision=Precision(0.2, 0.1))
TRUTH = Pose(1.53, 0.87, 3.0)
STILL = Motion(np.full(3, -0.01), np.full(3, 0.01))
TURNS = (-20_000, -100, -2, -1, 0, 1, 2, 100, 20_000)  # beyond 16,000 the sine of an interval of angles is not known any more
NAN = Boxes(np.array([[1.0, 0.5, np.nan]]), np.array([[2.0, 1.5, 4.0]]))


@cache
def room() -> OccupancyGrid:
    """Return a room of 4 × 3 m without symmetry, whose frame is not turned."""
    cells = np.full((30, 40), FREE, dtype=np.uint8)
    cells[[0, -1], :] = cells[:, [0, -1]] = OCCUPIED
    cells[5:9, 28:33] = OCCUPIED
    return OccupancyGrid(cells, 0.1)


@cache
def scan() -> LaserScan:
    angles = np.linspace(-3.0, 3.0, 40)
    ranges = cast_rays(room().mask(OCCUPIED), 0.1, TRUTH.x, TRUTH.y, TRUTH.theta + angles) + 0.001
    return LaserScan(0, ranges, -3.0, float(angles[1] - angles[0]))


def beams() -> Beams:
    return replace(scan_beams(scan(), CONFIG), map_error_m=0.01)


def around(turns: float) -> Boxes:
    """Return a box around the truth, its headings [-3.4, -2.9] after a turn back, or another one away from there."""
    low, high = -3.4 + 2.0 * math.pi * turns, -2.9 + 2.0 * math.pi * turns
    return Boxes.of([(1.4, 1.7), (0.7, 1.0), (low, high)])


def assert_form(boxes: Boxes) -> None:
    width = boxes.upper[:, 2] - boxes.lower[:, 2]
    assert (np.abs(boxes.lower[:, 2]) <= PI_UPPER).all()
    assert (((width >= 0.0) & (width < 2.0 * math.pi)) | ((boxes.lower[:, 2] == -PI_UPPER) & (boxes.upper[:, 2] == PI_UPPER))).all()


def assert_found(estimate: Estimate) -> None:
    assert estimate.status == "localized"
    assert estimate.poses.contains(TRUTH)
    assert_form(estimate.poses.boxes)
    assert all(abs(each.theta[0]) <= PI_UPPER and each.theta[1] < each.theta[0] + 2.0 * math.pi for each in estimate.hypotheses)


@pytest.mark.parametrize("turns", TURNS)
def test_a_start_of_any_turn_holds_the_truth(turns: int) -> None:
    for localizer in (Localizer(room(), config=CONFIG, initial=around(turns)), Localizer(room(), config=CONFIG)):
        if localizer.start is localizer.model.universe():
            localizer.resume(PoseSet(around(turns)))
        assert_form(localizer.poses.boxes)
        nothing = replace(scan(), ranges=np.full(40, np.inf, dtype=np.float32))
        assert_form(localizer.update(None, nothing).poses.boxes)
        assert_found(localizer.update(STILL, scan()))


@pytest.mark.parametrize("angles", [(-np.inf, np.inf), (0.0, np.inf), (-4.0, 2.3), (-7.0, 7.0)])
def test_a_turn_or_more_is_the_full_circle(angles: tuple[float, float]) -> None:
    box = Boxes.of([(1.4, 1.7), (0.7, 1.0), angles])
    full = Boxes.of([(1.4, 1.7), (0.7, 1.0), (-PI_UPPER, PI_UPPER)])
    for turned in (room().boxes_to_grid(box), room().boxes_to_map(box), move(box, Motion.identity())):
        assert (turned.lower[0, 2], turned.upper[0, 2]) == (-PI_UPPER, PI_UPPER)
    model = LidarModel(room(), CONFIG)
    assert np.array_equal(model.within(box).boxes.lower, model.within(full).boxes.lower)
    assert ScanContractor(beams(), model.sections[0, 0].occupied).fits(box).all()


@pytest.mark.parametrize("turns", TURNS)
def test_every_operation_on_boxes_takes_any_turn(turns: int) -> None:
    model, box = LidarModel(room(), CONFIG), around(turns)
    for turned in (room().boxes_to_grid(box), room().boxes_to_map(box), move(box, STILL), model.lattice.cover(box, 1000)):
        assert_form(turned)
        assert PoseSet(turned).contains(TRUTH)
    assert model.within(box).contains(TRUTH)
    assert PoseSet(box).contains(TRUTH)
    few = model.lattice.few_bitmaps(box, 1000)
    assert few is not None
    assert np.array_equal(few.keys, model.lattice.bitmaps(box).keys)
    assert PoseSet(model.lattice.boxes(few)).contains(TRUTH)
    assert model.contract(PoseSet(box), beams()).contains(TRUTH)
    assert model.predict(PoseSet(box), STILL).contains(TRUTH)
    assert Motion(np.array([0.0, 0.0, box.lower[0, 2]]), np.array([1.0, 0.0, box.upper[0, 2]])).contains(Pose(0.5, 0.0, 3.0))


@pytest.mark.parametrize("turns", TURNS)
def test_a_contractor_keeps_the_truth_and_the_turn(turns: int) -> None:
    model = LidarModel(room(), CONFIG)
    tables = model.sections[0, 0]
    scan_only = ScanContractor(beams(), tables.occupied)
    for contractor in (scan_only, PoseContractor(beams(), tables.occupied, tables.domain)):
        box = around(turns)
        contracted = contractor.contract(box)
        assert np.array_equal(contracted.lower[:, 2], box.lower[:, 2])
        assert np.array_equal(contracted.upper[:, 2], box.upper[:, 2])
        assert (box.lower <= contracted.lower).all()
        assert (contracted.upper <= box.upper).all()
        assert PoseSet(contracted).contains(TRUTH)
    paved = pave(PoseContractor(beams(), tables.occupied, tables.domain), around(turns), 0.05).boxes
    assert PoseSet(paved).contains(TRUTH)
    assert len(paved) < 100
    both = Boxes.concatenate([paved, move(paved, STILL)])  # as they were given, and in the form
    assert len(cluster(both, circular=(2,))) == len(cluster(room().boxes_to_grid(both), circular=(2,))) == 1


def test_neighbours_of_different_turns_touch_and_their_hull_has_the_form() -> None:
    clusters = cluster(
        Boxes.of([(0, 1), (0, 1), (-3.4, -3.2)], [(0, 1), (0, 1), (2.5 - 4.0 * math.pi, 2.9 - 4.0 * math.pi)]), circular=(2,)
    )
    assert len(clusters) == 1
    assert_form(clusters.hulls)
    assert (clusters.hulls.lower[0, 2], clusters.hulls.upper[0, 2]) == pytest.approx((2.5, 2.0 * math.pi - 3.2))
    apart = cluster(Boxes.of([(0, 1), (0, 1), (-3.4, -3.2)], [(0, 1), (0, 1), (2.5, 2.8)]), circular=(2,))
    assert len(apart) == 2


def test_a_checkpoint_takes_any_turn_and_no_other_start(tmp_path: Path) -> None:
    localizer, mark = Localizer(room(), config=CONFIG, initial=around(0)), Mark(0, 0, Odometry.of(Pose()))
    Checkpoint(mark, PoseSet(around(-1)), None, fingerprint(localizer)).save(tmp_path / "state")
    checkpoint = Checkpoint.load(tmp_path / "state", Localizer(room(), config=CONFIG, initial=around(0)))
    assert checkpoint is not None
    assert_form(checkpoint.poses.boxes)
    assert checkpoint.poses.contains(TRUTH)
    assert fingerprint(Localizer(room(), config=CONFIG)) != fingerprint(localizer)


EMPTY_ROWS = Boxes(np.array([[np.inf] * 3, [1.0, 0.5, 0.3], [0.0, 0.0, 7.0]]), np.array([[-np.inf] * 3, [2.0, 1.5, 0.2], [1.0, 1.0, 7.1]]))


def test_empty_rows_stay_empty_rows_and_are_in_no_cell() -> None:
    tables = LidarModel(room(), CONFIG).sections[0, 0]
    everything = replace(beams(), outliers=40)
    before = EMPTY_ROWS.lower.copy(), EMPTY_ROWS.upper.copy()
    for rows in (
        room().boxes_to_grid(EMPTY_ROWS),
        room().boxes_to_map(EMPTY_ROWS),
        move(EMPTY_ROWS, STILL),
        move(EMPTY_ROWS, Motion.unknown()),
        ScanContractor(everything, tables.occupied).contract(EMPTY_ROWS),
        PoseContractor(everything, tables.occupied, tables.domain).contract(EMPTY_ROWS),
    ):
        assert rows.empty.tolist() == [True, True, False]
        assert (rows.lower[:2] == np.inf).all()
        assert (rows.upper[:2] == -np.inf).all()
    assert np.array_equal(EMPTY_ROWS.lower, before[0])
    assert np.array_equal(EMPTY_ROWS.upper, before[1])
    lattice = Lattice(0.2, 0.1)
    assert np.array_equal(lattice.cover(EMPTY_ROWS, 1000).lower, lattice.cover(EMPTY_ROWS[2:], 1000).lower)
    with pytest.raises(ValueError, match="box 0 of 3 is empty"):
        Localizer(room(), config=CONFIG).resume(PoseSet(EMPTY_ROWS))


@pytest.mark.parametrize(
    "use",
    [
        lambda tables: Localizer(room(), config=CONFIG, initial=NAN),
        lambda tables: Localizer(room(), config=CONFIG).resume(PoseSet(NAN)),
        lambda tables: LidarModel(room(), CONFIG).within(NAN),
        lambda tables: room().boxes_to_grid(NAN),
        lambda tables: room().boxes_to_map(NAN),
        lambda tables: move(NAN, STILL),
        lambda tables: Lattice(0.2, 0.1).cover(NAN, 100),
        lambda tables: cluster(NAN, circular=(2,)),
        lambda tables: ScanContractor(beams(), tables.occupied).fits(NAN),
        lambda tables: ScanContractor(beams(), tables.occupied).contract(NAN),
        lambda tables: PoseContractor(beams(), tables.occupied, tables.domain).contract(NAN),
    ],
)
def test_a_bound_that_is_no_number_is_refused(use: Callable[..., object]) -> None:
    with pytest.raises(ValueError, match="box 0 of 1 has a bound that is NaN"):
        use(LidarModel(room(), CONFIG).sections[0, 0])
