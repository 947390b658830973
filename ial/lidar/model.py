"""`LidarModel`: a robot with a planar lidar in an occupancy grid, as an instance of `ial.membership.Model`."""

import math
from collections.abc import Callable

import numpy as np
import numpy.typing as npt
from scipy import ndimage

from ial.contractors.boxes import Boxes
from ial.contractors.paving.limits import Deadline, Limit
from ial.contractors.paving.paver import pave
from ial.contractors.paving.waiting import Order
from ial.datasets.motion import Motion
from ial.errors import ConfigError, MapError
from ial.lidar.beams import Beams
from ial.lidar.bit_columns import BitColumns
from ial.lidar.cell_counts import count_cells
from ial.lidar.config import LocalizerConfig
from ial.lidar.free_space import count_blocked
from ial.lidar.lattice import Lattice
from ial.lidar.pose_contractor import PoseContractor
from ial.lidar.pose_set import PoseSet, unite
from ial.lidar.prediction import move
from ial.lidar.tiles import Tiles
from ial.maps.cell_index import CellIndex
from ial.maps.occupancy_grid import FREE, OCCUPIED, UNKNOWN, OccupancyGrid, check_usable
from ial.maps.symmetry import symmetries
from ial.membership import Model
from ial.pose import Pose

_COARSE = 2.0
"""Boxes are bisected down to this many cells of the lattice along each axis; what is left of them is tried part by part."""

_ROUND_UP = 1.0 + 2.0**-40
_CHUNK = 1 << 12  # tiles that are tried at a time, 2 KB each
_BATCH = 1 << 14  # larger ones sweep more of a map's table than the caches hold: a third slower on 400 × 400 m
_LAID_OUT_CELLS = 1 << 17  # above, a set is laid out coarser, and refined by the scan
_SEARCHING = 0.5  # the share of a scan's time that searches may take; laying out the set and telling its hypotheses apart takes the rest
_CELLS_PER_S = 2.5e5  # that are laid out where time is limited, for each second of it
_FIRST_TILES = 16  # that are tried while it is not known how long one takes


