"""`CellWays`: to which cells a robot with bounded errors can come in one step, and where it can bump on the way."""

from dataclasses import dataclass
from fractions import Fraction
from math import ceil, floor

import numpy as np
import numpy.typing as npt

from ial.bouncing.cells.headings import Headings
from ial.bouncing.cells.open_ways import open_ways
from ial.bouncing.execution_bounds import ExecutionBounds
from ial.contractors.intervals.interval import Interval
from ial.contractors.intervals.trigonometric import TWO_PI_LOWER, TWO_PI_UPPER, cos, sin
from ial.contractors.margins import ROUNDINGS
from ial.errors import ConfigError, MapError
from ial.maps.polygons.environment import Environment
from ial.maps.polygons.raster import MaskArray, Raster, cover
from ial.maps.polygons.wall_contact import WallContact
from ial.maps.polygons.walls import Walls

IntArray = npt.NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class CellWays:
    """Ways between cells, the same from every cell but for the walls: all that a robot can do that is anywhere in the closed cell.

    Parameters
    ----------
    raster
        The cells that hold all places of the centre of the robot.
    offsets
        (columns, rows) from the begin of a way to its end, int64 of shape (ways, 2).
    open
        From which cells each way can be gone, bool of shape (ways, rows, columns).
    moves, contacts
        For each heading, the numbers of the ways that a full step can lead along, and those of a part of a step that ends at a wall.
    bumping
        The cells in which a robot can touch a wall that its heading leads into, for each heading, bool of shape (headings, rows, columns).
    """

    raster: Raster
    offsets: IntArray
    open: MaskArray
    moves: tuple[IntArray, ...]
    contacts: tuple[IntArray, ...]
    bumping: MaskArray

    def __repr__(self) -> str:
        return f"<CellWays: {len(self.offsets)} ways in {len(self.moves)} headings between {int(self.raster.free.sum())} cells>"

    @classmethod
    def of(cls, environment: Environment, cell: Fraction, headings: Headings, bounds: ExecutionBounds, radius: Fraction) -> "CellWays":
        """Return the ways of a robot in an environment.

        Raises
        ------
        ConfigError
            If the radius is negative.
        MapError
            If the robot fits nowhere, or there are too many walls.
        """
        if radius < 0:
            raise ConfigError(f"the radius of the robot is {float(radius):g} m; give 0 for a point, or a positive number")
        walls, covered = Walls.of(environment), cover(environment, cell)
        contact = WallContact.of(walls, covered, radius)
        raster = Raster(covered.free & ~contact.overlapping, covered.cell, covered.x, covered.y)
        if not raster.free.any():
            raise MapError(f"a robot of radius {float(radius):g} m fits nowhere; use a smaller radius")
        shifts = [_shifts(headings, bounds, heading) for heading in range(headings.count)]
        offsets, numbers = np.unique(np.concatenate([each for pair in shifts for each in pair]), axis=0, return_inverse=True)
        ends = np.cumsum([len(each) for pair in shifts for each in pair])[:-1]
        ways = np.split(numbers.reshape(-1), ends)
        bumping = np.stack([_bumping(walls, contact, heading, headings.count) for heading in range(headings.count)])
        opened = open_ways(walls, raster, offsets)
        return cls(raster, offsets, opened, tuple(ways[::2]), tuple(ways[1::2]), bumping & raster.free)


def _shifts(headings: Headings, bounds: ExecutionBounds, heading: int) -> tuple[IntArray, IntArray]:
    """Return the offsets of the cells that one cell, moved by a full step or by a part of one, can meet; cells are of width 1."""
    shortest, longest = (Interval(headings.step * (1 + part)) for part in (-bounds.step, bounds.step))
    turn = Interval(Fraction(2 * heading - 1, 2 * headings.count), Fraction(2 * heading + 1, 2 * headings.count))
    angle = Interval(TWO_PI_LOWER, TWO_PI_UPPER) * turn
    waves = [Interval.of_bounds(*wave(angle.lower, angle.upper)) for wave in (cos, sin)]
    full, part = [wave * (shortest | longest) for wave in waves], [wave * (Interval(0) | longest) for wave in waves]
    return _met(full), _met(part)


def _met(shift: list[Interval]) -> IntArray:
    across, up = (np.arange(floor(each.lower), ceil(each.upper) + 1) for each in shift)
    return np.stack(np.meshgrid(across, up, indexing="ij"), axis=-1).reshape(-1, 2)


def _bumping(walls: Walls, contact: WallContact, heading: int, count: int) -> MaskArray:
    """Return the cells in which the robot can touch a wall that a heading of the interval leads into.

    If it leads into a reflex corner, it leads into one of the two walls, wherever the disk touches the corner.
    """
    outward = walls.angles - 0.5 * np.pi
    off = np.abs(np.remainder(2.0 * np.pi * heading / count - outward + np.pi, 2.0 * np.pi) - np.pi)
    into = off <= np.pi / count + 0.5 * np.pi + walls.slants + 16.0 * ROUNDINGS
    cells = np.zeros(contact.overlapping.shape, dtype=np.bool_)
    for wall in np.flatnonzero(into):
        cells.flat[contact.touching[wall]] = True
    return cells
