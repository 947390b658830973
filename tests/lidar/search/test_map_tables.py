"""A map in sections gives the answers of the map in one piece."""

import itertools
import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from ial.contractors.boxes import Boxes
from ial.datasets.motion import ErrorBound, MotionBounds
from ial.datasets.recording import Step, steps
from ial.datasets.simulator import Lidar, SensorErrors, simulate
from ial.datasets.walk import random_walk
from ial.errors import ConfigError, MapError
from ial.lidar.configuration.config import Bounds, FreeSpace, LocalizerConfig, Precision
from ial.lidar.evidence.beams import Beams, scan_beams
from ial.lidar.localizer import Localizer
from ial.lidar.pose_set import PoseSet
from ial.lidar.search import map_tables
from ial.lidar.search.lattice import Lattice
from ial.lidar.search.map_tables import Sections
from ial.maps.grids.floor_plan import floor_plan
from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, OccupancyGrid
from ial.pose import Pose

MOTION = MotionBounds(ErrorBound(0.05, 0.1, 0.0), ErrorBound(0.03, 0.0, 0.1))
CONFIG = LocalizerConfig(bounds=Bounds(0.03, 0.0, 0.02, MOTION), precision=Precision(0.1, 0.05))
LIDAR = Lidar(beams=72, angle_min=-math.pi, angle_increment=math.pi / 36.0, range_max=8.0)


