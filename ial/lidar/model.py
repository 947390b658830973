"""`LidarModel`: a robot with a planar lidar in an occupancy grid, as an instance of `ial.membership.Model`."""

from dataclasses import replace

import numpy as np
import numpy.typing as npt

from ial.contractors.boxes import Boxes
from ial.contractors.margins import ABOVE
from ial.contractors.paving.limits import Deadline
from ial.contractors.paving.paver import pave
from ial.contractors.paving.waiting import Order
from ial.datasets.motion import Motion
from ial.errors import ConfigError
from ial.lidar.configuration.config import LocalizerConfig
from ial.lidar.evidence.beams import Beams
from ial.lidar.pose_set import PoseSet, join, unite
from ial.lidar.search.border_refinement import mend, refine_border
from ial.lidar.search.cell_bitmaps import CellBitmaps
from ial.lidar.search.cell_counts import count_cells
from ial.lidar.search.free_space import count_blocked
from ial.lidar.search.lattice import Lattice, divide
from ial.lidar.search.map_tables import MapTables, Sections
from ial.lidar.search.outlier_budget import within_budget
from ial.lidar.search.pose_contractor import PoseContractor
from ial.lidar.search.prediction import in_rows, move
from ial.maps.grids.occupancy_grid import FREE, UNKNOWN, OccupancyGrid, check_usable
from ial.maps.grids.symmetry import symmetries
from ial.membership.model import ContractingModel
from ial.pose import Pose

_COARSE = 2.0
"""Boxes are bisected down to this many cells of the lattice along each axis; what is left of them is tried part by part."""

_CHUNK = 1 << 12  # bitmaps that are tried at a time, 2 KB each
_BATCH = 1 << 14  # larger ones sweep more of a map's table than the caches hold: a third slower on 400 × 400 m
_LAID_OUT_CELLS = 1 << 17  # above, a set is laid out coarser, and refined by the scan
_CELLS_PER_S = 2.5e5  # that are laid out where time is limited, for each second of it
_REFINED = 1 << 10  # boxes of a set
_FIRST_BITMAPS = 16  # that are tried while it is not known how long one takes


