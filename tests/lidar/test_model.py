import math
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from ial.contractors.boxes import Boxes
from ial.contractors.intervals.trigonometric import PI_UPPER
from ial.contractors.paving.limits import Deadline
from ial.datasets.motion import Motion
from ial.datasets.scan import LaserScan
from ial.errors import ConfigError, MapError
from ial.lidar.configuration.config import Bounds, LocalizerConfig, Precision
from ial.lidar.evidence.beams import Beams, select_beams
from ial.lidar.model import LidarModel
from ial.lidar.pose_set import PoseSet, unite
from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, UNKNOWN, OccupancyGrid
from ial.maps.grids.ray_casting import cast_rays
from ial.membership import Recovery, Rejection, SetMembershipFilter
from ial.pose import Pose

CONFIG = LocalizerConfig(bounds=Bounds(0.02, 0.0, 0.01), outliers=0, precision=Precision(0.2, 0.1))
ANGLES = np.linspace(-3.0, 3.0, 40)
STEP = Motion(np.array([0.4, -0.05, 0.1]), np.array([0.6, 0.05, 0.2]))


def room() -> OccupancyGrid:
    """Return a room of 4 × 3 m without symmetry: a pillar, and a part that is unknown."""
    cells = np.full((30, 40), FREE, dtype=np.uint8)
    cells[[0, -1], :] = cells[:, [0, -1]] = OCCUPIED
    cells[5:9, 28:33] = OCCUPIED
    cells[20:29, 1:6] = UNKNOWN
    return OccupancyGrid(cells, 0.1)


def scan_at(pose: Pose, outliers: int = 0) -> Beams:
    ranges = cast_rays(room().mask(OCCUPIED), 0.1, pose.x, pose.y, pose.theta + ANGLES) + 0.001
    scan = LaserScan(0, ranges, -3.0, float(ANGLES[1] - ANGLES[0]))
    return select_beams(scan, CONFIG.bounds, outliers, 180)


def free_area(model: LidarModel, boxes: Boxes) -> bool:
    return bool(model.sections[0, 0].domain.meet(Boxes(boxes.lower[:, :2], boxes.upper[:, :2])).all())


TRUTH = Pose(1.53, 0.87, 0.7)
NOWHERE = Beams(np.array([[90.0, 0.0]]), np.array([[1.0, 0.0]]), np.zeros((1, 2)), 0)


def test_the_universe_holds_every_pose_of_the_map() -> None:
    poses = LidarModel(room(), CONFIG).universe()
    for pose in (Pose(), Pose(4.0, 3.0, math.pi), Pose(4.0, 0.0, -math.pi), TRUTH):
        assert poses.contains(pose)


def test_a_prediction_holds_the_moved_poses_that_lie_in_the_domain_and_nothing_outside_of_it() -> None:
    model, random = LidarModel(room(), CONFIG), np.random.default_rng(0)
    before = PoseSet(Boxes.of([(1.0, 1.2), (0.5, 2.5), (-0.5, 0.5)], [(3.0, 3.5), (1.0, 1.4), (3.0, 3.4)]))
    after = model.predict(before, STEP)
    assert free_area(model, after.boxes)
    inside = 0
    for _ in range(300):
        row = random.integers(2)
        start = Pose(*random.uniform(before.boxes.lower[row], before.boxes.upper[row]).tolist())
        end = start @ Pose(*random.uniform(STEP.lower, STEP.upper).tolist())
        if model.in_domain(end):
            inside += 1
            assert after.contains(end)
    assert inside > 100
    assert not after.contains(Pose(3.0, 0.7, 0.0))  # inside the pillar


def test_no_motion_before_the_first_scan() -> None:
    model = LidarModel(room(), CONFIG)
    assert model.predict(model.universe(), None) is model.universe()


def test_a_prediction_out_of_the_domain_is_empty() -> None:
    model = LidarModel(room(), CONFIG)
    far = Motion(np.array([50.0, -1.0, 0.0]), np.array([51.0, 1.0, 0.1]))
    assert model.empty(model.predict(PoseSet(Boxes.of([(1, 2), (1, 2), (0, 1)])), far))