class LidarModel(Model[PoseSet, Motion | None, Beams]):
    """Sets of poses, moved by odometry and contracted by scans.

    Parameters
    ----------
    grid
        The map.
    config
        Bounds, precision and limits.

    Raises
    ------
    MapError
        If the map has no occupied cell, or none where the robot may be.
    """

    def __init__(self, grid: OccupancyGrid, config: LocalizerConfig) -> None:
        allowed = self._allowed = (FREE,) if config.domain == "free" else (FREE, UNKNOWN)
        check_usable(grid, allowed)
        self.grid = grid
        self.config = config
        split, parts = divide(grid.resolution, config.precision.position_m)
        self.occupied = CellIndex(_split(grid.mask(OCCUPIED), split), grid.resolution / split)
        self.domain = CellIndex(_split(self._roomy(grid.mask(*allowed)), split), grid.resolution / split, compact=True)
        self.bits = BitColumns(_split(grid.mask(OCCUPIED), split)) if config.free_space.use else None
        self.lattice = Lattice(parts * self.occupied.resolution, config.precision.heading_rad, parts)
        self._universe = PoseSet(self.lattice.root(grid.width_m, grid.height_m))
        most = _LAID_OUT_CELLS if config.max_seconds is None else max(64, int(_CELLS_PER_S * config.max_seconds))
        self._affordable = min(most, _LAID_OUT_CELLS, config.max_boxes)
        self.start_clock()

    def start_clock(self) -> None:
        """Let the time begin that one scan may take; what is searched for from now on ends with it."""
        most = self.config.max_seconds
        self._deadline = Deadline(None if most is None else _SEARCHING * most)

    def _roomy(self, allowed: npt.NDArray[np.bool_]) -> npt.NDArray[np.bool_]:
        """Return the allowed cells without those from everywhere in which the robot would touch an obstacle.

        From no point of a cell is a closed occupied cell farther than their middles are apart.

        Raises
        ------
        MapError
            If the robot fits nowhere.
        """
        radius = self.config.robot_radius_m
        if not radius:
            return allowed
        distance = ndimage.distance_transform_edt(~self.grid.mask(OCCUPIED)) * (self.grid.resolution * _ROUND_UP)
        roomy = np.asarray(allowed & (distance >= radius))
        if not roomy.any():
            raise MapError(f"a robot with a radius of {radius:g} m fits nowhere in this map; give a smaller robot_radius_m")
        return roomy

    def universe(self) -> PoseSet:
        """Return every pose in the map."""
        return self._universe

    def within(self, boxes: Boxes) -> PoseSet:
        """Return the poses of the domain that lie in boxes (x, y, θ) of the map frame.

        Raises
        ------
        ConfigError
            If there are none.
        """
        cells = self._laid_out(self.grid.boxes_to_grid(boxes))
        if not len(cells):
            raise ConfigError(
                "the initial region lies outside the free space of the map; check --initial, the origin of the map, and domain"
            )
        return PoseSet(cells)

    def predict(self, states: PoseSet, motion: Motion | None) -> PoseSet:
        """Return the moved poses that lie in the domain, laid out on the lattice; None is the motion before the first scan."""
        if motion is None:
            return states
        parts = (states.boxes[rows] for rows in (~states.carried, states.carried))
        confirmed, carried = (self._laid_out(move(boxes, motion), boxes.volume()) for boxes in parts)
        return unite(PoseSet(confirmed, outliers=states.outliers), PoseSet(carried))

    def _laid_out(self, boxes: Boxes, volume: float = 0.0) -> Boxes:
        """Return the cells of the lattice that cover boxes, as far as they meet the domain; see `Lattice.cover`."""
        cells = self.lattice.cover(self._within_map(boxes), self._affordable, volume)
        return cells[self.domain.meet(Boxes(cells.lower[:, :2], cells.upper[:, :2]))]

    def _within_map(self, boxes: Boxes) -> Boxes:
        """Return the boxes cut to the extent of the map, which holds the domain; those outside are dropped."""
        edge = np.array([self.grid.width_m, self.grid.height_m]) * (1.0 + 2.0**-40)
        lower, upper = boxes.lower.copy(), boxes.upper.copy()
        lower[:, :2] = np.maximum(lower[:, :2], 0.0)
        upper[:, :2] = np.minimum(upper[:, :2], edge)
        cut = Boxes(lower, upper)
        return cut[~cut.empty]

    def step(self, states: PoseSet, motion: Motion | None, reading: Beams) -> PoseSet:
        """Return what is left after a motion and a scan. A set of ordinary size is laid out and tried in one go."""
        if motion is None or not reading.informative or states.carried.any():
            return self.contract(self.predict(states, motion), reading)
        volume = states.boxes.volume()
        moved = self._within_map(move(states.boxes, motion))
        finest = float(self.lattice.widths.prod())
        tiles = self.lattice.few_tiles(moved, self._affordable) if volume < 2.0 * self._affordable * finest else None
        if tiles is None:
            return self.contract(PoseSet(self._laid_out(moved, volume), outliers=states.outliers), reading)
        return _allowing(reading, states.outliers, lambda most: self._tried(tiles, moved, most, 0))

    def contract(self, states: PoseSet, reading: Beams) -> PoseSet:
        """Return the poses that a scan allows. Confirmed and carried ones stay apart while both survive; what is both is confirmed."""
        if not reading.informative:
            return states
        return _allowing(reading, states.outliers, lambda most: self._contracted(states, most))

    def _contracted(self, states: PoseSet, reading: Beams) -> PoseSet:
        confirmed, carried = (self._paved(states.boxes[rows], reading) for rows in (~states.carried, states.carried))
        if not len(confirmed):
            return carried
        if not len(carried):
            return confirmed
        return unite(confirmed, carried.without(confirmed.boxes))

    def _paved(self, boxes: Boxes, reading: Beams) -> PoseSet:
        if not len(boxes):
            return PoseSet(boxes, outliers=reading.outliers)
        contractor = PoseContractor(reading, self.occupied, self.domain, self.config.bounds.map_error_m)
        coarse = self.lattice.widths * _COARSE
        nodes = 0
        if (boxes.width() > coarse).any():
            left = self._deadline.left_s
            # What the clock leaves half done is to be equally coarse everywhere: the next scan goes on from there.
            order: Order = "depth" if left is None else "breadth"
            paving = pave(contractor, boxes, coarse, order=order, max_boxes=self.config.max_boxes, max_seconds=left, batch=_BATCH)
            boxes, nodes = paving.boxes, paving.nodes
            if paving.limited:
                # A search that was stopped leaves large boxes: finer cells than it had boxes would say no more.
                return self._coarse(boxes, paving.limited, nodes, reading)
        return self._tried(self.lattice.tiles(boxes), boxes, reading, nodes)

    def _coarse(self, boxes: Boxes, limited: Limit, nodes: int, reading: Beams) -> PoseSet:
        """Return cells that cover boxes, of an answer that a limit made coarse."""
        most = min(2 * len(boxes), self._affordable if limited == "time" else self.config.max_boxes)
        return PoseSet(self.lattice.cover(boxes, most, boxes.volume()), limited=limited, nodes=nodes, outliers=reading.outliers)

    def _tried(self, tiles: Tiles, boxes: Boxes, reading: Beams, nodes: int) -> PoseSet:
        """Return the cells that may hold a consistent pose; where they are too many, or the time is up, coarse ones that cover `boxes`."""
        if not len(tiles.keys):
            return PoseSet(Boxes.none(3), nodes=nodes, outliers=reading.outliers)
        deadline = Deadline(self._deadline.left_s, _FIRST_TILES)
        found, counts, total = [], [], 0
        start = 0
        while start < len(tiles.keys):
            portion = deadline.portion(min(_CHUNK, len(tiles.keys) - start))
            part = Tiles(tiles.keys[start : start + portion], tiles.words[start : start + portion])
            words, least = count_cells(part, self.lattice, reading, self.occupied, self.domain, self.config.bounds.map_error_m)
            left = Tiles(part.keys, words)
            total += len(left)
            if not portion or total > self.config.max_boxes:
                return self._coarse(boxes, "boxes" if portion else "time", nodes, reading)
            cells, bad = self._looked_along(self.lattice.boxes(left), left.values(least), reading)
            found.append(cells)
            counts.append(bad)
            deadline.worked(portion)
            start += portion
        return PoseSet(Boxes.concatenate(found), nodes=nodes + len(tiles), bad=np.concatenate(counts), outliers=reading.outliers)

    def _looked_along(self, cells: Boxes, bad: npt.NDArray[np.int16], reading: Beams) -> tuple[Boxes, npt.NDArray[np.int16]]:
        """Return the cells from which not too many beams are bad or blocked, and how many are at least."""
        if self.bits is None:
            return cells, bad
        bad = count_blocked(cells, bad, reading, self.lattice.parts, self.occupied, self.bits, self.config.bounds.map_error_m)
        rows = bad <= reading.outliers
        return cells[rows], bad[rows]

    def symmetries(self) -> tuple[Pose, ...]:
        """Return the rotations of the map frame after which no scan can tell the difference."""
        origin = self.grid.origin
        turns = symmetries(self.grid.mask(OCCUPIED), self.grid.mask(*self._allowed), resolution=self.grid.resolution)
        return tuple(origin @ turn @ origin.inverse() for turn in turns)

    def in_domain(self, pose: Pose) -> bool:
        """Return whether a position in the grid's frame lies in a cell of the domain."""
        return bool(self.domain.meet(Boxes.of([(pose.x, pose.x), (pose.y, pose.y)]))[0])

    def empty(self, states: PoseSet) -> bool:
        """Return whether no pose is left."""
        return not len(states)

    def recover(self, states: PoseSet, motion: Motion | None, reading: Beams) -> PoseSet:
        """Return what to go on with after a scan that fits nowhere in the prediction.

        The scan is searched over the whole map. With the policy `union` the uncontracted prediction is carried on beside what is found, so
        that the truth is kept whichever of the last motion and the last scan broke its bound; `restart` drops it. If nothing is found
        anywhere, the prediction alone is carried on.
        """
        predicted = self.predict(states, motion)
        searched = motion is None and states is self._universe  # the step itself has searched the whole map in vain
        found = PoseSet(Boxes.none(3)) if searched else self.contract(self._universe, reading)
        if len(found) and self.config.recovery == "restart":
            return found
        return unite(found, predicted)


