"""`PieceMap`: the ray mode on a fixed grid: from which piece of wall a robot can come to which, by the number of steps between two bumps.

A set is then a row of bits, which a microcontroller can hold, and a bump takes one pass over a table of arcs. Pieces are fixed, so sets are
coarser than those of `RayModel`, which cuts them anew at each bump.
"""

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import ceil, floor

import numpy as np
import numpy.typing as npt

from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.rays.ray_model import RayModel
from ial.bouncing.rays.ray_set import RaySet
from ial.contractors.intervals.interval import Interval
from ial.contractors.intervals.trigonometric import TWO_PI_LOWER, TWO_PI_UPPER
from ial.contractors.margins import ABOVE, BELOW, ROUNDINGS
from ial.errors import ConfigError, FilterError, MapError
from ial.maps.polygons.environment import Environment
from ial.maps.polygons.ray_shooting import reaches
from ial.maps.polygons.walls import Walls

IntArray = npt.NDArray[np.int32]

MOST_PIECES = 2**20
MOST_STEPS = 2**16 - 1
_NARROWEST = 2.0**-100  # metres; with less there are too many parts, whatever it is
_NEVER_COARSER = 2**31  # pieces are fixed here, so no number of walls is too large for a set of them
_FULL_DEG = 360


@dataclass(frozen=True, eq=False)
class PieceMap:
    """Pieces of walls with headings. Piece number heading · parts + part is a part of a wall that robots leave in an interval of headings.

    Parameters
    ----------
    walls
        The walls.
    parts
        Into how many parts of equal width each wall is divided, int64 of shape (walls,), 0 if no robot can bump there; the parts of all
        walls are numbered through.
    headings
        How many intervals of headings there are; interval h is from h to h + 1 of so many parts of a full turn.
    turns
        By how many intervals a bump turns a robot at least and at most: from one interval it comes into all of these.
    starts
        Where the arcs of each piece begin, and their number at the end: int64 of shape (pieces + 1,).
    ends
        To which part each arc leads, int32.
    least, most
        After how many steps a robot can bump there, at least and at most, int32 each.
    """

    walls: Walls
    parts: npt.NDArray[np.int64]
    headings: int
    turns: tuple[int, int]
    starts: npt.NDArray[np.int64]
    ends: IntArray
    least: IntArray
    most: IntArray

    def __len__(self) -> int:
        return len(self.starts) - 1

    def __repr__(self) -> str:
        return f"<PieceMap of {len(self)} pieces and {len(self.ends)} arcs>"

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
    ) -> "PieceMap":
        """Return the map of a robot in an environment.

        Parameters
        ----------
        environment, bounce_deg, step_m, bounds, radius_m
            As for `RayModel`.
        part_m
            How wide a part of a wall is, at most, in metres.
        headings
            How many intervals of headings there are, at least 32.
        progress
            Called with how many numbers of steps were looked at, and of how many.

        Raises
        ------
        ConfigError
            As `RayModel`, or if parts have no width, or there are too few headings.
        FilterError
            If there would be too many pieces, or more than 65,535 steps between two bumps.
        MapError
            If there are too many walls, or the robot is too large.
        """
        if headings < 32:
            raise ConfigError(f"{headings} intervals of headings are too wide to follow rays; give at least 32")
        model = RayModel(environment, bounce_deg, step_m, bounds, _NEVER_COARSER, radius_m=radius_m)
        parts = parts_of(model.walls, part_m)
        if parts.sum() * headings > MOST_PIECES:
            raise FilterError(f"there would be {parts.sum() * headings} pieces; use fewer headings or wider parts, at most {MOST_PIECES}")
        part_deg = Fraction(_FULL_DEG, headings)
        turn_deg = bounce_deg % _FULL_DEG
        turns = floor((turn_deg - bounds.turn_deg) / part_deg), ceil((turn_deg + bounds.turn_deg) / part_deg)
        # A leg is not longer than the environment, so after so many steps no robot is still on its way.
        longest = ceil(Fraction(model.walls.scale) / (step_m * (1 - bounds.step))) + bounds.count + 1
        if longest > MOST_STEPS:
            raise FilterError(f"there can be {longest} steps between two bumps; use longer steps, so that there are at most {MOST_STEPS}")
        begins, ends, counts = _hits(model, grid_pieces(parts, headings), parts, longest, progress)
        keys, at = np.unique(begins * parts.sum() + ends, return_inverse=True)
        least, most = np.full(len(keys), np.iinfo(np.int32).max, dtype=np.int32), np.zeros(len(keys), dtype=np.int32)
        np.minimum.at(least, at.reshape(-1), counts)
        np.maximum.at(most, at.reshape(-1), counts)
        pieces, to = np.divmod(keys, parts.sum())
        starts = np.zeros(int(parts.sum()) * headings + 1, dtype=np.int64)
        np.cumsum(np.bincount(pieces, minlength=len(starts) - 1), out=starts[1:])
        return cls(model.walls, parts, headings, turns, starts, to.astype(np.int32), least, most)

    @cached_property
    def longest(self) -> IntArray:
        """After how many steps a robot from each piece has bumped at the latest, int32 of shape (pieces,); −1 if it cannot leave."""
        longest = np.full(len(self), -1, dtype=np.int32)
        np.maximum.at(longest, np.repeat(np.arange(len(self)), np.diff(self.starts)), self.most)
        return longest

    @cached_property
    def boxes_mm(self) -> npt.NDArray[np.int64]:
        """Rectangles that hold the parts of walls: least x and y, greatest x and y, int64 of shape (parts, 4).

        They are in millimetres, counted from the origin of the walls and rounded outward, but not below 0, where no wall is.
        """
        walls = self.walls
        wall = np.repeat(np.arange(len(walls)), self.parts)
        part = np.arange(len(wall)) - np.repeat(np.cumsum(self.parts) - self.parts, self.parts)
        sides = []
        for low in (walls.x, walls.y):
            ends = [low[wall] + (part + more) / self.parts[wall] * (low[walls.after] - low)[wall] for more in (0, 1)]
            # The margin is for far more roundings than those of an end and of its product with 1000.
            margin = 2.0 * walls.margin + walls.bulge[wall]
            least, most = np.minimum(*ends) - margin, np.maximum(*ends) + margin
            sides.append((np.maximum(np.floor(1000.0 * least), 0.0), np.ceil(1000.0 * most)))
        (x0, x1), (y0, y1) = sides
        return np.stack([x0, y0, x1, y1], axis=1).astype(np.int64)

    def bounds_m(self, pieces: npt.ArrayLike) -> tuple[float, float, float, float]:
        """Return a rectangle that holds all robots on some pieces: least x and y, greatest x and y, in the frame of the environment.

        It is rounded outward to whole millimetres from the origin of the walls, and those to doubles.
        """
        boxes = self.boxes_mm[np.asarray(pieces) % len(self.boxes_mm)]
        x, y = self.walls.origin
        sides = zip((*boxes[:, :2].min(axis=0).tolist(), *boxes[:, 2:].max(axis=0).tolist()), (x, y, x, y), strict=True)
        x0, y0, x1, y1 = (Interval(Fraction(mm, 1000) + corner) for mm, corner in sides)
        return x0.lower, y0.lower, x1.upper, y1.upper


