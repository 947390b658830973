"""`Sections`: the tables of a map, which a large map has in parts, each made when it is first needed.

A section answers for the poses in a square of the map, its *core*. Its tables reach farther, so that the end of every beam from there
lies in them. A robot that is tracked through a campus needs the one or two sections around it; a search over all of it makes them one
after another.
"""

import math
from collections import OrderedDict
from collections.abc import Iterator
from dataclasses import dataclass
from typing import NoReturn

import numpy as np
import numpy.typing as npt
from scipy import ndimage

from ial.contractors.boxes import Boxes
from ial.contractors.intervals.trigonometric import PI_UPPER
from ial.contractors.margins import ABOVE
from ial.errors import ConfigError, MapError
from ial.lidar.evidence.beams import Beams
from ial.lidar.margins import MOST_CELLS
from ial.lidar.search.bit_columns import BitColumns
from ial.lidar.search.cell_bitmaps import BITMAP_COLUMNS
from ial.lidar.search.lattice import Lattice
from ial.maps.grids.cell_index import CellIndex
from ial.maps.grids.occupancy_grid import LARGEST_AREA, LARGEST_SIDE, OCCUPIED, OccupancyGrid

_ONE_SECTION = 1 << 26  # cells: a map with as many or fewer is one section (400 × 400 m at 5 cm), unless one of its sides is too long
_SIDE = 1 << 11  # cells along a side of a core, in larger maps
_KEPT = 1 << 26  # cells of the sections that are kept, and at least
_FEWEST_KEPT = 4  # sections, which meet in a corner
_AROUND = 2  # cells of the map around what a section must hold: one that is cut by its border, and one for what is rounded

MaskArray = npt.NDArray[np.bool_]
Key = tuple[int, int]


@dataclass(frozen=True, eq=False)
class MapTables:
    """The tables of a part of the map, in cells that are split so that a cell of the lattice consists of at least two along an axis.

    Parameters
    ----------
    occupied
        The cells that beams may end at.
    domain
        The cells in which the robot's base may be.
    bits
        The occupied cells for looking along beams; None where free space is not used.
    """

    occupied: CellIndex
    domain: CellIndex
    bits: BitColumns | None