def test_an_unknown_motion_leads_to_the_whole_domain() -> None:
    model = LidarModel(room(), CONFIG)
    after = model.predict(PoseSet(Boxes.of([(1, 1), (1, 1), (0, 0)])), Motion.unknown())
    for pose in (TRUTH, Pose(0.15, 0.15, math.pi), Pose(3.85, 2.85, -2.0)):
        assert after.contains(pose)


def test_flags_follow_the_boxes() -> None:
    model = LidarModel(room(), CONFIG)
    both = unite(PoseSet(Boxes.of([(1.0, 1.1), (1.0, 1.1), (0, 0.1)])), PoseSet(Boxes.of([(2.0, 2.1), (2.0, 2.1), (2, 2.1)])))
    after = model.predict(both, Motion.identity())
    assert 0 < after.unconfirmed.sum() < len(after)
    assert after.boxes[~after.unconfirmed].hull().upper[0, 0] < 1.5 < after.boxes[after.unconfirmed].hull().lower[0, 0]


def test_a_scan_keeps_the_truth_and_confirms_or_empties_each_part() -> None:
    model, beams = LidarModel(room(), CONFIG), scan_at(TRUTH)
    near = Boxes.of([(1.3, 1.7), (0.7, 1.1), (0.5, 0.9)])
    far = Boxes.of([(2.6, 2.8), (2.0, 2.4), (-2.0, -1.8)])
    static = model.contract(model.universe(), beams)
    assert static.contains(TRUTH)
    assert free_area(model, static.boxes)
    confirmed = model.contract(unite(PoseSet(far), PoseSet(near)), beams)  # the scan empties what was confirmed
    assert confirmed.contains(TRUTH)
    assert not confirmed.unconfirmed.any()
    dropped = model.contract(unite(PoseSet(near), PoseSet(far)), beams)
    assert dropped.contains(TRUTH)
    assert not dropped.unconfirmed.any()
    kept = model.contract(unite(PoseSet(static.boxes[:1]), PoseSet(static.boxes)), beams)
    assert kept.unconfirmed.tolist() == [False] + [True] * (len(static) - 1)  # what is in both parts is there once, as confirmed
    assert len(static) > 1
    assert model.empty(model.contract(PoseSet(far), beams))


def test_a_scan_that_can_exclude_nothing_returns_the_very_same_set() -> None:
    model = LidarModel(room(), CONFIG)
    poses = PoseSet(Boxes.of([(1, 2), (1, 2), (0, 1)]))
    nothing = Beams(np.empty((0, 2)), np.empty((0, 2)), np.empty((0, 2)), 0)
    assert model.contract(poses, nothing) is poses
    assert model.contract(poses, scan_at(TRUTH, outliers=40)) is poses
    assert model.contract(poses, replace(NOWHERE, outliers=1)) is poses


@pytest.mark.parametrize(("recovery", "union"), [("union", True), ("restart", False)])
def test_recovery_searches_the_whole_map_and_carries_the_prediction_or_not(recovery: Recovery, union: bool) -> None:
    before = PoseSet(Boxes.of([(2.6, 2.8), (2.0, 2.4), (-2.0, -1.8)]))
    again = SetMembershipFilter(LidarModel(room(), CONFIG), recovery, before)
    assert again.update(Motion.identity(), scan_at(TRUTH)) == Rejection(0)
    assert again.states.contains(TRUTH)
    assert again.states.contains(Pose(2.7, 2.2, -1.9)) == union
    assert again.states.unconfirmed.any() == union
    assert not again.states.unconfirmed.all()
    blind = SetMembershipFilter(LidarModel(room(), CONFIG), recovery, before)
    assert blind.update(Motion.identity(), NOWHERE) == Rejection(0)
    assert blind.states.contains(Pose(2.7, 2.2, -1.9))
    assert blind.states.unconfirmed.all()
    assert len(blind.states)


