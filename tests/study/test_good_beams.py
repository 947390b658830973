import math

import numpy as np
import pytest

from ial.datasets.scan import LaserScan, Mounting
from ial.lidar.configuration.config import Bounds, FreeSpace, LocalizerConfig
from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, UNKNOWN, OccupancyGrid
from ial.study.blocked_rays import blocked_rays
from ial.study.good_beams import bad_beams, good_beams
from ial.study.obstacles import Obstacles
from ial.study.used_beams import UsedBeams
from tests.study.scans import Case

SAMPLES = 9


@pytest.mark.slow
def test_good_beams_are_those_with_a_good_point() -> None:
    """A beam that is called good has a good point nearby; one of which a sampled point is clearly good is called so."""
    counts = [0, 0, 0]
    for seed in range(120):
        case = Case.random(seed)
        beams, bounds = UsedBeams.of(case.scan, case.config), case.config.bounds
        (good,) = good_beams(beams, np.array([case.pose]), Obstacles(case.grid))
        for i, reading in enumerate(beams.readings.tolist()):
            readings = np.maximum(reading + bounds.range_error_m * np.linspace(-1.0, 1.0, SAMPLES), 0.0).tolist()
            points = [laser + along * each for laser, along in case.rays(int(beams.numbers[i]), SAMPLES) for each in readings]
            reached = min(map(case.distance, points))
            apart = 2.0 * bounds.range_error_m / (SAMPLES - 1) + 2.0 * bounds.bearing_error_rad * (reading + 0.2) / (SAMPLES - 1)
            x, y, theta = np.ptp(beams.moves[i], axis=0).tolist()
            moved = math.hypot(x, y) + 5.0 * theta
            if good[i]:
                assert reached <= bounds.map_error_m + 0.5 * apart + moved + 1e-9, (seed, i)
                counts[0] += 1
            elif reached <= bounds.map_error_m - 0.05 * case.grid.resolution * (bounds.bearing_error_rad > 0.0) - 1e-8:
                raise AssertionError(f"a good beam is called bad: {seed}, {i}, {reached}")
            counts[1] += reached <= bounds.map_error_m
            counts[2] += reached > bounds.map_error_m
    assert min(counts) > 60, counts


def grid() -> OccupancyGrid:
    cells = np.full((8, 8), FREE, dtype=np.uint8)
    cells[4, 4] = OCCUPIED
    cells[0, 0] = UNKNOWN
    return OccupancyGrid(cells, 0.25)


def good(
    reading: float, map_error: float, *, range_error: float = 0.0, bearing_error: float = 0.0, at: tuple[float, ...] = (0.0,) * 3
) -> bool:
    """Whether one beam straight ahead is good."""
    scan = LaserScan(0, np.array([reading], np.float32), 0.0, 1.0, mounting=Mounting())
    config = LocalizerConfig(bounds=Bounds(range_error, bearing_error, map_error))
    return bool(good_beams(UsedBeams.of(scan, config), np.array([at]), Obstacles(grid()))[0, 0])


@pytest.mark.parametrize(
    ("x", "y", "map_error", "expected"),
    [
        (1.0 + 1e-8, 1.0 + 1e-8, 0.0, True),  # a corner of the cell
        (1.0 - 1e-8, 1.0 + 1e-8, 0.0, False),
        (1.25 - 1e-8, 1.125, 0.0, True),
        (1.25 + 1e-8, 1.125, 0.0, False),
        (0.75, 1.125, 0.25 + 1e-8, True),
        (0.75, 1.125, 0.25 - 1e-8, False),
        (0.7, 0.6, 0.5 + 1e-8, True),  # 0.3 and 0.4 from the corner: 0.5 away, not 0.4
        (0.7, 0.6, 0.5 - 1e-8, False),
        (0.125, 0.125, 0.0, False),  # unknown is not occupied
        (-5.0, 90.0, 0.1, False),
        (1.0, 1.125, 0.0, False),  # on the very edge it is not certain, whatever rounds
    ],
)
def test_the_distance_is_euclidean(x: float, y: float, map_error: float, expected: bool) -> None:
    assert good(1.0, map_error, at=(x - 1.0, y, 0.0)) == expected
    assert good(1.0, map_error, at=(x, y + 1.0, -0.5 * math.pi)) == expected


