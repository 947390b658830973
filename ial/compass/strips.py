"""`Strips`: the free space cut by the lines through its corners in one direction, and which wall is ahead of which in each strip."""

from bisect import bisect_left
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from ial.compass.primitive import Direction
from ial.contractors.margins import ROUNDINGS
from ial.maps.polygons.exact.rational import Rational, rational
from ial.maps.polygons.exact.shooter import BoundaryPoint, Shooter

STAYS = -1  # ahead of a wall that the direction leads into
NOT_HERE = -2  # the wall does not reach the strip


class Strips:
    """What a motion in one direction does to the walls of a polygon.

    The level of a point is its distance to the left of the line through the origin in the direction, in a unit of its own. Between two
    successive levels of corners lies a strip, in which the walls have one order; each wall with free space ahead is followed by the wall at
    which the robot stops. This is the line of O'Kane 2005 (section 3.1, algorithm 3.1), which sweeps parallel to the direction, not
    perpendicular to the piece as printed there; for all pieces at once.

    Parameters
    ----------
    shooter
        The walls.
    direction
        Where the robot drives.

    Attributes
    ----------
    levels
        The levels of corners, each once, ascending.
    rank
        For each corner, the number of its level.
    ahead
        For each strip and edge: the edge at which the robot stops, `STAYS` or `NOT_HERE`.
    """

    def __init__(self, shooter: Shooter, direction: Direction) -> None:
        self.shooter = shooter
        self.direction = direction
        ux, uy = direction
        level = [ux * y - uy * x for x, y in shooter.corners]
        along = [ux * x + uy * y for x, y in shooter.corners]
        self.levels = sorted(set(level))
        place = {each: number for number, each in enumerate(self.levels)}
        self.rank = [place[each] for each in level]
        self._level, self._along = level, along
        self.ahead = self._order()
        self._passed: dict[tuple[int, int], BoundaryPoint] = {}

    def __repr__(self) -> str:
        return f"<Strips: {len(self.levels) - 1} in direction {self.direction}>"

    def turn(self, edge: int) -> int:
        """Return 1 if the free space beside an edge lies ahead, 0 if the edge is parallel, −1 if the robot drives into it."""
        begin, end = self.rank[edge], self.rank[self.shooter.after[edge]]
        return (begin > end) - (begin < end)

    def level(self, edge: int, part: Rational) -> Rational:
        """Return the level of a point on an edge."""
        begin = self._level[edge]
        return begin + part * (self._level[self.shooter.after[edge]] - begin)

    def part(self, edge: int, level: Rational) -> Rational:
        """Return which part of an edge lies before the point of it at a level; not of a parallel edge."""
        begin = self._level[edge]
        return (level - begin) / (self._level[self.shooter.after[edge]] - begin)

    def strip(self, level: Rational) -> tuple[int, bool]:
        """Return the strip of a level, and whether it is the level of a corner: the lower one of its strip then."""
        at = bisect_left(self.levels, level)
        corner = at < len(self.levels) and self.levels[at] == level
        return (at if corner else at - 1), corner

    def passed(self, places: Sequence[tuple[int, int]]) -> list[BoundaryPoint]:
        """Return where robots stop that start inside of edges at the levels of some corners.

        Parameters
        ----------
        places
            For each robot the number of the edge, and that of the level.
        """
        new = [each for each in dict.fromkeys(places) if each not in self._passed]
        starts = [self.shooter.on_edge(edge, self.part(edge, rational(self.levels[rank]))).place for edge, rank in new]
        self._passed.update(zip(new, self.shooter.shoot_all(starts, [self.direction] * len(new)), strict=True))
        return [self._passed[each] for each in places]

    def _order(self) -> npt.NDArray[np.int32]:
        """Sort the walls of each strip by doubles, and exactly where these do not tell."""
        count, strips = len(self.shooter), len(self.levels) - 1
        low_along = min(self._along)
        span = max(self.levels[-1] - self.levels[0], max(self._along) - low_along)
        across = np.array([float(rational(each - self.levels[0]) / span) for each in self.levels])
        rank = np.array(self.rank)
        after = np.array(self.shooter.after)
        along = np.array([float(rational(each - low_along) / span) for each in self._along])
        begin, end = rank, rank[after]
        middle = (across[:-1] + across[1:])[:, None] / 2
        rise = across[end] - across[begin]
        flat = rise == 0.0  # parallel, or too close to it for doubles
        slope = (along[after] - along) / np.where(flat, 1.0, rise)
        way = along + (middle - across[begin]) * slope
        numbers = np.arange(strips)[:, None]
        here = (np.minimum(begin, end) <= numbers) & (numbers < np.maximum(begin, end))
        way = np.where(here, way, np.inf)
        # Levels and ways ahead are from 0 to 1, each rounded once. A rise errs by three roundings, and so does the slope by as much as a
        # part of the rise; a point of the wall is at most the rise away from its end.
        error = np.where(flat, np.inf, ROUNDINGS * (1.0 + np.abs(slope)))
        order = np.argsort(way, axis=1, kind="stable")
        held = here.sum(axis=1)
        sorted_way, sorted_error = np.take_along_axis(way, order, 1), error[order]
        with np.errstate(invalid="ignore"):
            unsure = ~(np.diff(sorted_way, axis=1) > sorted_error[:, 1:] + sorted_error[:, :-1])
        unsure &= np.arange(1, count) < held[:, None]
        for strip in np.flatnonzero(unsure.any(axis=1)).tolist():
            order[strip, : held[strip]] = self._sorted(strip, order[strip, : held[strip]].tolist())
        ahead = np.full((strips, count + 1), NOT_HERE, dtype=np.int32)  # the last column takes what belongs to no wall
        following = np.concatenate([order[:, 1:], np.full((strips, 1), STAYS)], axis=1)
        leads_away = (begin > end)[order]
        targets = np.where(np.arange(count) < held[:, None], order, count)
        np.put_along_axis(ahead, targets, np.where(leads_away, following, STAYS).astype(np.int32), 1)
        return ahead[:, :count]

    def _sorted(self, strip: int, edges: list[int]) -> list[int]:
        """Sort the walls of a strip exactly, by where they are in its middle."""
        middle = rational(self.levels[strip] + self.levels[strip + 1]) / 2
        ways = {}
        for edge in edges:
            begin, end = self._along[edge], self._along[self.shooter.after[edge]]
            ways[edge] = begin + self.part(edge, middle) * (end - begin)
        return sorted(edges, key=ways.__getitem__)
