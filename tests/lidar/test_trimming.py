"""Cutting hypotheses to what may hold a consistent pose, against the slow twin and against all pieces one by one."""

import math
from dataclasses import replace

import numpy as np
import pytest

from ial.contractors.boxes import Boxes
from ial.contractors.threads import set_threads
from ial.datasets.scan import Mounting
from ial.lidar.lattice import Lattice
from ial.lidar.scan_contractor import ScanContractor
from ial.lidar.trimming import trim
from tests.lidar.twin import World

WORLDS = 300


class Case:
    """A world, the cells of a lattice around its pose as one hypothesis, and how many beams are bad at the pose."""

    def __init__(self, seed: int, at_the_cut: bool = False) -> None:
        random = np.random.default_rng(seed)
        world = World.random(random)
        if at_the_cut:  # the robot turned around under its laser
            pose = replace(world.pose, theta=math.copysign(math.pi - 1e-3, world.pose.theta))
            mounting = pose.inverse() @ world.pose @ world.scan.mounting.pose
            turned = Mounting(mounting.x, mounting.y, mounting.theta, world.scan.mounting.upside_down)
            world = replace(world, pose=pose, scan=replace(world.scan, mounting=turned))
        self.world = world
        self.bad = int((~world.certainly_good()).sum())
        self.depth = int(random.integers(1, 4))
        self.lattice = Lattice(2.0 * world.resolution, 0.1, 2)
        at = np.array([world.pose.x, world.pose.y, world.pose.theta])
        around = random.uniform(0.0, 2.5, 3) * self.lattice.widths
        lower, upper = at - around, at + random.uniform(0.0, 2.5, 3) * self.lattice.widths
        if lower[2] < -math.pi:
            lower[2], upper[2] = lower[2] + 2.0 * math.pi, upper[2] + 2.0 * math.pi
        self.boxes = self.lattice.boxes(self.lattice.tiles(Boxes(lower[None], upper[None])))
        layers = self.lattice.layer(self.boxes)
        wraps = layers.max() - layers.min() > self.lattice.layers // 2
        self.layers = (layers - (layers[layers > self.lattice.layers // 2].min() if wraps else layers.min())) % self.lattice.layers

    def trimmed(self, outliers: int) -> Boxes:
        world, labels = self.world, np.zeros(len(self.boxes), dtype=np.int64)
        beams = world.beams(outliers)
        boxes, kept = trim(self.boxes, labels, self.layers, beams, world.index(), world.bounds.map_error_m, self.depth)
        return boxes[kept]

    def holds_the_pose(self, boxes: Boxes) -> bool:
        pose = self.world.pose
        return any(boxes.contain([pose.x, pose.y, pose.theta + turn]).any() for turn in (-2.0 * np.pi, 0.0, 2.0 * np.pi))

    def pieces(self, outliers: int) -> tuple[Boxes, np.ndarray]:
        """Return all of the finest pieces that fit, as do all of the larger ones around them, and the layer of each."""
        world = self.world
        scan = ScanContractor(world.beams(outliers), world.index(), world.bounds.map_error_m)
        lower, upper, layers = self.boxes.lower, self.boxes.upper, self.layers
        rows = scan.fits(self.boxes)
        lower, upper, layers = lower[rows], upper[rows], layers[rows]
        for _ in range(self.depth):
            middle = lower + 0.5 * (upper - lower)
            halves = [np.array([number >> axis & 1 for axis in range(3)], dtype=bool) for number in range(8)]
            lower, upper = (
                np.concatenate([np.where(half, middle, lower) for half in halves]),
                np.concatenate([np.where(half, upper, middle) for half in halves]),
            )
            layers = np.tile(layers, 8)
            rows = scan.fits(Boxes(lower, upper))
            lower, upper, layers = lower[rows], upper[rows], layers[rows]
        return Boxes(lower, upper), layers


@pytest.mark.parametrize("at_the_cut", [False, True])
def test_a_consistent_pose_stays(at_the_cut: bool) -> None:
    sharp = narrowed = 0
    for seed in range(WORLDS):
        case = Case(seed, at_the_cut)
        assert case.holds_the_pose(case.boxes)
        left = case.trimmed(case.bad)
        assert case.holds_the_pose(left), f"world {seed} lost its pose"
        narrowed += left.volume() < 0.9 * case.boxes.volume()
        sharp += case.bad > 0 and not case.holds_the_pose(case.trimmed(case.bad - 1))
    assert narrowed > 0.3 * WORLDS
    assert sharp > 0.1 * WORLDS  # with one outlier less, the pose is often cut off: the twin is at the edge


def test_the_cells_are_cut_to_the_hull_of_the_pieces_that_fit() -> None:
    emptied = 0
    for seed in range(WORLDS):
        case = Case(seed)
        outliers = max(0, case.bad - seed % 3)
        pieces, layers = case.pieces(outliers)
        left = case.trimmed(outliers)
        if not len(pieces):
            assert not len(left)
            emptied += 1
            continue
        hull = pieces.hull()
        lowest, highest = (pieces[layers == end] for end in (layers.min(), layers.max()))
        lower = np.maximum(case.boxes.lower, hull.lower * [1.0, 1.0, 0.0] - [0.0, 0.0, 10.0])
        upper = np.minimum(case.boxes.upper, hull.upper * [1.0, 1.0, 0.0] + [0.0, 0.0, 10.0])
        lower[case.layers == layers.min(), 2] = lowest.lower[:, 2].min()
        upper[case.layers == layers.max(), 2] = highest.upper[:, 2].max()
        rows = (case.layers >= layers.min()) & (case.layers <= layers.max()) & (lower < upper).all(axis=1)
        np.testing.assert_array_equal(left.lower, lower[rows])
        np.testing.assert_array_equal(left.upper, upper[rows])
    assert emptied > 0


@pytest.mark.parametrize("threads", [1, 2])
def test_hypotheses_are_cut_each_by_itself(threads: int) -> None:
    case = Case(5)
    far = case.boxes.lower + np.array([1000.0 * case.lattice.position_m, 0.0, 0.0])
    both = Boxes.concatenate([case.boxes, Boxes(far, far + (case.boxes.upper - case.boxes.lower))])
    order = np.random.default_rng(0).permutation(len(both))
    labels = np.repeat([0, 1], len(case.boxes))
    world = case.world
    set_threads(threads)
    try:
        evidence = (world.beams(case.bad), world.index(), world.bounds.map_error_m, case.depth)
        boxes, kept = trim(both[order], labels[order], np.tile(case.layers, 2)[order], *evidence)
    finally:
        set_threads(None)
    expected = {row.tobytes() for row in np.hstack([case.trimmed(case.bad).lower, case.trimmed(case.bad).upper])}
    near = kept & (labels[order] == 0)
    assert {row.tobytes() for row in np.hstack([boxes.lower[near], boxes.upper[near]])} == expected
    assert not kept[labels[order] == 1].any()  # nothing stands there