def parts_of(walls: Walls, part_m: Fraction) -> npt.NDArray[np.int64]:
    """Return into how many parts, not wider than so many metres, each wall is divided; none where no robot can bump.

    Raises
    ------
    ConfigError
        If the width is not positive.
    FilterError
        If there would be more than 2²⁰ parts.
    """
    if part_m <= 0:
        raise ConfigError(f"parts of walls are {float(part_m):g} m wide; give a width greater than 0")
    parts = np.where(walls.stopping, np.ceil(walls.lengths / max(float(part_m), _NARROWEST)), 0.0)
    if parts.sum() > MOST_PIECES:
        raise FilterError(f"there would be {parts.sum():.0f} parts of walls; use wider parts, at most {MOST_PIECES} pieces are supported")
    return parts.astype(np.int64)


def grid_pieces(parts: npt.NDArray[np.int64], headings: int) -> RaySet:
    """Return all pieces; each holds its part of the wall and its headings, rounded outward."""
    walls = np.repeat(np.arange(len(parts), dtype=np.int32), parts)
    part = np.arange(len(walls)) - np.repeat(np.cumsum(parts) - parts, parts)
    first, last = part / parts[walls] * BELOW, np.minimum((part + 1) / parts[walls] * ABOVE, 1.0)
    heading = np.repeat(np.arange(headings), len(walls))
    low, high = heading / headings * TWO_PI_LOWER * BELOW, (heading + 1) / headings * TWO_PI_UPPER * ABOVE
    count = len(heading)
    lower, upper = np.stack([np.tile(first, headings), low], axis=1), np.stack([np.tile(last, headings), high], axis=1)
    none = np.zeros(count, dtype=np.int32)
    return RaySet(np.tile(walls, headings), lower, upper, none, none > 0, np.full(count, np.inf))


def _hits(
    model: RayModel, pieces: RaySet, parts: npt.NDArray[np.int64], longest: int, progress: Callable[[int, int], object] | None
) -> tuple[npt.NDArray[np.int64], ...]:
    """Return which parts robots can touch at a bump that left from which piece, and after how many steps; repeats are possible."""
    standing = model.may_stand(pieces)
    if not standing.any():
        raise MapError(f"a robot of radius {float(model.radius_m):g} m fits nowhere in the environment; check both")
    table, links = model.walls.table
    reach = reaches(pieces.walls, pieces.lower, pieces.upper, pieces.arriving, table, links, model.walls.margin)
    begins, ends, counts = [], [], []
    for count in range(longest):
        steps = np.full(len(pieces), count, dtype=np.int32)
        states = RaySet(pieces.walls, pieces.lower, pieces.upper, steps, pieces.arriving, reach)
        leaving = np.flatnonzero(standing & (reach >= model.legs.ways(states)[0]))
        pieces_of, hit = model.hits(states.only(leaving))
        rows, to = part_numbers(hit, parts)
        kept = standing[to]  # whether a robot can stand there is the same in all headings
        begins.append(leaving[pieces_of[rows[kept]]])
        ends.append(to[kept])
        counts.append(np.full(len(to[kept]), count, dtype=np.int64))
        if progress is not None:
            progress(count + 1, longest)
    return np.concatenate(begins), np.concatenate(ends), np.concatenate(counts)


def part_numbers(states: RaySet, parts: npt.NDArray[np.int64]) -> tuple[npt.NDArray[np.int64], npt.NDArray[np.int64]]:
    """Return the parts of walls that pieces of walls reach into: which piece, and the number of the part, for each pair."""
    per = parts[states.walls].astype(np.float64)
    # The ends are parts of 1: rounding them and the products changes the product by less than this part of the number of parts.
    first = np.clip(np.floor(states.lower[:, 0] * per - ROUNDINGS * per), 0.0, per - 1.0).astype(np.int64)
    last = np.clip(np.ceil(states.upper[:, 0] * per + ROUNDINGS * per) - 1.0, first, per - 1.0).astype(np.int64)
    many = last - first + 1
    rows = np.repeat(np.arange(len(many)), many)
    further = np.arange(len(rows)) - np.repeat(np.cumsum(many) - many, many)
    return rows, (np.cumsum(parts) - parts)[states.walls[rows]] + first[rows] + further
