"""`NoisyMap`: where a robot with errors can go from each cell: generalized cell mapping with sets in place of probabilities.

A vertex is a cell and an interval of headings. The robot is *anywhere* in the closed cell, in any heading of the closed interval, and is
not put back to the centre: whatever a robot with real geometry does within the bounds, its vertices are among the successors.
"""

from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from math import ceil, floor

import numpy as np
import numpy.typing as npt

from ial.bouncing.cells.cell_ways import CellWays
from ial.bouncing.cells.headings import Headings
from ial.bouncing.cells.set_graph import SetGraph, rows_of
from ial.bouncing.execution_bounds import ExecutionBounds
from ial.maps.polygons.environment import Environment
from ial.maps.polygons.raster import Raster

Arcs = tuple[npt.NDArray[np.int64], npt.NDArray[np.int64]]


@dataclass(frozen=True, eq=False)
class NoisyMap:
    """The set-valued cell map of one environment, for a point or a disk.

    Vertex number heading · cells + cell is a cell with the headings from half a distance before to half a distance after a heading. If
    the clock can count too many steps, further layers of as many vertices follow: robots that stand at a wall, with an unreported bump.

    Parameters
    ----------
    environment
        The free space; the boundaries of all polygons are walls, and no two polygons share more than points.
    cell
        The width of a cell in metres.
    headings
        The headings, the bouncing angle and the step.
    bounds
        What the robot may do wrong.
    radius
        The radius of the robot in metres; 0 for a point.
    """

    environment: Environment
    cell: Fraction
    headings: Headings
    bounds: ExecutionBounds = field(default_factory=ExecutionBounds)
    radius: Fraction = Fraction(0)

    @cached_property
    def ways(self) -> CellWays:
        """Where the robot can come to in a step, and where it can bump.

        Raises
        ------
        ConfigError
            If the radius is negative.
        MapError
            If the robot fits nowhere, or there are too many walls.
        """
        return CellWays.of(self.environment, self.cell, self.headings, self.bounds, self.radius)

    @property
    def raster(self) -> Raster:
        """The cells that hold all places of the centre of the robot."""
        return self.ways.raster

    @cached_property
    def graph(self) -> SetGraph:
        """The successors.

        Raises
        ------
        ConfigError, MapError
            As `ways`.
        FilterError
            If there would be too many.
        """
        moves, contacts = self._moves
        count, layers = self.headings.count * self._cells, self.bounds.count
        total = count * (layers + 1)
        still, bumped = [moves], [self._turned(contacts)]
        late = moves
        for layer in range(layers):  # steps that the clock did not count, and those that it counted at the wall
            bumped.append(self._turned(_chained(late, contacts, count)))
            late = _chained(late, moves, count)
            standing = np.arange(count, dtype=np.int64)
            begin = contacts if layer == 0 else (standing + layer * count, standing)
            still.append((begin[0], begin[1] + (layer + 1) * count))
            turned = self._turned((standing, standing))
            bumped.append((turned[0] + (layer + 1) * count, turned[1]))
        rows = [rows_of(*_together(arcs), total) for arcs in (still, bumped)]
        return SetGraph((rows[0][0], rows[1][0]), (rows[0][1], rows[1][1]), count)

    def vertices(self, x_m: Fraction, y_m: Fraction, turn: Fraction) -> list[int]:
        """Return the vertices that hold a pose: several on the line between cells or headings, none outside of the free space."""
        column, row = (x_m - self.raster.x) / self.cell, (y_m - self.raster.y) / self.cell
        heading = turn * self.headings.count
        rows, columns = self.raster.free.shape
        return [
            (t % self.headings.count) * self._cells + int(self._numbers[r, c])
            for t in range(ceil(heading - Fraction(1, 2)), floor(heading + Fraction(1, 2)) + 1)
            for r in range(max(ceil(row) - 1, 0), min(floor(row) + 1, rows))
            for c in range(max(ceil(column) - 1, 0), min(floor(column) + 1, columns))
            if self._numbers[r, c] >= 0
        ]

    @cached_property
    def _cells(self) -> int:
        return int(np.count_nonzero(self.raster.free))

    @cached_property
    def _numbers(self) -> npt.NDArray[np.int64]:
        numbers = np.full(self.raster.free.shape, -1, dtype=np.int64)
        numbers[self.raster.free] = np.arange(self._cells)
        return numbers

    @cached_property
    def _moves(self) -> tuple[Arcs, Arcs]:
        """Where full steps can lead, and where the robot can touch a wall during a step; the heading stays."""
        free = np.ones_like(self.raster.free)
        moves = [self._reached(heading, self.ways.moves[heading], free) for heading in range(self.headings.count)]
        contacts = [
            self._reached(heading, self.ways.contacts[heading], self.ways.bumping[heading]) for heading in range(self.headings.count)
        ]
        return _together(moves), _together(contacts)

    def _reached(self, heading: int, ways: npt.NDArray[np.int64], wanted: npt.NDArray[np.bool_]) -> Arcs:
        """Return the arcs along ways to the wanted cells."""
        begins, ends = [], []
        for way in ways.tolist():
            rows, columns = np.nonzero(self.ways.open[way])
            across, up = self.ways.offsets[way].tolist()
            kept = wanted[rows + up, columns + across]
            begins.append(self._numbers[rows[kept], columns[kept]])
            ends.append(self._numbers[rows[kept] + up, columns[kept] + across])
        base = heading * self._cells
        return np.concatenate(begins) + base, np.concatenate(ends) + base

    def _turned(self, arcs: Arcs) -> Arcs:
        """Return arcs whose ends are turned by the bouncing angle and its error."""
        spread = ceil(self.bounds.turn_deg * self.headings.count / 360)
        headings, cells = np.divmod(arcs[1], self._cells)
        wrong = {each % self.headings.count for each in range(-spread, spread + 1)}
        turns = [self.headings.turn + each for each in sorted(wrong)]
        return _together([(arcs[0], (headings + turn) % self.headings.count * self._cells + cells) for turn in turns])


def _together(arcs: list[Arcs]) -> Arcs:
    return np.concatenate([begins for begins, _ in arcs]), np.concatenate([ends for _, ends in arcs])


def _chained(first: Arcs, second: Arcs, count: int) -> Arcs:
    """Return the arcs that lead along one of the first and then along one of the second."""
    starts, ends = rows_of(*second, count)
    sizes = (starts[1:] - starts[:-1])[first[1]]
    begins = np.repeat(first[0], sizes)
    at = np.arange(len(begins)) - np.repeat(np.cumsum(sizes) - sizes, sizes) + np.repeat(starts[first[1]], sizes)
    keys = np.unique(begins * count + ends[at])
    return keys // count, keys % count
