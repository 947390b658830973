"""Blocked rays against the slow twin: many rays of many poses, each cast through the map by itself."""

import math
from dataclasses import replace

import numpy as np
import pytest

from ial.contractors.boxes import Boxes
from ial.datasets.scan import LaserScan, Mounting
from ial.lidar.configuration.config import Bounds, FreeSpace, LocalizerConfig, Precision
from ial.lidar.evidence.beams import scan_beams, select_beams
from ial.lidar.localizer import Localizer
from ial.lidar.search.bit_columns import BitColumns
from ial.lidar.search.free_space import BlockingCells, blocked, count_blocked
from ial.maps.grids.cell_index import CellIndex
from ial.maps.grids.floor_plan import floor_plan
from ial.maps.grids.occupancy_grid import FREE, OCCUPIED
from ial.maps.grids.ray_casting import cast_rays
from ial.pose import Pose
from ial.study.good_beams import bad_beams
from ial.study.obstacles import Obstacles
from ial.study.used_beams import UsedBeams

NO_LASER_OFFSET = (0.0, 0.0, 0.0, 0.0)


def is_blocked(mask: np.ndarray, box: tuple[float, ...], low: float, high: float, length: float, margin: float) -> bool:
    index, bits = CellIndex(mask, 1.0), BitColumns(mask)
    ray = (math.cos(low), math.sin(low), math.cos(high), math.sin(high), length)
    return bool(blocked(box, NO_LASER_OFFSET, ray, margin, BlockingCells(index.cells, bits.upwards, bits.rightwards)))


def random_mask(random: np.random.Generator) -> np.ndarray:
    """Return walls, straight, oblique, thin or thick, with gaps, and scattered cells."""
    rows, columns = (int(each) for each in random.integers(20, 150, 2))
    mask = random.random((rows, columns)) < random.choice([0.0, 0.0, 0.01, 0.1])
    for _ in range(int(random.integers(1, 8))):
        start, stop = random.uniform(0, [columns, rows], (2, 2))
        steps = int(2 * np.abs(stop - start).max()) + 2
        for share in np.linspace(0.0, 1.0, steps):
            column, row = (start + share * (stop - start)).astype(int)
            mask[row : row + int(random.integers(1, 3)), column] = True
    return mask


@pytest.mark.slow
def test_every_ray_of_a_blocked_strip_meets_a_cell() -> None:
    barred = tried = 0
    for seed in range(3000):
        random = np.random.default_rng(seed)
        mask = random_mask(random)
        rows, columns = mask.shape
        corner = random.uniform(-10.0, [columns + 10.0, rows + 10.0])
        size = random.choice([0.0, 0.3, 1.0, 3.0], 2)
        box = (*corner, *(corner + size))
        low = random.uniform(-math.pi, math.pi)
        high = low + random.choice([0.0, 0.005, 0.02, 0.1])
        length, margin = random.uniform(0.0, 150.0), float(random.choice([0.0, 0.5, 2.0]))
        tried += 1
        if not is_blocked(mask, box, low, high, length, margin):
            continue
        barred += 1
        count = 200
        ends = random.integers(0, 2, (4, count)).astype(float)
        inside = random.random((4, count))
        share = np.where(random.random((4, count)) < 0.3, ends, inside)
        angle = low + share[0] * (high - low)
        aside = margin * (2.0 * share[1] - 1.0)
        x = box[0] + share[2] * size[0] - aside * np.sin(angle)
        y = box[1] + share[3] * size[1] + aside * np.cos(angle)
        distance = cast_rays(mask, 1.0, x, y, angle)
        assert (distance <= length + 1e-6).all(), f"seed {seed}: a ray gets {distance.max()} cells far"
    assert barred > 0.15 * tried


@pytest.mark.parametrize("turn", [0.0, 0.3, 0.7, math.pi / 4, 1.2, math.pi / 2, 2.5, math.pi, -2.0, -math.pi / 2])
def test_a_wall_across_blocks_and_a_gap_does_not(turn: float) -> None:
    """A wall one cell thick, seen from every side; then with a gap as wide as the strip."""
    rows, columns = np.mgrid[0:200, 0:200] - 100.0
    along = columns * math.cos(turn) + rows * math.sin(turn)
    across = -columns * math.sin(turn) + rows * math.cos(turn)
    wall = (np.abs(along - 40.0) <= 0.75) & (np.abs(across) < 30.0)
    box = (99.5, 99.5, 100.5, 100.5)
    seen = (turn - 0.006, turn + 0.006)
    assert is_blocked(wall, box, *seen, 60.0, 1.0)
    assert not is_blocked(wall, box, *seen, 38.0, 1.0)
    assert not is_blocked(wall & (np.abs(across) > 4.0), box, *seen, 60.0, 1.0)
    assert not is_blocked(wall, box, *(turn + math.pi + each for each in (-0.006, 0.006)), 60.0, 1.0)


