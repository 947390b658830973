import math
from dataclasses import replace

import numpy as np
import pytest

from ial.lidar.beams import Beams
from ial.maps.occupancy_grid import FREE, OCCUPIED, UNKNOWN, OccupancyGrid
from ial.pose import Pose
from ial.study.good_beams import good_beams
from tests.lidar.twin import World


def distances(grid: OccupancyGrid, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return the exact distance of points from the nearest closed occupied cell, by looking at all cells."""
    row, column = np.nonzero(grid.mask(OCCUPIED))
    r = grid.resolution
    dx = np.maximum(np.maximum(column * r - x[:, None], x[:, None] - (column + 1) * r), 0.0)
    dy = np.maximum(np.maximum(row * r - y[:, None], y[:, None] - (row + 1) * r), 0.0)
    return np.asarray(np.hypot(dx, dy).min(axis=1))


def nearest(beams: Beams, i: int, pose: Pose, grid: OccupancyGrid, samples: int) -> float:
    """Return the smallest distance of a sampled point of a beam's error region from an occupied cell."""
    share = np.linspace(-1.0, 1.0, samples)
    along, across = (axis.ravel() for axis in np.meshgrid(share * beams.errors[i, 0], share * beams.errors[i, 1]))
    px, py = beams.ends[i]
    ux, uy = beams.directions[i]
    bx, by = px + along * ux - across * uy, py + along * uy + across * ux
    c, s = math.cos(pose.theta), math.sin(pose.theta)
    return float(distances(grid, pose.x + c * bx - s * by, pose.y + s * bx + c * by).min())


@pytest.mark.parametrize("wide", [False, True])
def test_good_beams_equal_a_dense_sampling_of_the_error_region(wide: bool) -> None:
    counts = [0, 0]
    for seed in range(100):
        random = np.random.default_rng(seed)
        world = World.random(random)
        grid = OccupancyGrid(np.where(world.mask, OCCUPIED, FREE).astype(np.uint8), world.resolution)
        beams = world.beams(0)
        errors = np.column_stack([random.uniform(0.0, 0.2, len(beams)), random.uniform(0.0, 0.2, len(beams)) * wide + 1e-12])
        beams = replace(beams, errors=errors)
        good = good_beams(beams, world.pose, grid, world.bounds.map_error_m)
        assert good.dtype == np.bool_
        samples = 21
        spacing = 2.0 * errors / (samples - 1)
        for i in range(len(beams)):
            reached = nearest(beams, i, world.pose, grid, samples)
            unseen = 0.5 * float(np.hypot(*spacing[i]))  # how far a point of the region may be from a sample
            if reached > world.bounds.map_error_m + unseen + 1e-9:
                assert not good[i], (seed, i)
                counts[0] += 1
            if reached <= world.bounds.map_error_m - 0.05 * grid.resolution * wide - 1e-9:
                assert good[i], (seed, i)
                counts[1] += 1
    assert min(counts) > 100


def grid() -> OccupancyGrid:
    cells = np.full((8, 8), FREE, dtype=np.uint8)
    cells[4, 4] = OCCUPIED
    cells[0, 0] = UNKNOWN
    return OccupancyGrid(cells, 0.25)


def one(end: tuple[float, float], along: float = 0.0, across: float = 0.0, heading: float = 0.0) -> Beams:
    return Beams(np.array([end]), np.array([[math.cos(heading), math.sin(heading)]]), np.array([[along, across]]), 0)


@pytest.mark.parametrize(
    ("end", "map_error", "good"),
    [
        ((1.0, 1.0), 0.0, True),  # the corner of the closed cell
        ((1.25, 1.1), 0.0, True),
        ((1.25 + 1e-9, 1.1), 0.0, False),
        ((0.75, 1.1), 0.25, True),
        ((0.75 - 1e-9, 1.1), 0.25, False),
        ((0.7, 0.6), 0.5 + 1e-9, True),  # 0.3 and 0.4 from the corner: 0.5 away, not 0.4
        ((0.7, 0.6), 0.5 - 1e-9, False),
        ((0.1, 0.1), 0.0, False),  # unknown is not occupied
        ((-5.0, 90.0), 0.1, False),
    ],
)
def test_the_distance_is_euclidean_and_cells_are_closed(end: tuple[float, float], map_error: float, good: bool) -> None:
    assert good_beams(one(end), Pose(), grid(), map_error)[0] == good


@pytest.mark.parametrize(
    ("along", "across", "good"), [(0.0, 0.0, False), (0.31, 0.0, True), (0.29, 0.0, False), (0.29, 0.1, False), (0.0, 0.31, False)]
)
def test_the_region_extends_along_the_beam(along: float, across: float, good: bool) -> None:
    assert good_beams(one((0.7, 1.125), along, across), Pose(), grid(), 0.0)[0] == good


def test_the_region_extends_across_the_beam_and_turns_with_the_robot() -> None:
    assert good_beams(one((0.7, 1.125), 0.0, 0.31, 0.5 * math.pi), Pose(), grid(), 0.0)[0]
    assert not good_beams(one((0.7, 1.125), 0.31, 0.0, 0.5 * math.pi), Pose(), grid(), 0.0)[0]
    assert good_beams(one((1.0, 0.0), 0.31, 0.0, 0.0), Pose(1.125, -0.2, 0.5 * math.pi), grid(), 0.0)[0]


def test_a_long_region_passes_through_a_cell_between_its_ends() -> None:
    assert good_beams(one((1.125, 1.125), 5.0), Pose(), grid(), 0.0)[0]


def test_no_beams() -> None:
    assert good_beams(Beams(np.empty((0, 2)), np.empty((0, 2)), np.empty((0, 2)), 0), Pose(), grid(), 0.1).shape == (0,)
