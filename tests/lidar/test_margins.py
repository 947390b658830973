"""The localizer at the limits that its margins are proved for, against exact fractions: a beam that just touches a cell is never lost."""

import math
from dataclasses import replace
from fractions import Fraction

import mpmath
import numpy as np
import pytest

from ial.contractors.boxes import Boxes
from ial.datasets.scan import LaserScan, Mounting
from ial.errors import ConfigError, RecordingError
from ial.lidar.configuration.config import Bounds, FreeSpace, LocalizerConfig
from ial.lidar.estimate import radius
from ial.lidar.evidence.beams import Beams, select_beams
from ial.lidar.evidence.rays import Rays
from ial.lidar.margins import MARGIN, MOST_BEAMS, MOST_CELLS, MOST_PARTS
from ial.lidar.pose_set import PoseSet
from ial.lidar.search.bit_columns import BitColumns
from ial.lidar.search.cell_counts import count_cells
from ial.lidar.search.free_space import count_blocked
from ial.lidar.search.lattice import Lattice, divide
from ial.lidar.search.scan_contractor import ScanContractor
from ial.maps.grids.cell_index import CellIndex
from ial.maps.grids.occupancy_grid import OccupancyGrid
from ial.pose import Pose

RESOLUTIONS = [0.05, 0.0333, 1.0 / 3.0, 0.1, 0.07]
WIDE = 200  # columns of a table


def beam(reading: float) -> Beams:
    """One beam straight ahead, without any error."""
    return Beams(np.array([[reading, 0.0]]), np.array([[1.0, 0.0]]), np.zeros((1, 2)), 0)


def up(exact: Fraction) -> float:
    """The smallest double that is not below a number."""
    near = float(exact)
    return near if Fraction(near) >= exact else math.nextafter(near, math.inf)


class Row:
    """A row of cells of a long map that begins at some column, the last of which is occupied."""

    def __init__(self, resolution: float, split: int, first: int) -> None:
        self.width = Fraction(resolution) / split  # of a cell of the table, exactly
        mask = np.zeros((20, WIDE), dtype=np.bool_)
        mask[:, -1] = True
        whole = (20, first + WIDE)
        self.occupied = CellIndex(mask, resolution / split, origin=(0, first), whole=whole)
        self.domain = CellIndex(np.ones_like(mask), resolution / split, compact=True, origin=(0, first), whole=whole)
        self.edge = (first + WIDE - 1) * self.width


@pytest.mark.parametrize("resolution", RESOLUTIONS)
@pytest.mark.parametrize(("split", "first"), [(1, 0), (1, 65_536 - WIDE), (5, 65_536 - WIDE), (64, MOST_CELLS - WIDE)])
def test_a_beam_that_just_reaches_a_cell_fits_and_one_that_does_not_is_told_apart(resolution: float, split: int, first: int) -> None:
    random, row = np.random.default_rng(first + split), Row(resolution, split, first)
    for _ in range(100):
        x = float((first + Fraction(float(random.uniform(0.0, WIDE - 2.0)))) * row.width)
        reading = up(row.edge - Fraction(x))
        for theta in (0.0, float(random.uniform(-3.0, 0.0))):
            at = Boxes.of([(x, x), (float(3 * row.width), float(4 * row.width)), (theta, 0.0)])
            contractor = ScanContractor(beam(reading), row.occupied)
            assert contractor.fits(at)[0]
            assert contractor.contract(at).contain([x, at.lower[0, 1], 0.0])[0]
        short = reading - float(3.0 * MARGIN * row.width)
        assert not ScanContractor(beam(short), row.occupied).fits(at[[0]] if theta == 0.0 else Boxes.of([(x, x), (0.1, 0.2), (0.0, 0.0)]))[
            0
        ]


