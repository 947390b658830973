"""`CellMap`: where a bouncing robot goes from each cell of its configuration space (modified simple cell mapping, Alam et al. 2017).

Departures from Algorithm 1 and equation 4 of the paper, as printed there:

- A robot that cannot move stays where it is and turns; equation 4 lets it leave the free space by one step.
- The robot begins every step at the centre of its cell (section VI says so); the algorithm would do so for the first cell only.
- The label of an arc says whether the robot bumped. The algorithm compares headings, which would miss a turn by 360°.
- Offsets are exact whole numbers, with halves away from zero; see `Headings`.
"""

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

import numpy as np
import numpy.typing as npt

from ial.bouncing.cells.corner import Corner, passed_cells
from ial.bouncing.cells.graph import MOST_VERTICES, LabelledGraph
from ial.bouncing.cells.heading_classes import HeadingClasses
from ial.bouncing.cells.headings import Headings
from ial.bouncing.start import Start
from ial.contractors import threads
from ial.contractors.kernels import kernel
from ial.errors import ConfigError, MapError
from ial.maps.polygons.raster import Raster

IntArray = npt.NDArray[np.int32]

_LONGEST_STEP = 2**12  # cells; the grid is padded by as many on each side


@kernel
def _map_cells(start, stop, index, places, passed, ends, turned, arcs):  # type: ignore[no-untyped-def]
    """Write the arcs of vertices start … stop − 1.

    `index` numbers the free cells of a padded grid, −1 elsewhere; `passed[c]` holds distances in it that must be free for class c, the end
    of the step last, and `ends[c]` says how many.
    """
    cells = len(places)
    at = start
    while at < stop:
        mode = at // cells
        until = min(stop, (mode + 1) * cells)
        base = mode * cells
        last = ends[mode] - 1
        for vertex in range(at, until):
            place = places[vertex - base]
            to = index[place + passed[mode, last]]
            for other in range(last):
                to = min(to, index[place + passed[mode, other]])  # −1 as soon as one is not free
            target = base + index[place + passed[mode, last]]
            arcs[vertex] = target if to >= 0 else ~(turned[mode] * cells + vertex - base)
        at = until


@dataclass(frozen=True, eq=False)
class CellMap:
    """The cell map of one environment.

    A vertex is a free cell with a class of headings: number class · cells + free cell, the free cells row by row from below.

    Parameters
    ----------
    raster
        The free cells.
    headings
        The headings, the bouncing angle and the step.
    corner
        What a step must not touch, see `passed_cells`.
    merge
        Take headings that cannot be told apart as one vertex, see `HeadingClasses`. The automaton keeps its states and uncertainties, and
        takes a fraction of the time.

    Raises
    ------
    MapError
        If no cell is free, a step leads over more than 4096 cells, or there are more than 2³¹ − 1 vertices.
    """

    raster: Raster
    headings: Headings
    corner: Corner = "segment"
    merge: bool = False

    def __post_init__(self) -> None:
        free = int(np.count_nonzero(self.raster.free))
        if not free:
            raise MapError("no cell is free, so the robot can be nowhere; use smaller cells, a smaller radius or the rule 'centre'")
        if (longest := int(np.abs(self.classes.offsets).max())) > _LONGEST_STEP:
            raise MapError(f"a step leads over {longest} cells, at most {_LONGEST_STEP} are supported; use shorter steps or larger cells")
        if free * len(self.classes) > MOST_VERTICES:
            raise MapError(f"{free} free cells × {len(self.classes)} headings are too many vertices; at most {MOST_VERTICES} are supported")

    @cached_property
    def classes(self) -> HeadingClasses:
        """The headings that one vertex stands for."""
        return HeadingClasses.merged(self.headings) if self.merge else HeadingClasses.single(self.headings)

    @cached_property
    def cells(self) -> tuple[IntArray, IntArray]:
        """The row and the column of each free cell, int32 each."""
        rows, columns = np.nonzero(self.raster.free)
        return rows.astype(np.int32), columns.astype(np.int32)

    @cached_property
    def graph(self) -> LabelledGraph:
        """C and L, computed in parallel when first asked for."""
        margin = int(np.abs(self.classes.offsets).max())
        free = np.pad(self.raster.free, margin)
        places = np.flatnonzero(free)
        index = np.full(free.size, -1, dtype=np.int32)
        index[places] = np.arange(len(places), dtype=np.int32)
        lists = [[y * free.shape[1] + x for x, y in passed_cells(int(dx), int(dy), self.corner)] for dx, dy in self.classes.offsets]
        ends = np.array([len(each) for each in lists], dtype=np.int64)
        passed = np.zeros((len(lists), ends.max()), dtype=np.int64)
        for row, each in enumerate(lists):
            passed[row, : len(each)] = each
        arcs = np.empty(len(places) * len(lists), dtype=np.int32)
        turned = self.classes.turned.astype(np.int64)
        threads.run(_map_cells, len(arcs), index, places.astype(np.int32), passed, ends, turned, arcs, minimum=2**14)
        weights = np.repeat(self.classes.sizes, len(places)) if self.merge else None
        return LabelledGraph(arcs, weights)

    def configurations(self, vertices: npt.ArrayLike) -> tuple[IntArray, IntArray, IntArray]:
        """Return the row, the column and the class of headings of vertices."""
        classes, free = np.divmod(np.asarray(vertices, dtype=np.int32), len(self.cells[0]))
        return self.cells[0][free], self.cells[1][free], classes

    def vertex(self, row: int, column: int, heading: int) -> int:
        """Return the vertex of a cell and a heading.

        Raises
        ------
        ConfigError
            If the cell is not free, or there is no such heading.
        """
        rows, columns = self.raster.free.shape
        if not (0 <= row < rows and 0 <= column < columns and self.raster.free[row, column] and 0 <= heading < self.headings.count):
            raise ConfigError(f"row {row}, column {column}, heading {heading} is no configuration; give a free cell and a heading")
        before = np.count_nonzero(self.raster.free[:row]) + np.count_nonzero(self.raster.free[row, :column])
        return int(self.classes.of[heading]) * len(self.cells[0]) + int(before)

    def beginnings(self, start: Start) -> IntArray:
        """Return the vertices in which a robot can start, int32: of which the centre and one of the headings are possible."""
        rows, columns = self.cells
        places = [self.centre(row, column) for row, column in zip(rows.tolist(), columns.tolist(), strict=True)] if start.region else []
        held = np.array([start.holds_place(x, y) for x, y in places]) if start.region else np.ones(len(rows), dtype=np.bool_)
        facing = np.zeros(len(self.classes), dtype=np.bool_)
        for heading in range(self.headings.count):
            angle = self.headings.angle_deg(heading)
            facing[self.classes.of[heading]] |= start.holds_heading(angle, angle)
        return np.flatnonzero(facing[:, None] & held).astype(np.int32)

    def centre(self, row: int, column: int) -> tuple[Fraction, Fraction]:
        """Return the centre of a cell in the frame of the environment, in metres."""
        half = Fraction(1, 2)
        return self.raster.x + (column + half) * self.raster.cell, self.raster.y + (row + half) * self.raster.cell