class LidarModel(ContractingModel[PoseSet, Motion | None, Beams]):
    """Sets of poses, moved by odometry and contracted by scans.

    Parameters
    ----------
    grid
        The map.
    config
        Bounds, precision and limits.

    Raises
    ------
    ConfigError
        If the precision is so fine, or so coarse, that the map's cells cannot be counted.
    MapError
        If the map has no occupied cell, or none where the robot may be.
    """

    def __init__(self, grid: OccupancyGrid, config: LocalizerConfig) -> None:
        allowed = self._allowed = (FREE,) if config.domain == "free" else (FREE, UNKNOWN)
        check_usable(grid, allowed)
        self.grid = grid
        self.config = config
        split, parts = divide(grid.resolution, config.precision.position_m)
        self.lattice = Lattice(parts * (grid.resolution / split), config.precision.heading_rad, parts)
        self.sections = Sections(
            grid,
            allowed,
            split,
            self.lattice,
            radius_m=config.robot_radius_m,
            free_space=config.free_space.use,
            position_m=config.precision.position_m,
        )
        self._universe = PoseSet(self.sections.universe)
        most = _LAID_OUT_CELLS if config.max_seconds is None else int(max(64.0, min(_CELLS_PER_S * config.max_seconds, _LAID_OUT_CELLS)))
        self._affordable = min(most, _LAID_OUT_CELLS, config.max_boxes)

    def __repr__(self) -> str:
        return f"<LidarModel in {self.grid}>"

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
        parts = (states.boxes[rows] for rows in (~states.unconfirmed, states.unconfirmed))
        confirmed, unconfirmed = (self._laid_out(move(in_rows(boxes), motion), boxes.volume()) for boxes in parts)
        return replace(unite(PoseSet(confirmed), PoseSet(unconfirmed)), outliers=states.outliers, accepted=states.accepted)

    def _laid_out(self, boxes: Boxes, volume: float = 0.0) -> Boxes:
        """Return the cells of the lattice that cover boxes, as far as they meet the domain; see `Lattice.cover`."""
        cells = self.lattice.cover(self._within_map(boxes), self._affordable, volume)
        met = np.zeros(len(cells), dtype=np.bool_)
        for key, rows, parts in self.sections.parts(cells):
            met[rows] |= self.sections[key].domain.meet(Boxes(parts.lower[:, :2], parts.upper[:, :2]))
        return cells[met]

    def _within_map(self, boxes: Boxes) -> Boxes:
        """Return the boxes cut to the extent of the map, which holds the domain; those outside are dropped."""
        edge = np.array([self.grid.width_m, self.grid.height_m]) * ABOVE
        lower, upper = boxes.lower.copy(), boxes.upper.copy()
        lower[:, :2] = np.maximum(lower[:, :2], 0.0)
        upper[:, :2] = np.minimum(upper[:, :2], edge)
        cut = Boxes(lower, upper)
        return cut[~cut.empty]

    def step(self, states: PoseSet, motion: Motion | None, reading: Beams) -> PoseSet:
        """Return what is left after a motion and a scan. A set of ordinary size is laid out and tried in one go."""
        if motion is None or not reading.informative or states.unconfirmed.any():
            return self.contract(self.predict(states, motion), reading)
        self.sections.reach(reading)
        volume = states.boxes.volume()
        moved = self._within_map(move(in_rows(states.boxes), motion))
        keys = [key for key, _, _ in self.sections.parts(moved)]
        finest = float(self.lattice.widths.prod())
        small = len(keys) == 1 and volume < 2.0 * self._affordable * finest
        bitmaps = self.lattice.few_bitmaps(moved, self._affordable) if small else None
        if bitmaps is None:
            return self.contract(PoseSet(self._laid_out(moved, volume), accepted=states.accepted), reading)
        tables = self.sections[keys[0]]
        return within_budget(reading, states, lambda most: self._coarsened(self._tried(tables, bitmaps, moved, most), most))

    def contract(self, states: PoseSet, reading: Beams) -> PoseSet:
        """Return the poses that a scan allows. Confirmed and unconfirmed ones stay apart while both survive; what is both is confirmed."""
        if not reading.informative:
            return states
        self.sections.reach(reading)
        return within_budget(reading, states, lambda most: self._contracted(states, most))

    def _contracted(self, states: PoseSet, reading: Beams) -> PoseSet:
        confirmed, unconfirmed = (self._paved(states.boxes[rows], reading) for rows in (~states.unconfirmed, states.unconfirmed))
        if not len(confirmed):
            return unconfirmed
        if not len(unconfirmed):
            return confirmed
        return unite(confirmed, unconfirmed.without(confirmed.boxes))

    def _paved(self, boxes: Boxes, reading: Beams) -> PoseSet:
        pieces = list(self.sections.parts(boxes))
        searched: list[PoseSet] = []
        for number, (key, _, piece) in enumerate(pieces):
            searched.append(self._searched(self.sections[key], piece, reading, self.config.max_boxes - sum(map(len, searched))))
            if searched[-1].limited:
                ahead = (PoseSet(piece) for _, _, piece in pieces[number + 1 :])
                return self._coarsened(join([*searched, *ahead], reading.outliers), reading)
        return join(searched, reading.outliers)

    def _searched(self, tables: MapTables, boxes: Boxes, reading: Beams, max_boxes: int) -> PoseSet:
        """Return the cells in boxes that may hold a consistent pose; where a limit is reached, boxes that cover what is left, marked."""
        coarse = self.lattice.widths * _COARSE
        if not (boxes.width() > coarse).any():
            return self._tried(tables, self.lattice.bitmaps(boxes), boxes, reading)
        contractor = PoseContractor(reading, tables.occupied, tables.domain)
        left = reading.deadline.left_s
        # What the clock leaves half done is to be equally coarse everywhere: the next scan goes on from there.
        order: Order = "depth" if left is None else "breadth"
        paving = pave(contractor, boxes, coarse, order=order, max_boxes=max(max_boxes, 1), max_seconds=left, batch=_BATCH)
        if paving.limited:
            # A search that was stopped leaves large boxes: finer cells than it had boxes would say no more.
            return PoseSet(paving.boxes, limited=paving.limited)
        return self._tried(tables, self.lattice.bitmaps(paving.boxes), paving.boxes, reading)

    def _tried(self, tables: MapTables, bitmaps: CellBitmaps, boxes: Boxes, reading: Beams) -> PoseSet:
        """Return the cells that may hold a consistent pose; where they are too many, or the time is up, the boxes, marked."""
        deadline = Deadline(reading.deadline.left_s, _FIRST_BITMAPS)
        allowed, counts, total = [Boxes.none(3)], [np.empty(0, dtype=np.int16)], 0
        start = 0
        while start < len(bitmaps.keys):
            portion = deadline.portion(min(_CHUNK, len(bitmaps.keys) - start))
            if not portion:
                return PoseSet(boxes, limited="time")
            part = CellBitmaps(bitmaps.keys[start : start + portion], bitmaps.words[start : start + portion])
            words, least = count_cells(part, self.lattice, reading, tables.occupied, tables.domain)
            left = CellBitmaps(part.keys, words)
            total += len(left)
            if total > self.config.max_boxes:
                return PoseSet(boxes, limited="boxes")
            cells, bad = self._looked_along(tables, self.lattice.boxes(left), left.values(least), reading)
            allowed.append(cells)
            counts.append(bad)
            deadline.worked(portion)
            start += portion
        return PoseSet(Boxes.concatenate(allowed), bad=np.concatenate(counts), outliers=reading.outliers)

    def _coarsened(self, poses: PoseSet, reading: Beams) -> PoseSet:
        """Return what a search has left; if a limit has stopped it, as not too many coarse cells that cover it."""
        if not poses.limited:
            return poses
        boxes = poses.boxes
        most = min(2 * len(boxes), self._affordable if poses.limited == "time" else self.config.max_boxes)
        cells = self.lattice.cover(boxes, most, boxes.volume())
        return PoseSet(cells, limited=poses.limited, outliers=reading.outliers)

    def _looked_along(
        self, tables: MapTables, cells: Boxes, bad: npt.NDArray[np.int16], reading: Beams
    ) -> tuple[Boxes, npt.NDArray[np.int16]]:
        """Return the cells from which not too many beams are bad or blocked, and how many are at least."""
        if tables.bits is None:
            return cells, bad
        bad = count_blocked(cells, bad, reading, self.lattice.parts, tables.occupied, tables.bits)
        rows = bad <= reading.outliers
        return cells[rows], bad[rows]

    def refine(self, poses: PoseSet, reading: Beams) -> PoseSet:
        """Return what a scan has left, its cells cut back to their outermost pieces that may hold a consistent pose; perhaps nothing.

        Only a set of few cells is worth it. Cells that are carried on are not cut: a set that reaches a little farther forgives more.
        """
        halvings = self.config.precision.halvings
        if not halvings or not reading.informative or poses.limited or not 0 < len(poses) <= _REFINED or poses.unconfirmed.any():
            return poses
        allowed = reading.allowing(poses.outliers)
        cut, kept = refine_border(poses.boxes, self.lattice, self.sections, allowed, halvings)
        left = replace(poses, boxes=cut)[kept]
        whole = mend(poses.boxes, self.lattice, cut, kept, left.clusters)
        return left if whole is kept else replace(poses, boxes=cut)[whole]

    def symmetries(self) -> tuple[Pose, ...]:
        """Return the rotations of the grid's frame after which no scan can tell the difference."""
        return symmetries(self.grid, self._allowed)

    def in_domain(self, pose: Pose) -> bool:
        """Return whether a position in the grid's frame lies in a cell of the domain."""
        at = Boxes.of([(pose.x, pose.x), (pose.y, pose.y)])
        return any(bool(self.sections[key].domain.meet(part)[0]) for key, _, part in self.sections.parts(at))

    def unite(self, allowed: PoseSet, predicted: PoseSet) -> PoseSet:
        """Return poses that a scan allows and, as unconfirmed ones, poses of which the odometry alone is known."""
        return unite(allowed, predicted)

    def exhausted(self, states: PoseSet, motion: Motion | None) -> bool:
        """Return whether a step from here searches the whole map."""
        return motion is None and states is self._universe

    def empty(self, states: PoseSet) -> bool:
        """Return whether no pose is left."""
        return not len(states)