@pytest.mark.parametrize(
    ("along", "across", "expected"), [(0.0, 0.0, False), (0.31, 0.0, True), (0.29, 0.0, False), (0.29, 0.1, False), (0.0, 0.31, False)]
)
def test_the_errors_reach_along_the_beam_and_across_it(along: float, across: float, expected: bool) -> None:
    errors = {"range_error": along, "bearing_error": across}
    assert good(0.7, 0.0, at=(0.0, 1.125, 0.0), **errors) == expected
    assert good(0.7, 0.0, at=(0.7, 0.425, 0.5 * math.pi), range_error=across, bearing_error=0.0) is False
    assert good(1.0, 0.0, at=(1.125, -0.2, 0.5 * math.pi), **errors) == (along > 0.2)


def test_a_bearing_error_swings_the_end() -> None:
    assert good(10.0, 0.0, bearing_error=0.0301, at=(0.7, -8.875, 0.5 * math.pi))
    assert not good(10.0, 0.0, bearing_error=0.0290, at=(0.7, -8.875, 0.5 * math.pi))
    assert good(10.0, 0.0, bearing_error=0.0301, at=(1.55, -8.875, 0.5 * math.pi))


def test_a_long_error_passes_through_a_cell_between_its_ends() -> None:
    assert good(5.0, 0.0, range_error=4.9, at=(0.0, 1.125, 0.0))
    assert not good(5.0, 0.0, range_error=4.9, at=(0.0, 1.125, math.pi))  # no reading is negative


def test_a_beam_is_bad_once() -> None:
    """Of four beams one ends in the cell; one ends far behind it, nowhere, and its ray is blocked; two more see through it."""
    scan = LaserScan(0, np.array([1.01, 1.9, np.inf, np.inf], np.float32), 0.0, 1e-4, range_max=30.0)
    free = FreeSpace(margin_m=0.02, no_return_m=5.0)
    beams = UsedBeams.of(scan, LocalizerConfig(bounds=Bounds(0.0, 0.0, 0.01), free_space=free))
    here, turned = (0.0, 1.125, 0.0), (0.0, 1.125, math.pi)
    poses = np.array([here, turned])
    obstacles = Obstacles(grid())
    assert good_beams(beams, poses, obstacles).tolist() == [[True, False], [False, False]]
    assert blocked_rays(beams, poses, obstacles).tolist() == [[False, True, True, True], [False] * 4]
    assert bad_beams(beams, poses, obstacles).tolist() == [3, 2]


@pytest.mark.slow
def test_many_poses_at_once_are_each_by_itself() -> None:
    case = Case.random(11)
    beams, obstacles = UsedBeams.of(case.scan, case.config), Obstacles(case.grid)
    poses = np.array(case.pose) + np.random.default_rng(0).normal(0.0, 0.3, (200, 3))
    alone = [int(bad_beams(beams, pose[None], obstacles)[0]) for pose in poses]
    assert bad_beams(beams, poses, obstacles).tolist() == alone
    assert len(set(alone)) > 1


def test_no_beams_and_no_poses() -> None:
    nothing = UsedBeams.of(LaserScan(0, np.array([np.nan], np.float32), 0.0, 1.0), LocalizerConfig())
    obstacles = Obstacles(grid())
    assert bad_beams(nothing, np.zeros((2, 3)), obstacles).tolist() == [0, 0]
    one = UsedBeams.of(LaserScan(0, np.array([1.0], np.float32), 0.0, 1.0), LocalizerConfig())
    assert bad_beams(one, np.empty((0, 3)), obstacles).shape == (0,)


def test_an_endless_beam_ends_nowhere_and_is_looked_along_to_the_edge_of_the_map() -> None:
    scan = LaserScan(0, np.array([3e38, 5.0], np.float32), 0.0, 1.0)
    beams, obstacles = UsedBeams.of(scan, LocalizerConfig()), Obstacles(grid())
    poses = np.array([[0.0, 1.125, 0.0], [0.0, 0.5, math.pi]])
    assert not good_beams(beams, poses, obstacles).any()
    assert blocked_rays(beams, poses, obstacles).tolist() == [[True, False], [False, False]]