class Sections:
    """The tables of a map.

    Parameters
    ----------
    grid
        The map.
    allowed
        The classes of cells in which the robot may be.
    split
        Into how many parts along an axis the cells of the map are divided.
    lattice
        The cells of the answers: the cores of the sections consist of them.
    radius_m
        The base is never nearer to an occupied cell than this.
    free_space
        Whether beams are looked along.
    position_m
        The precision that was asked for, to be named where it is too fine; by default the width of the lattice's cells.

    Raises
    ------
    ConfigError
        If the map, or the section around a robot of that radius, consists of more parts than can be counted.
    MapError
        If the robot fits nowhere.
    """

    def __init__(
        self,
        grid: OccupancyGrid,
        allowed: tuple[int, ...],
        split: int,
        lattice: Lattice,
        *,
        radius_m: float = 0.0,
        free_space: bool = True,
        position_m: float | None = None,
    ) -> None:
        self._grid = grid
        self._allowed = allowed
        self._split = split
        self._radius_m = radius_m
        self._free_space = free_space
        self._position_m = position_m or lattice.position_m
        self._made: OrderedDict[Key, MapTables] = OrderedDict()
        self.resolution = grid.resolution / split
        self._margin = math.ceil(radius_m / grid.resolution * ABOVE)  # cells of the map around a core
        self._cells = 1 << max(int(math.log2(_SIDE / lattice.parts)), int(math.log2(BITMAP_COLUMNS)))
        self._side_m = self._cells * lattice.position_m
        one = grid.rows * grid.columns * split**2 <= _ONE_SECTION and split * max(grid.rows, grid.columns) <= LARGEST_SIDE
        self._rows, self._columns = (1, 1) if one else (math.ceil(size / self._side_m * ABOVE) for size in (grid.height_m, grid.width_m))
        if not self._countable(split, self._margin):
            self._refuse("there are too many of these to be counted", self._margin)
        self._root = lattice.root(grid.width_m, grid.height_m)
        if radius_m and not any(self._roomy(*self._window((row, column))).any() for row, column in np.ndindex(self._rows, self._columns)):
            raise MapError(f"a robot with a radius of {radius_m:g} m fits nowhere in this map; give a smaller robot_radius_m")

    @property
    def one(self) -> bool:
        """Whether the whole map is one section."""
        return self._rows == self._columns == 1

    @property
    def universe(self) -> Boxes:
        """Boxes that hold every pose in the map, and whose repeated bisection meets the cells of the lattice."""
        if self.one:
            return self._root
        return self._cores(*np.divmod(np.arange(self._rows * self._columns), self._columns))

    def reach(self, beams: Beams) -> None:
        """See to it that the tables of every section hold all obstacles that the beams of a scan can end at or be blocked by.

        Raises
        ------
        ConfigError
            If they reach so far that a section would consist of too many parts.
        """
        if self.one:
            return
        far = (np.hypot(*beams.ends.T) + beams.errors.sum(axis=1)).max(initial=0.0) + beams.map_error_m
        far = max(far, 0.0 if beams.rays is None else beams.rays.reach_m)
        needed = math.ceil(far / self._grid.resolution * ABOVE)
        if needed <= self._margin:
            return
        wider = 1 << (needed - 1).bit_length()  # in a few steps at most, since the sections are made anew
        self._margin = wider if self._countable(self._split, wider) else needed
        if not self._countable(self._split, needed):
            self._refuse(f"beams of this scan reach {far:.3g} m, and all that is nearer is looked up at once", needed)
        self._made.clear()

    def _countable(self, split: int, margin: int) -> bool:
        """Return whether the tables of the map, and those of a section with a margin, have no more cells than can be counted.

        It is a question about the map's cells, each split into so many parts along an axis; they are always countable unsplit.
        """
        sides = []
        for cells in (self._grid.rows, self._grid.columns):
            core = cells if self.one else math.ceil(max(_SIDE, self._cells * 2) / split) + 1
            sides.append(split * min(cells, core + 2 * (margin + _AROUND)))
        small = max(sides) <= LARGEST_SIDE and math.prod(sides) <= LARGEST_AREA
        return split == 1 or (small and split * max(self._grid.rows, self._grid.columns) <= MOST_CELLS)

    def _refuse(self, why: str, margin: int) -> NoReturn:
        grid, split = self._grid, self._split
        fewer = next(number for number in range(min(split, LARGEST_SIDE), 0, -1) if self._countable(number, margin))
        raise ConfigError(
            f"precision.position_m is {self._position_m:g} m, so the map's {grid.columns} × {grid.rows} cells of {grid.resolution:g} m are "
            f"divided into {split} × {split} parts each, and {why}; give a precision.position_m of at least "
            f"{_rounded_up(2.0 * grid.resolution / fewer):g} m, or larger cells"
        )

    def parts(self, boxes: Boxes) -> Iterator[tuple[Key, npt.NDArray[np.intp], Boxes]]:
        """Yield the key of each section whose core some boxes meet, the rows of these, and the boxes cut to the core.

        Parameters
        ----------
        boxes
            Boxes (x, y, …) in the grid's frame, none of them empty. What of them lies outside of the map may be cut off.
        """
        if self.one:
            if len(boxes):
                yield (0, 0), np.arange(len(boxes)), boxes
            return
        first = np.empty((len(boxes), 2), dtype=np.int64)
        last = np.empty_like(first)
        for axis, cores in ((0, self._columns), (1, self._rows)):
            # Multiples of the side are exact, and so these are right: see `Lattice.cover`.
            low = np.floor(boxes.lower[:, axis] / self._side_m)
            high = np.ceil(boxes.upper[:, axis] / self._side_m) - 1.0
            first[:, axis] = np.clip(low, 0, cores - 1)
            last[:, axis] = np.clip(np.maximum(high, low), 0, cores - 1)
        across, along = (last - first + 1).T
        rows = np.repeat(np.arange(len(boxes)), across * along)
        number = np.arange(len(rows)) - np.repeat(np.cumsum(across * along) - across * along, across * along)
        column = first[rows, 0] + number % across[rows]
        row = first[rows, 1] + number // across[rows]
        names = row * self._columns + column
        for name in np.unique(names):
            key = divmod(int(name), self._columns)
            chosen = rows[names == name]
            core = self._cores(np.array(key[:1]), np.array(key[1:]))
            lower, upper = boxes.lower[chosen].copy(), boxes.upper[chosen].copy()
            lower[:, :2] = np.maximum(lower[:, :2], core.lower[:, :2])
            upper[:, :2] = np.minimum(upper[:, :2], core.upper[:, :2])
            cut = Boxes(lower, upper)
            inside = ~cut.empty
            if inside.any():
                yield key, chosen[inside], cut[inside]

    def _cores(self, rows: npt.NDArray[np.int64], columns: npt.NDArray[np.int64]) -> Boxes:
        """Return the poses in the cores of sections, whose bounds are exact."""
        turn, side = np.full(len(rows), PI_UPPER), self._side_m
        return Boxes(
            np.stack([columns * side, rows * side, -turn], axis=1), np.stack([(columns + 1) * side, (rows + 1) * side, turn], axis=1)
        )

    def _window(self, key: Key) -> tuple[slice, slice]:
        """Return which cells of the map the tables of a section hold."""
        if self.one:
            return slice(0, self._grid.rows), slice(0, self._grid.columns)
        margin = self._margin + _AROUND
        window = []
        for number, cells in zip(key, (self._grid.rows, self._grid.columns), strict=True):
            first, end = (edge * self._side_m / self._grid.resolution for edge in (number, number + 1))
            window.append(slice(max(0, math.floor(first) - margin), min(cells, math.ceil(end) + margin)))
        return window[0], window[1]

    def __getitem__(self, key: Key) -> MapTables:
        """Return a section; it is made if need be, and others may be forgotten."""
        if key not in self._made:
            self._made[key] = self._make(*self._window(key))
            while len(self._made) > _FEWEST_KEPT and sum(tables.occupied.cells.table.size for tables in self._made.values()) > _KEPT:
                self._made.popitem(last=False)
        self._made.move_to_end(key)
        return self._made[key]

    def _make(self, rows: slice, columns: slice) -> MapTables:
        origin = (rows.start * self._split, columns.start * self._split)
        occupied = self._divided(self._grid.cells[rows, columns] == OCCUPIED)
        domain = self._divided(self._roomy(rows, columns))
        whole = (self._grid.rows * self._split, self._grid.columns * self._split)
        return MapTables(
            CellIndex(occupied, self.resolution, origin=origin, whole=whole),
            CellIndex(domain, self.resolution, compact=True, origin=origin, whole=whole),
            BitColumns(occupied) if self._free_space else None,
        )

    def _divided(self, mask: MaskArray) -> MaskArray:
        return mask if self._split == 1 else mask.repeat(self._split, axis=0).repeat(self._split, axis=1)

    def _roomy(self, rows: slice, columns: slice) -> MaskArray:
        """Return the allowed cells without those from everywhere in which the robot would touch an obstacle.

        From no point of a cell is a closed occupied cell farther than their middles are apart.
        """
        cells = self._grid.cells[rows, columns]
        allowed = np.isin(cells, self._allowed)
        obstacles = cells == OCCUPIED
        if not self._radius_m or not obstacles.any():
            return allowed
        distance = ndimage.distance_transform_edt(~obstacles) * (self._grid.resolution * ABOVE)
        return np.asarray(allowed & (distance >= self._radius_m))


def _rounded_up(value: float) -> float:
    """Return a number of three digits that is not below a positive one."""
    digits = 2 - math.floor(math.log10(value))
    return math.ceil(value * 10.0**digits) / 10.0**digits