@pytest.mark.parametrize("resolution", RESOLUTIONS)
@pytest.mark.parametrize("first", [0, 8192, 65_536 - WIDE, MOST_CELLS - WIDE])
def test_the_last_point_of_a_cell_of_the_lattice_is_not_lost(resolution: float, first: int) -> None:
    """Cells of the lattice are a little wider than those of the table: on a long map they lie more and more beside them."""
    split, parts = divide(resolution, 2.0 * resolution / 64.0 if first > 65_536 else 2.0 * resolution)
    random, row = np.random.default_rng(first), Row(resolution, split, first)
    lattice = Lattice(parts * row.occupied.cells.resolution, 0.1, parts)
    half = math.pi / lattice.layers
    for _ in range(50):
        x = lattice.position_m * int((first + random.integers(2, WIDE - 8)) // parts)  # the line between two cells of the lattice
        reading = up(row.edge - Fraction(x))
        y = 5.0 * lattice.part_m
        middle = Boxes.of([(x - 0.6 * lattice.position_m, x - 0.4 * lattice.position_m), (y, y), (-half, -half)])
        words, least = count_cells(lattice.bitmaps(middle), lattice, beam(reading), row.occupied, row.domain)
        assert words.any(), "the cell that ends at x holds a pose from which the beam just touches"
        assert least[words.any(axis=1)].min() == 0


@pytest.mark.parametrize("resolution", RESOLUTIONS)
def test_answers_of_a_part_of_a_map_are_those_of_the_whole(resolution: float) -> None:
    """How far cells of the lattice lie beside those of the table is the same in both, so beams that nearly touch decide alike."""
    random, lattice = np.random.default_rng(0), Lattice(2.0 * resolution, 0.1, 2)
    mask = np.zeros((20, 65_536), dtype=np.bool_)
    mask[:, 199] = True
    tables = [
        [CellIndex(cells[:, :columns], resolution, compact=cells is not mask, whole=mask.shape) for cells in (mask, np.ones_like(mask))]
        for columns in (65_536, 200)
    ]
    half, kept = math.pi / lattice.layers, 0
    for _ in range(100):
        x, y = lattice.position_m * int(random.integers(2, 90)), 5.0 * lattice.part_m
        reading = 199.0 * resolution - x - float(random.uniform(0.0, 0.01)) * resolution
        bitmaps = lattice.bitmaps(Boxes.of([(x - 0.6 * lattice.position_m, x - 0.4 * lattice.position_m), (y, y), (-half, -half)]))
        (words, least), (part, fewest) = (count_cells(bitmaps, lattice, beam(reading), *each) for each in tables)
        assert np.array_equal(words, part)
        assert np.array_equal(least, fewest)
        kept += bool(words.any())
    assert 0 < kept < 100


@pytest.mark.parametrize("theta", [1e4, -1e4, 1.1e5, 1e9, math.inf])
def test_headings_far_from_0_lose_no_pose(theta: float) -> None:
    mask = np.zeros((40, 40), dtype=np.bool_)
    mask[20, 30] = True
    index = CellIndex(mask, 0.05)
    turned = mpmath.fmod(mpmath.mpf(theta), 2 * mpmath.pi) if math.isfinite(theta) else mpmath.mpf(0)
    end = [1.525 - 1.0, 1.025 - 1.0]  # of a beam, from (1, 1), in the frame of the map
    c, s = float(mpmath.cos(turned)), float(mpmath.sin(turned))
    beams = Beams(np.array([[c * end[0] + s * end[1], c * end[1] - s * end[0]]]), np.array([[1.0, 0.0]]), np.zeros((1, 2)), 0)
    bounds = (theta, theta) if math.isfinite(theta) else (-math.inf, math.inf)
    at = Boxes(np.array([[1.0, 1.0, bounds[0]]]), np.array([[1.0, 1.0, bounds[1]]]))
    contractor = ScanContractor(replace(beams, map_error_m=0.001), index)
    assert contractor.fits(at)[0]
    assert not contractor.contract(at).empty[0]


def test_a_ray_is_never_longer_than_its_reading_allows() -> None:
    """Where errors are nearly as large as the reading, little is left of it, and rounding is no small part of that."""
    random = np.random.default_rng(4)
    left = 0
    for _ in range(300):
        reading = np.float32(random.uniform(1.0, 100.0))
        range_error = float(random.uniform(0.01, 0.1))
        margin = (float(reading) - range_error) - float(10.0 ** random.uniform(-12.0, -5.0))
        bounds, free = Bounds(range_error, 0.0, 0.0), FreeSpace(margin_m=margin, no_return_m=float(reading))
        beams = select_beams(LaserScan(0, np.array([reading, np.inf], np.float32), 0.0, 0.1), bounds, 0, 10, free)
        assert beams.rays is not None
        slack = Fraction(float(np.spacing(reading))) / 2
        exact = Fraction(float(reading)) - Fraction(range_error) - Fraction(margin)
        assert Fraction(float(beams.rays.lengths[0])) <= exact - slack
        assert Fraction(float(beams.rays.lengths[1])) <= exact
        left += beams.rays.lengths[1] > 0.0
    assert left > 100


@pytest.mark.parametrize("start", [0.0, 1e4, -1e4, 4.9e4])
@pytest.mark.parametrize("aside", [0.3, 1e6])
def test_end_points_of_beams_that_begin_far_from_0_lie_in_their_regions(start: float, aside: float) -> None:
    random = np.random.default_rng(5)
    with mpmath.workdps(50):
        for _ in range(30):
            mounting = Mounting(*random.uniform(-aside, aside, 2).tolist(), float(random.uniform(-4.0, 4.0)), bool(random.integers(2)))
            scan = LaserScan(0, random.uniform(0.1, 80.0, 40), start, float(random.choice([-0.1, 0.07])), mounting=mounting)
            beams = select_beams(scan, Bounds(0.0, 0.0), 0, 40)
            for i in range(0, 40, 7):
                bearing = mpmath.mpf(scan.angle_min) + i * mpmath.mpf(scan.angle_increment)
                angle = mpmath.mpf(mounting.yaw) + (-bearing if mounting.upside_down else bearing)
                reading = mpmath.mpf(float(scan.ranges[i]))
                dx = mounting.x + reading * mpmath.cos(angle) - mpmath.mpf(float(beams.ends[i, 0]))
                dy = mounting.y + reading * mpmath.sin(angle) - mpmath.mpf(float(beams.ends[i, 1]))
                cx, cy = (mpmath.mpf(float(value)) for value in beams.directions[i])
                assert abs(cx * dx + cy * dy) <= beams.errors[i, 0]
                assert abs(cx * dy - cy * dx) <= beams.errors[i, 1]


@pytest.mark.parametrize("yaw", [0.0, 0.7, 1e4])
def test_the_radius_around_a_pose_reaches_the_farthest_corner_of_a_map_far_away(yaw: float) -> None:
    random, grid = np.random.default_rng(7), OccupancyGrid(np.zeros((10, 65_536), np.uint8), 0.0333, Pose(1e6, -1e6, yaw))
    with mpmath.workdps(50):
        c, s = mpmath.cos(mpmath.mpf(yaw)), mpmath.sin(mpmath.mpf(yaw))
        for _ in range(100):
            lower = random.uniform(0.0, 2000.0, (3, 3))
            boxes = Boxes(lower, lower + random.uniform(0.0, 0.1, (3, 3)))
            pose = grid.pose_to_map(Pose(*boxes.midpoint()[0].tolist()))
            farthest = mpmath.mpf(0)
            for x, y in (
                (x, y) for low, high in zip(boxes.lower, boxes.upper, strict=True) for x in (low[0], high[0]) for y in (low[1], high[1])
            ):
                at_x, at_y = grid.origin.x + c * float(x) - s * float(y), grid.origin.y + s * float(x) + c * float(y)
                farthest = max(farthest, mpmath.hypot(at_x - pose.x, at_y - pose.y))
            assert farthest <= radius(PoseSet(boxes), pose, grid) <= farthest * (1.0 + 1e-6) + 1e-8


def test_a_laser_that_is_far_from_its_robot_sees_nothing_blocked() -> None:
    """Where lines of a map are told apart by rounding only, a wall in the way is no proof."""
    mask = np.zeros((60, 60), dtype=np.bool_)
    mask[:, 30] = True
    index, bits = CellIndex(mask, 0.05), BitColumns(mask)
    at = Boxes.of([(0.5, 0.52), (1.5, 1.52), (0.0, 0.0)])
    for away, blocked in ((0.0, 1), (1e6, 0)):
        one = np.ones(1)
        rays = Rays(np.array([[-away, 0.0]]), 0.0 * one, 1e-9 * one, (2.0 + away) * one, np.array([-1]), 0.02 * one)
        beams = Beams(np.empty((0, 2)), np.empty((0, 2)), np.empty((0, 2)), 0, rays)
        assert count_blocked(at, np.zeros(1, np.int16), beams, 2, index, bits).tolist() == [blocked]


def test_what_cannot_be_counted_is_refused_where_it_is_asked_for() -> None:
    assert divide(0.05, MOST_PARTS * 0.05) == (1, MOST_PARTS)
    with pytest.raises(ConfigError, match=r"position_m is 6\.45 m, 129 cells of the map \(0\.05 m each\); give at most 6\.4 m"):
        divide(0.05, 6.45)
    for wrong in ({"max_beams": MOST_BEAMS + 1}, {"free_space": MOST_BEAMS + 1}):
        with pytest.raises(ConfigError, match=f"is {MOST_BEAMS + 1}: give a whole number from 1 to {MOST_BEAMS}"):
            LocalizerConfig(max_beams=wrong["max_beams"]) if "max_beams" in wrong else FreeSpace(max_rays=wrong["free_space"])
    with pytest.raises(RecordingError, match="thousands of turns"):
        LaserScan(0, np.ones(3), 0.0, 5e4)