@pytest.fixture
def small_sections(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let maps of more than a few cells have sections of 6.4 m, and keep as few of them as possible."""
    monkeypatch.setattr(map_tables, "_ONE_SECTION", 100)
    monkeypatch.setattr(map_tables, "_SIDE", 128)
    monkeypatch.setattr(map_tables, "_KEPT", 1)


@cache
def world() -> OccupancyGrid:
    return floor_plan(22.0, 16.0, 0.05, 5)


@cache
def drive(seed: int) -> tuple[list[Pose], list[Step]]:
    """Return a drive that is interrupted: the robot is carried elsewhere after eight scans."""
    paths = [random_walk(world(), 8, seed + part, step_m=0.5, turn_rad=0.5) for part in (0, 1000)]
    driven: list[Step] = []
    for number, path in enumerate(paths):
        part = steps(simulate(world(), path, LIDAR, SensorErrors(0.03, 0.0, 4, adversarial=True), MOTION, seed).recording, MOTION)
        still = steps(simulate(world(), path[:1] * 2, LIDAR, SensorErrors(), MOTION, seed).recording, MOTION)
        standing = list(still)[1].motion
        driven += [
            Step(each.index, each.stamp_ns, each.motion or (standing if number else None), each.scan, each.odometry) for each in part
        ]
    return paths[0] + paths[1], driven


def named(poses: PoseSet) -> set[bytes]:
    bounds = np.hstack([poses.boxes.lower, poses.boxes.upper, poses.bad[:, None], poses.unconfirmed[:, None]]) + 0.0
    return {row.tobytes() for row in bounds}


@pytest.mark.slow
@pytest.mark.parametrize("outliers", [5, "auto"])
@pytest.mark.parametrize("seed", [1, 2, 3, 4])
def test_answers_do_not_depend_on_sections(seed: int, outliers: int | str, small_sections: None, monkeypatch: pytest.MonkeyPatch) -> None:
    in_sections = Localizer(world(), outliers=outliers, config=CONFIG)  # type: ignore[arg-type]
    monkeypatch.setattr(map_tables, "_ONE_SECTION", 1 << 26)
    whole = Localizer(world(), outliers=outliers, config=CONFIG)  # type: ignore[arg-type]
    assert whole.model.sections.one
    assert len(in_sections.model.universe()) == 12
    assert [len(each.model.sections.universe) for each in (whole, in_sections)] == [1, 12]
    statuses = []
    for pose, step in zip(*drive(seed), strict=True):
        expected, estimate = whole.update(step.motion, step.scan), in_sections.update(step.motion, step.scan)
        assert named(estimate.poses) == named(expected.poses)
        assert estimate.poses.contains(world().pose_to_grid(pose))
        assert (estimate.status, len(estimate.hypotheses), estimate.outliers_allowed) == (
            expected.status,
            len(expected.hypotheses),
            expected.outliers_allowed,
        )
        statuses.append(estimate.status)
        assert in_sections.locate(step.scan).poses.boxes.volume() == pytest.approx(whole.locate(step.scan).poses.boxes.volume())
    assert "lost" in statuses
    assert len(in_sections.model.sections._made) == 4


def test_a_hypothesis_that_lies_in_several_sections_is_refined_in_each(small_sections: None) -> None:
    config = replace(CONFIG, precision=Precision(0.1, 0.05, halvings=2))
    localizer = Localizer(world(), config=config)
    border = 64 * localizer.model.lattice.position_m
    path = [Pose(border - 0.03 + 0.01 * number, 2.0, 0.1 * number) for number in range(6)]
    assert all(localizer.model.in_domain(pose) for pose in path)
    recording = simulate(world(), path, LIDAR, SensorErrors(0.03, 0.0, 4), MOTION, 1).recording
    across = 0
    for pose, step in zip(path, steps(recording, MOTION), strict=True):
        estimate = localizer.update(step.motion, step.scan)
        assert estimate.poses.contains(world().pose_to_grid(pose))
        across += len(list(localizer.model.sections.parts(localizer.poses.boxes))) > 1
        assert estimate.poses.boxes.volume() < localizer.poses.boxes.volume()
    assert across >= 3


def test_a_limit_leaves_a_coarser_answer_with_the_truth_in_it(small_sections: None) -> None:
    config = LocalizerConfig(bounds=CONFIG.bounds, outliers=5, max_boxes=300)
    localizer = Localizer(world(), config=config)
    pose, step = drive(1)[0][0], drive(1)[1][0]
    estimate = localizer.update(None, step.scan)
    assert estimate.limited == "boxes"
    assert len(estimate.poses) <= 2 * 300
    assert estimate.poses.contains(world().pose_to_grid(pose))


def test_a_section_holds_every_end_of_a_beam(small_sections: None) -> None:
    model = Localizer(world(), config=CONFIG).model
    for pose, step in zip(*drive(2), strict=True):
        beams = scan_beams(step.scan, CONFIG)
        model.sections.reach(beams)
        ((key, _, _),) = list(model.sections.parts(Boxes.of([(pose.x, pose.x), (pose.y, pose.y), (0.0, 0.0)])))
        occupied = model.sections[key].occupied
        far = np.hypot(*beams.ends.T).max() + 0.05
        rows, columns = (size - 1 for size in occupied.cells.table.shape)
        low_row, low_column = occupied.cells.origin
        for low, size, at, cells in ((low_row, rows, pose.y, world().rows), (low_column, columns, pose.x, world().columns)):
            assert low == 0 or low * 0.05 <= at - far
            assert low + size == cells or (low + size) * 0.05 >= at + far


def test_parts_cover_their_boxes_and_lie_in_the_cores(small_sections: None) -> None:
    lattice = Lattice(0.1, 0.05, 2)
    parts = Sections(world(), (FREE,), 1, lattice)
    side = 64 * lattice.position_m
    random = np.random.default_rng(0)
    low = random.uniform([-1.0, -1.0, -3.0], [22.0, 16.0, 3.0], (500, 3))
    low[:100, :2] = np.round(low[:100, :2] / side) * side  # on the borders, exactly
    high = low + random.uniform(0.0, 9.0, (500, 3)) * random.integers(0, 2, (500, 3))
    low[80:100, :2] = np.nextafter(low[80:100, :2], -1.0)
    high[50:80, :2] = low[50:80, :2] + side
    high[80:90, :2] = np.nextafter(np.round(high[80:90, :2] / side) * side, 99.0)
    boxes = Boxes(low, high)
    points = low + random.random((500, 3)) * (high - low)
    points[::3] = low[::3]
    points[1::3] = high[1::3]
    held = np.zeros(500, dtype=np.bool_)
    numbers = np.zeros(500, dtype=np.int64)
    for (row, column), rows, cut in parts.parts(boxes):
        core = np.array([[column * side, row * side], [(column + 1) * side, (row + 1) * side]])
        assert (cut.lower[:, :2] >= core[0]).all()
        assert (cut.upper[:, :2] <= core[1]).all()
        assert (cut.lower <= cut.upper).all()
        held[rows] |= ((cut.lower <= points[rows]) & (points[rows] <= cut.upper)).all(axis=1)
        numbers[rows] += 1
    on_map = ((points[:, :2] >= 0.0) & (points[:, :2] <= [22.0, 16.0])).all(axis=1)
    assert held[on_map].all()
    assert on_map.sum() > 300
    exact = (low[50:80, :2] >= 0.0).all(axis=1) & (high[50:80, :2] <= [22.0, 16.0]).all(axis=1)
    assert (numbers[50:80][exact] == 1).all()  # a box that is a core belongs to no neighbour


@pytest.mark.slow
def test_a_radius_is_kept_in_sections_as_in_one_piece(small_sections: None, monkeypatch: pytest.MonkeyPatch) -> None:
    config = LocalizerConfig(bounds=CONFIG.bounds, robot_radius_m=0.4)
    in_sections = Localizer(world(), config=config)
    monkeypatch.setattr(map_tables, "_ONE_SECTION", 1 << 26)
    whole = Localizer(world(), config=config)
    at = np.random.default_rng(3).uniform([0.0, 0.0], [22.0, 16.0], (2000, 2))
    answers = [[each.model.in_domain(Pose(x, y)) for x, y in at.tolist()] for each in (in_sections, whole)]
    assert answers[0] == answers[1]
    assert 0.1 < np.mean(answers[0]) < 0.9


@pytest.mark.parametrize("radius", [0.05, 0.1, 0.15, 0.23, 0.3])
def test_a_cell_is_left_out_only_if_an_obstacle_is_too_near_from_everywhere_in_it(radius: float) -> None:
    cells = np.full((24, 30), FREE, dtype=np.uint8)
    cells[np.random.default_rng(3).random(cells.shape) < 0.03] = OCCUPIED
    parts = Sections(OccupancyGrid(cells, 0.1), (FREE,), 1, Lattice(0.2, 0.5, 2), radius_m=radius)
    row, column = (0.1 * each for each in np.nonzero(cells == OCCUPIED))
    left_out = 0
    for at in np.argwhere(cells == FREE):
        y, x = (0.1 * (each + share.ravel()) for each, share in zip(at, np.mgrid[0:5, 0:5] / 4.0, strict=True))
        inside = Boxes.of([(float(x[12]), float(x[12])), (float(y[12]), float(y[12]))])
        if not parts[0, 0].domain.meet(inside)[0]:
            dx = np.maximum(np.maximum(column - x[:, None], x[:, None] - column - 0.1), 0.0)
            dy = np.maximum(np.maximum(row - y[:, None], y[:, None] - row - 0.1), 0.0)
            assert np.hypot(dx, dy).min(axis=1).max() <= radius + 1e-12
            left_out += 1
    assert left_out > 0 or radius <= 0.1


def test_a_robot_that_fits_nowhere_is_refused(small_sections: None) -> None:
    with pytest.raises(MapError, match="fits nowhere"):
        Localizer(world(), config=LocalizerConfig(robot_radius_m=6.0))


def test_beams_that_reach_across_the_map_are_no_trouble(small_sections: None) -> None:
    cells = np.full((300, 300), FREE, dtype=np.uint8)
    cells[[0, -1], :] = cells[:, [0, -1]] = OCCUPIED
    model = Localizer(OccupancyGrid(cells, 0.05), config=CONFIG).model
    ends = np.array([[14.0, 0.0], [0.0, 14.0]])
    model.sections.reach(Beams(ends, ends / 14.0, np.zeros((2, 2)), 0, map_error_m=0.01))
    assert model.sections[0, 0].occupied.cells.table.shape == (301, 301)


@pytest.mark.slow
def test_answers_do_not_depend_on_sections_where_beams_without_return_see_farther_than_others(
    small_sections: None, monkeypatch: pytest.MonkeyPatch
) -> None:
    config = replace(CONFIG, outliers=4, precision=Precision(0.2, 0.1, 0), free_space=FreeSpace(margin_m=0.05, no_return_m=20.0))
    blocked = 0
    for pose, step in itertools.islice(zip(*drive(1), strict=True), 0, None, 3):
        hits = np.where((step.scan.ranges > 1.0) & np.isfinite(step.scan.ranges), np.nan, step.scan.ranges)
        scan = replace(step.scan, ranges=np.where(step.scan.ranges > 4.0, np.inf, hits))
        beams = scan_beams(scan, config)
        assert beams.rays is not None
        assert beams.rays.lengths.max() > 3.0 * np.hypot(*beams.ends.T).max()
        region = Boxes.of([(pose.x - 1.0, pose.x + 1.0), (pose.y - 1.0, pose.y + 1.0), (pose.theta, pose.theta + 0.3)])
        answers = []
        for cells, using in ((100, config), (1 << 26, config), (1 << 26, replace(config, free_space=FreeSpace(use=False)))):
            monkeypatch.setattr(map_tables, "_ONE_SECTION", cells)
            answers.append(Localizer(world(), config=using, initial=region).update(None, scan).poses)
        assert named(answers[0]) == named(answers[1])
        blocked += len(answers[1]) < len(answers[2])
    assert blocked >= 2, "rays that tell nothing prove nothing"


def corridor(rows: int, columns: int, resolution: float) -> OccupancyGrid:
    """A closed corridor of so many cells, along the longer side of which walls stand in from either side, irregularly."""
    cells = np.full((rows, columns), FREE, dtype=np.uint8)
    cells[[0, -1], :] = cells[:, [0, -1]] = OCCUPIED
    along = cells if columns >= rows else cells.T
    random = np.random.default_rng(0)
    for first in range(20, along.shape[1] - 20, 20):
        width, depth = random.integers(2, 12), random.integers(1, 4)
        side = slice(1, 1 + depth) if random.integers(2) else slice(-1 - depth, -1)
        along[side, first + random.integers(8) :][:, :width] = OCCUPIED
    return OccupancyGrid(cells, resolution)


@pytest.mark.parametrize(
    ("rows", "columns", "resolution", "position", "one"),
    [
        (10, 20_000, 0.05, 0.02, False),
        (20_000, 10, 0.05, 0.02, False),
        (10, 65_536, 0.05, 0.1, True),
        (65_536, 10, 0.0333, 0.02, False),
        (10, 32_768, 0.05, 0.05, True),
        (10, 32_769, 0.05, 0.05, False),
    ],
)
def test_a_robot_is_found_near_the_end_of_a_long_map_however_its_cells_are_split(
    rows: int, columns: int, resolution: float, position: float, one: bool
) -> None:
    grid = corridor(rows, columns, resolution)
    far, middle, wide = (max(rows, columns) - 45.0) * resolution, 5.1 * resolution, 10.0 * resolution
    searched = (far - 25.0, far + 2.0)
    pose, region = Pose(far, middle), Boxes.of([searched, (0.0, wide), (-0.1, 0.1)])
    if rows > columns:
        pose, region = Pose(middle, far, 1.57), Boxes.of([(0.0, wide), searched, (1.47, 1.67)])
    bounds = Bounds(0.005, 0.001, 0.005, MOTION)
    config = LocalizerConfig(bounds=bounds, outliers=0, precision=Precision(position, 0.05, halvings=0))
    localizer = Localizer(grid, config=config, initial=region)
    assert localizer.model.sections.one is one
    lidar = Lidar(beams=40, angle_min=-math.pi, angle_increment=math.pi / 20.0, range_max=6.0)
    recording = simulate(grid, [pose, pose], lidar, SensorErrors(0.005, 0.001), MOTION, 1).recording
    for step in steps(recording, MOTION):
        poses = localizer.update(step.motion, step.scan).poses
        assert poses.contains(pose)
        assert (np.abs(poses.boxes.midpoint()[:, :2] - (pose.x, pose.y)) < 0.3).all()


@pytest.mark.parametrize(
    ("rows", "columns", "resolution", "position", "least"),
    [(10, 65_536, 0.05, 0.001, "0.00157"), (500, 500, 100.0, 0.01, "0.0367"), (65_536, 10, 1.0, 0.02, "0.0313")],
)
def test_a_precision_too_fine_for_the_map_is_refused_with_its_own_numbers(
    rows: int, columns: int, resolution: float, position: float, least: str
) -> None:
    grid = corridor(rows, columns, resolution)
    with pytest.raises(ConfigError) as refused:
        Localizer(grid, config=replace(CONFIG, precision=Precision(position)))
    text = str(refused.value)
    assert f"precision.position_m is {position:g} m" in text
    assert f"{columns} × {rows} cells of {resolution:g} m" in text
    assert f"give a precision.position_m of at least {least} m" in text
    Localizer(grid, config=replace(CONFIG, precision=Precision(float(least))))


def test_beams_that_reach_too_far_for_a_fine_precision_are_refused_with_theirs() -> None:
    model = Localizer(corridor(3000, 3000, 0.05), config=replace(CONFIG, precision=Precision(0.004))).model
    ends = np.array([[40.0, 0.0]])
    model.sections.reach(Beams(0.2 * ends, ends / 40.0, np.zeros((1, 2)), 0, map_error_m=0.01))
    with pytest.raises(ConfigError, match=r"0\.004 m, .* 3000 × 3000 cells of 0\.05 m .* 25 × 25 .* reach 40 m, .* at least 0\.\d+ m"):
        model.sections.reach(Beams(ends, ends / 40.0, np.zeros((1, 2)), 0, map_error_m=0.01))