def test_recovery_does_not_search_the_whole_map_twice(monkeypatch: pytest.MonkeyPatch) -> None:
    model = LidarModel(room(), CONFIG)
    contract, calls = model.contract, []
    monkeypatch.setattr(model, "contract", lambda *given: calls.append(given) or contract(*given))
    blind = SetMembershipFilter(model)
    assert blind.update(None, NOWHERE) == Rejection(0)
    assert len(calls) == 1
    assert blind.states.unconfirmed.all()


@pytest.mark.parametrize(("domain", "unknown"), [("free", False), ("free_or_unknown", True)])
def test_the_domain_is_closed_cells_of_the_allowed_classes(domain: str, unknown: bool) -> None:
    model = LidarModel(room(), replace(CONFIG, domain=domain))
    assert model.in_domain(Pose(1.0, 1.0))
    assert model.in_domain(Pose(0.1, 1.0))  # the edge of the wall's cell belongs to its free neighbour, too
    assert not model.in_domain(Pose(0.05, 1.0))
    assert not model.in_domain(Pose(3.05, 0.7))
    assert model.in_domain(Pose(0.3, 2.4)) == unknown
    assert not model.in_domain(Pose(-1.0, 1.0))
    start = model.within(Boxes.of([(0.0, 4.0), (0.0, 3.0), (-PI_UPPER, PI_UPPER)]))
    assert start.contains(Pose(0.3, 2.4)) == unknown
    assert start.contains(TRUTH)
    assert not start.contains(Pose(3.05, 0.7))


def test_boxes_are_cut_to_the_map_and_not_inside_of_its_edge() -> None:
    rounded_down = 0
    for resolution in (0.1, 1.0 / 3.0, 0.0333, 0.07):
        for columns in range(3, 40):
            cells = np.full((2, columns), FREE, dtype=np.uint8)
            cells[0, 0] = OCCUPIED
            model = LidarModel(OccupancyGrid(cells, resolution), replace(CONFIG, precision=Precision(2.0 * resolution, 0.5)))
            edge = columns * Fraction(resolution)
            cut = model._within_map(Boxes.of([(-1.0, 99.0), (-1.0, 99.0), (0.0, 1.0)]))
            assert edge <= Fraction(float(cut.upper[0, 0])) <= edge + Fraction(1, 10**9)
            assert cut.lower[0].tolist() == [0.0, 0.0, 0.0]
            rounded_down += Fraction(columns * resolution) < edge
    assert rounded_down > 10  # doubles that are nearest to the edge and inside of it


def test_a_start_in_a_turned_map_is_given_in_the_map_frame() -> None:
    grid = replace(room(), origin=Pose(10.0, -5.0, 2.0))
    model, at = LidarModel(grid, CONFIG), grid.pose_to_map(TRUTH)
    start = model.within(Boxes.of([(at.x, at.x), (at.y, at.y), (at.theta, at.theta)]))
    assert start.contains(TRUTH)
    assert len(start) <= 16
    with pytest.raises(ConfigError, match="--initial"):
        model.within(Boxes.of([(TRUTH.x, TRUTH.x), (TRUTH.y, TRUTH.y), (0.0, 0.0)]))
    with pytest.raises(ConfigError, match="--initial"):
        model.within(Boxes.none(3))


def test_a_map_that_cannot_serve_is_refused() -> None:
    cells = np.full((5, 5), UNKNOWN, dtype=np.uint8)
    cells[2, 2] = OCCUPIED
    with pytest.raises(MapError, match="no free cell"):
        LidarModel(OccupancyGrid(cells, 0.1), CONFIG)
    LidarModel(OccupancyGrid(cells, 0.1), replace(CONFIG, domain="free_or_unknown"))


def test_limits_are_passed_on() -> None:
    model = LidarModel(room(), replace(CONFIG, max_boxes=5))
    limited = model.contract(model.universe(), scan_at(TRUTH))
    assert limited.limited == "boxes"
    assert len(limited) <= 5
    assert limited.contains(TRUTH)
    timed = LidarModel(room(), CONFIG)
    assert timed.contract(timed.universe(), replace(scan_at(TRUTH), deadline=Deadline(1e-9))).limited == "time"
