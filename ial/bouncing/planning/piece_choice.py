"""`PieceChoice`: what the set filter of a robot with real geometry comes to, for some parts of walls and headings."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction

from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.exports.piece_source import PieceTables
from ial.bouncing.rays.piece_map import PieceMap, parts_of
from ial.maps.polygons.environment import Environment
from ial.maps.polygons.walls import Walls

_MOST_WORK = 2**23  # pieces times numbers of steps; some ten seconds


@dataclass(frozen=True)
class PieceChoice:
    """One choice, and what its filter takes as a C header.

    Parameters
    ----------
    part_m
        The width of a part of a wall, at most, in metres.
    headings
        How many intervals of headings there are.
    pieces
        How many pieces there are.
    flash_bytes, ram_bytes
        What the tables and the sets take; None if that was too much work to find out.
    """

    part_m: Fraction
    headings: int
    pieces: int
    flash_bytes: int | None = None
    ram_bytes: int | None = None

    @classmethod
    def of(
        cls,
        environment: Environment,
        bounce_deg: Fraction,
        step_m: Fraction,
        bounds: ExecutionBounds,
        part_m: Fraction,
        headings: int,
        radius_m: Fraction = Fraction(0),
        progress: Callable[[int, int], object] | None = None,
    ) -> "PieceChoice":
        """Make the map of pieces, unless these times the numbers of steps between two bumps are more than 2²³.

        Parameters and errors are those of `PieceMap.of`.
        """
        walls = Walls.of(environment, radius_m)
        pieces = int(parts_of(walls, part_m).sum()) * headings
        if pieces * math.ceil(Fraction(walls.scale) / (step_m * (1 - bounds.step))) > _MOST_WORK:
            return cls(part_m, headings, pieces)
        tables = PieceTables.of(PieceMap.of(environment, bounce_deg, step_m, bounds, part_m, headings, radius_m, progress), "bounce")
        return cls(part_m, headings, pieces, tables.flash_bytes, tables.ram_bytes)