def test_blocked_beams_and_beams_without_return_count_once_each() -> None:
    grid = floor_plan(8.0, 6.0, 0.05, 2)
    mask = grid.mask(OCCUPIED)
    index, bits = CellIndex(mask, 0.05), BitColumns(mask)
    angles = np.linspace(-3.0, 3.0, 60)
    x, y = next((column * 0.05, row * 0.05) for row, column in np.argwhere(~mask)[2000:])
    ranges = cast_rays(mask, 0.05, x, y, angles)
    ranges[:10] += 3.0  # behind the wall
    ranges[10:15] = np.inf
    scan = LaserScan(0, ranges, -3.0, float(angles[1] - angles[0]), mounting=Mounting())
    bounds, free = Bounds(0.02, 0.0, 0.02), FreeSpace(use=True, margin_m=0.02, no_return_m=30.0)
    beams = select_beams(scan, bounds, 5, 180, free)
    assert beams.rays is not None
    assert (len(beams), (beams.rays.beams < 0).sum()) == (60, 5)
    box = Boxes.of([(x - 0.01, x + 0.01), (y - 0.01, y + 0.01), (-0.002, 0.002)])
    hits = select_beams(scan, bounds, 5, 180)
    (bad,) = count_blocked(box, np.zeros(1, np.int16), beams, 2, index, bits)
    (short,) = count_blocked(
        box, np.zeros(1, np.int16), select_beams(scan, bounds, 5, 180, FreeSpace(True, 0.02, 180, 0.05)), 2, index, bits
    )
    assert len(hits) == 55
    assert 12 <= bad <= 15  # ten behind a wall, bad once each although some end in a cell, and five that see through walls
    assert bad - 5 == short  # beams without return that claim nothing beyond 5 cm are blocked nowhere


def test_an_endless_ray_and_a_bearing_that_may_be_anything_are_bounded() -> None:
    grid = floor_plan(8.0, 6.0, 0.05, 2)
    mask = grid.mask(OCCUPIED)
    index, bits = CellIndex(mask, 0.05), BitColumns(mask)
    box = Boxes.of([(3.0, 3.05), (3.0, 3.05), (0.0, 0.01)])
    far = LaserScan(0, np.array([3e38, 5.0], np.float32), 0.1, 1.0)
    blind = np.zeros(1, np.int16)
    beams = select_beams(far, Bounds(), 0, 180, FreeSpace())
    assert count_blocked(box, blind, beams, 2, index, bits)[0] >= 1
    wall = np.zeros((200, 200), dtype=np.bool_)
    wall[:, 5] = True  # on one side only: rays into most directions are free, although both ends of their interval point at it
    open_side, seen = (CellIndex(wall, 0.05), BitColumns(wall)), Boxes.of([(1.0, 1.01), (5.0, 5.01), (0.0, 0.01)])
    for bearing, error, count in ((0.0, 2.7, 0), (math.pi, 0.05, 1), (math.pi, 6.0, 0)):
        beams = select_beams(LaserScan(0, np.array([50.0], np.float32), bearing, 1.0), Bounds(0.0, error, 50.0), 0, 180, FreeSpace())
        assert count_blocked(seen, blind, beams, 2, *open_side).tolist() == [count]


