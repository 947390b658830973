"""`CellChoice`: what the exact filter of some cells and headings comes to, and whether it is right for a robot."""

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction

from ial.bouncing.automata.determinization import TooManyStatesError
from ial.bouncing.cells.headings import Headings
from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.exports.c_tables import CTables
from ial.bouncing.exports.exported_filter import ExportedFilter
from ial.bouncing.filters.building import filter_of_cells
from ial.bouncing.start import ANYWHERE
from ial.errors import MapError
from ial.maps.polygons.environment import Environment
from ial.maps.polygons.raster import Raster, Rule

MOST_CONFIGURATIONS = 2**22
_MOST_VISITS = 2**28  # of vertices; some seconds
NARROWEST = Fraction(3, 5)  # of a cell: the narrowest disk with which `bench/bouncing_disks.py` has tried the filter


@dataclass(frozen=True)
class CellChoice:
    """One choice, and what its filter takes as a C header.

    Parameters
    ----------
    cell_m
        The width of a cell in metres.
    headings
        How many headings there are.
    rule
        When a cell is free.
    refusal
        Why there is no such filter, or none was tried; None if there is one.
    faults
        Why the filter tells this robot wrong places; empty if it is right for one that starts at the centre of a cell.
    offset_errors
        By how much steps of the cell map are beside real ones, see `Headings.offset_errors`.
    configurations
        How many there are; None if there is no filter to have them.
    states
        How many there are; None if that was not found out.
    more_than
        If it was not, there are certainly more than so many.
    flash_bytes, stepping_bytes, ram_bytes
        What all tables take, those for steps and colours alone, and the state; None without states.
    """

    cell_m: Fraction
    headings: int
    rule: Rule
    refusal: str | None = None
    faults: tuple[str, ...] = ()
    offset_errors: tuple[float, float] = (0.0, 0.0)
    configurations: int | None = None
    states: int | None = None
    more_than: int | None = None
    flash_bytes: int | None = None
    stepping_bytes: int | None = None
    ram_bytes: int | None = None

    @property
    def is_right(self) -> bool:
        """Whether the filter was made, and is right for the robot."""
        return self.states is not None and not self.faults

    @classmethod
    def of(
        cls, rasters: Mapping[str, Raster], headings: Headings, radius_m: Fraction, rule: Rule, faults: Iterable[str], most_states: int
    ) -> "CellChoice":
        """Build the filter; give up at so many states, at 2²² configurations, or after 2²⁸ visits of vertices.

        Parameters
        ----------
        rasters
            The free cells of the environments, see `all_free_cells`.
        headings
            The headings, the bouncing angle and the step.
        radius_m, rule
            What the cells were made with.
        faults
            See `faults_of`.
        most_states
            The number of states at which to give up.
        """
        configurations = headings.count * sum(int(raster.free.sum()) for raster in rasters.values())
        cell = next(iter(rasters.values())).cell
        choice = cls(cell, headings.count, rule, None, tuple(faults), headings.offset_errors, configurations)
        if configurations > MOST_CONFIGURATIONS:
            return replace(choice, refusal=f"more than {MOST_CONFIGURATIONS:,} configurations")
        try:
            made = filter_of_cells(rasters, headings, radius_m, rule, "segment", most_states, ANYWHERE, None, _MOST_VISITS)
        except MapError:  # cells and configurations were looked at
            return replace(choice, refusal="a step leads over too many cells")
        except TooManyStatesError as error:
            return replace(choice, more_than=error.states)
        tables = CTables.of(ExportedFilter.of(made), "bounce")
        flash, stepping, ram = tables.flash_bytes, tables.stepping_bytes, tables.ram_bytes
        return replace(choice, states=len(made.table) - 1, flash_bytes=flash, stepping_bytes=stepping, ram_bytes=ram)


def faults_of(
    lattice: Fraction | None, cell_m: Fraction, headings: Headings, radius_m: Fraction, rule: Rule, bounds: ExecutionBounds
) -> Iterator[str]:
    """Yield why an exact filter tells a robot wrong places, in words; nothing if it is right for one that starts at the centre of a cell.

    It is right for a disk about as wide as the cells, on a lattice that fits the walls, which goes one cell along the lattice at each step
    and makes no errors (`bench/bouncing_disks.py`).

    Parameters
    ----------
    lattice
        That of the walls, see `lattice_m`.
    cell_m, headings, rule
        The choice; `headings` knows the bouncing angle and the step.
    radius_m, bounds
        The robot, and what it may do wrong.
    """
    if bounds != ExecutionBounds():
        yield "it errs"
    if radius_m == 0:
        yield "it is a point, no disk about as wide as a cell"
    elif not NARROWEST * cell_m <= 2 * radius_m <= cell_m:
        yield "it is much narrower than a cell" if 2 * radius_m < cell_m else "it is wider than a cell"
    if lattice is None or (lattice / cell_m).denominator > 1:
        yield "walls are not on the lattice of cells"
    if any(x * y != 0 for x, y in headings.offsets.tolist()) or headings.offset_errors != (0.0, 0.0):
        yield "steps do not lead from centre to centre"
    elif headings.step != 1:
        yield "a step leads over several cells"
    if rule == "inside":
        yield "the rule inside moves bumps"


def lattice_m(environments: Iterable[Environment]) -> Fraction | None:
    """Return the width of the widest cells on whose lattice all walls run, in metres; None if some wall runs along none.

    The lattice of each environment begins at its lower left corner.
    """
    numbers: set[Fraction] = set()
    for environment in environments:
        x0, y0, _, _ = environment.bounds
        for ring in (ring for polygon in environment.polygons for ring in polygon.rings):
            if any(x != to_x and y != to_y for (x, y), (to_x, to_y) in zip(ring, (*ring[1:], ring[0]), strict=True)):
                return None
            numbers |= {x - x0 for x, _ in ring} | {y - y0 for _, y in ring}
    scale = math.lcm(*{each.denominator for each in numbers})
    return Fraction(math.gcd(*{int(each * scale) for each in numbers}), scale)