def _allowing(reading: Beams, before: int, search: Callable[[Beams], PoseSet]) -> PoseSet:
    """Return what a search leaves, with as many bad beams as the reading allows.

    Where the reading leaves the number open it is the smallest one that leaves a pose, plus the margin. The search is repeated with more
    until it leaves one; what was allowed before is a good guess. Nothing is left if more were needed than the limit, or than a jump allows.

    Parameters
    ----------
    before
        How many were allowed at the scan before; 0 if there was none.
    """
    if reading.margin is None:
        return search(reading)
    limit = reading.outliers if reading.jump is None or not before else min(reading.outliers, before + reading.jump)
    most = min(max(before, 2 * reading.margin), limit)
    while True:
        found = search(reading.allowing(most))
        if len(found):
            needed = most if found.limited else min(int(found.bad.min()) + reading.margin, limit)
            if needed <= most:
                return found.within(needed)
            most = needed
        elif most == limit:
            return found
        else:
            most = min(2 * most + 1, limit)


def divide(resolution: float, position_m: float) -> tuple[int, int]:
    """Return into how many parts the cells of a map are split along an axis, and of how many such parts a cell of the lattice consists.

    The second number is at least 2: a cell of the answer is kept if one of its parts may hold a consistent pose. Parts exclude more than
    whole cells do, while whole cells keep what belongs together connected.
    """
    if 2.0 * resolution <= position_m * (1.0 + 1e-6):
        return 1, math.floor(position_m / resolution * (1.0 + 1e-6))
    return math.ceil(2.0 * resolution / position_m * (1.0 - 1e-6)), 2


def _split(mask: npt.NDArray[np.bool_], split: int) -> npt.NDArray[np.bool_]:
    return mask if split == 1 else mask.repeat(split, axis=0).repeat(split, axis=1)