@pytest.mark.slow
@pytest.mark.parametrize("outliers", [0, 3, 29, "auto"])
def test_a_scan_of_beams_without_return_alone_keeps_every_consistent_pose(outliers: int | str) -> None:
    grid = floor_plan(8.0, 6.0, 0.1, 4)
    free_space = FreeSpace(margin_m=0.05, no_return_m=0.8)
    config = LocalizerConfig(Bounds(0.02, 0.0, 0.0), outliers, free_space=free_space, precision=Precision(0.3, 0.2))  # type: ignore[arg-type]
    scan = LaserScan(0, np.full(30, np.inf, dtype=np.float32), -math.pi, math.pi / 15.0, range_max=2.0)
    estimate = Localizer(grid, config=config).locate(scan)
    beams = scan_beams(scan, config)
    assert (len(beams), len(beams.ends), estimate.beams) == (30, 0, 30)
    assert estimate.status == "ambiguous"
    poses = np.random.default_rng(0).uniform(0.0, (8.0, 6.0, 6.2), (600, 3))
    poses = poses[grid.cells[tuple((poses[:, 1::-1] / 0.1).astype(int).T)] == FREE]
    consistent = bad_beams(UsedBeams.of(scan, config), poses, Obstacles(grid)) <= estimate.outliers_allowed
    contained = np.array([estimate.poses.contains(Pose(*pose)) for pose in poses.tolist()])
    assert consistent.sum() > 100
    assert contained[consistent].all()
    assert outliers == 29 or (~contained).sum() > 20


@pytest.mark.parametrize(
    ("bearing", "range_error", "margin", "reading", "count"),
    [
        (0.0, 0.4, 0.02, 3.35, 0),  # a good beam: it may have met the face of the wall
        (0.0, 0.4, 0.02, 3.6, 1),
        (0.0, 0.1, 0.3, 3.35, 0),
        (0.0, 0.1, 0.3, 3.9, 1),
        (0.785, 0.1, 0.5, 5.25, 0),  # the ray meets the wall in time, and the last one beside it does not
        (0.785, 0.1, 0.5, 6.0, 1),
        (-0.5, 0.4, 0.5, 4.55, 0),
        (-0.5, 0.4, 0.5, 5.2, 1),
    ],
)
def test_a_ray_ends_before_the_wall_by_the_error_and_by_the_margin(
    bearing: float, range_error: float, margin: float, reading: float, count: int
) -> None:
    """A wall that begins 3 m ahead and has no end: the ray beside that meets it last tells, by the definition."""
    assert count == ((3.0 + margin * math.sin(abs(bearing))) / math.cos(bearing) <= reading - range_error - margin)
    wall = np.zeros((240, 200), dtype=np.bool_)
    wall[:, 100:] = True
    scan = LaserScan(0, np.array([reading], np.float32), bearing, 0.1)
    beams = select_beams(scan, Bounds(range_error, 0.0, 0.0), 0, 180, FreeSpace(True, margin))
    box = Boxes.of([(2.0, 2.0), (6.0, 6.0), (0.0, 1e-9)])
    bad = count_blocked(box, np.zeros(1, np.int16), beams, 2, CellIndex(wall, 0.05), BitColumns(wall))
    assert bad.tolist() == [count]


@pytest.mark.parametrize("bearing", [0.0, 1.6, -2.5])
@pytest.mark.parametrize("aside", [-0.08, 0.08])
def test_a_ray_that_passes_a_gap_at_some_bearing_or_heading_is_not_blocked(bearing: float, aside: float) -> None:
    """A wall 4 m away, all around, with a gap at an angle that only the error of the bearing, or the width of the box, reaches."""
    rows, columns = np.mgrid[0:240, 0:240] - 119.5
    turn = np.angle(np.exp(1j * (np.arctan2(rows, columns) - bearing - aside)))
    wall = np.abs(np.hypot(rows, columns) - 80.0) <= 2.0
    index, bits = CellIndex(wall & (np.abs(turn) > 0.03), 0.05), BitColumns(wall & (np.abs(turn) > 0.03))
    beams = {
        error: select_beams(LaserScan(0, np.array([5.5], np.float32), bearing, 0.1), Bounds(0.0, error, 0.0), 0, 1, FreeSpace(True, 0.01))
        for error in (0.0, 0.04, 0.1)
    }

    def count(error: float, low: float, high: float) -> int:
        box = Boxes.of([(6.0, 6.0), (6.0, 6.0), (low, high)])
        return int(count_blocked(box, np.zeros(1, np.int16), replace(beams[error], map_error_m=1.0), 2, index, bits)[0])

    assert count(0.0, -1e-9, 1e-9) == count(0.04, -1e-9, 1e-9) == count(0.0, -0.04, 0.04) == 1
    assert count(0.1, -1e-9, 1e-9) == count(0.0, min(aside, 0.0), max(aside, 0.0)) == 0
