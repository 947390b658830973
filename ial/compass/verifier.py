"""`verify`: whether a localizing sequence is one, by slow code that shares nothing with the planner but the record of what it claims.

The planner sweeps the strips between corners and shoots rays by the sides of corners. Here a ray is cut wherever it meets the line of a
wall, and goes on as long as the middles of the parts lie in the closed polygon, which is counted out edge by edge; a piece of a wall is cut
at the level of every corner, whether that is seen from it or not. All numbers are fractions of the standard library.
"""

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import Protocol

from ial.errors import SequenceError

Point = tuple[Fraction, Fraction]
Wall = tuple[tuple[int, int], tuple[int, int]]
Span = tuple[Fraction, Fraction]


class Rings(Protocol):
    """A polygon: its rings, each with the free space on the left."""

    @property
    def rings(self) -> tuple[tuple[Point, ...], ...]:
        """The outer ring and the holes."""


class Claim(Protocol):
    """What is claimed: see `Sequence`."""

    @property
    def polygon(self) -> Rings:
        """The environment."""

    @property
    def directions(self) -> tuple[tuple[int, int], ...]:
        """The motions."""

    @property
    def sizes(self) -> tuple[tuple[int, int], ...]:
        """The numbers of pieces and points, at first and after each motion."""

    @property
    def end(self) -> Point:
        """Where the robot is at last."""


@dataclass(frozen=True)
class Places:
    """A set of places on the boundary.

    Parameters
    ----------
    spans
        For each wall open intervals of it, by the parts of the wall before their ends.
    points
        Single places.
    """

    spans: dict[int, list[Span]]
    points: set[Point]

    def __repr__(self) -> str:
        return f"<Places: {sum(map(len, self.spans.values()))} pieces and {len(self.points)} points>"

    @property
    def sizes(self) -> tuple[int, int]:
        """How many pieces and points."""
        return sum(map(len, self.spans.values())), len(self.points)


def verify(claim: Claim, progress: Callable[[int, int], None] | None = None) -> None:
    """Follow a claimed sequence from the whole boundary, and compare with what it claims step by step.

    Parameters
    ----------
    claim
        The sequence with its certificate.
    progress
        Called with the number of steps that are checked, and of all.

    Raises
    ------
    SequenceError
        If it is wrong; the message says at which step.
    """
    walls, unit = whole_walls(claim.polygon)
    steps = len(claim.directions)
    if len(claim.sizes) != steps + 1:
        raise SequenceError(f"step {min(steps, len(claim.sizes))}: there are {steps} motions, but {len(claim.sizes) - 1} states after them")
    corners = {(Fraction(x), Fraction(y)) for (x, y), _ in walls}
    places = _united(walls, {at: [(Fraction(0), Fraction(1))] for at in range(len(walls))}, corners)
    _compare(0, places, claim.sizes[0])
    for step, (direction, sizes) in enumerate(zip(claim.directions, claim.sizes[1:], strict=True), 1):
        if direction == (0, 0):
            raise SequenceError(f"step {step}: its direction is (0, 0), which leads nowhere")
        places = image(walls, places, direction)
        _compare(step, places, sizes)
        if progress is not None:
            progress(step, steps)
    if places.sizes != (0, 1):
        raise SequenceError(f"step {steps}: the robot may be in more than one place at the end; {places!r} are left")
    ((x, y),) = places.points
    last = x / unit, y / unit
    if last != claim.end:
        raise SequenceError(
            f"step {steps}: the robot ends at ({float(last[0]):g}, {float(last[1]):g}), and the end that is claimed is "
            f"({_short(claim.end[0])}, {_short(claim.end[1])}), which is not exactly that"
        )


def follow(polygon: Rings, start: Point, directions: Iterable[tuple[int, int]]) -> list[Point]:
    """Return where a robot is that starts in the closed polygon: at the start, and after each motion, exactly."""
    walls, unit = whole_walls(polygon)
    places = [(start[0] * unit, start[1] * unit)]
    for direction in directions:
        places.append(stop(walls, places[-1], direction))
    return [(x / unit, y / unit) for x, y in places]


def whole_walls(polygon: Rings) -> tuple[list[Wall], int]:
    """Return the walls in a unit in which their ends are whole numbers, and how many of it make a metre."""
    unit = math.lcm(*(number.denominator for ring in polygon.rings for point in ring for number in point))
    rings = [[(int(x * unit), int(y * unit)) for x, y in ring] for ring in polygon.rings]
    return [wall for ring in rings for wall in zip(ring, [*ring[1:], ring[0]], strict=True)], unit


def image(walls: Sequence[Wall], places: Places, direction: tuple[int, int]) -> Places:
    """Return where the robots of a set of places stop that drive in a direction."""
    ux, uy = direction
    spans: dict[int, list[Span]] = {}
    points = {stop(walls, point, direction) for point in places.points}
    levels = sorted({ux * y - uy * x for (x, y), _ in walls})
    for wall, held in places.spans.items():
        begin, end = walls[wall]
        low, high = ux * begin[1] - uy * begin[0], ux * end[1] - uy * end[0]
        for first, last in held:
            if high > low:  # the free space is behind
                spans.setdefault(wall, []).append((first, last))
            elif high == low:
                points.add(stop(walls, _along(begin, end, (first + last) / 2), direction))
            else:
                inner = sorted(Fraction(level - low, high - low) for level in levels if high < level < low)
                cuts = [first, *(part for part in inner if first < part < last), last]
                points |= {stop(walls, _along(begin, end, part), direction) for part in cuts[1:-1]}
                for one, other in pairwise(cuts):
                    hit, span = _landed(walls, (begin, end), (one, other), direction)
                    spans.setdefault(hit, []).append(span)
    return _united(walls, spans, points)


def stop(walls: Sequence[Wall], start: Point, direction: tuple[int, int]) -> Point:
    """Return where a robot stops that drives from a point of the closed polygon in a direction."""
    (px, py), (ux, uy) = start, direction
    size = math.lcm(px.denominator, py.denominator)
    level = int((ux * py - uy * px) * size)
    cuts = {Fraction(0)}
    for (ax, ay), (bx, by) in walls:
        one, other = (ux * ay - uy * ax) * size - level, (ux * by - uy * bx) * size - level
        if one == 0:
            cuts.add(((ax - px) * ux + (ay - py) * uy) / (ux * ux + uy * uy))
        elif (one > 0) != (other > 0):
            part = Fraction(one, one - other)
            cuts.add(((ax + part * (bx - ax) - px) * ux + (ay + part * (by - ay) - py) * uy) / (ux * ux + uy * uy))
    ahead = sorted(cut for cut in cuts if cut >= 0)
    for near, far in pairwise(ahead):
        middle = (near + far) / 2
        if not _inside(walls, (px + middle * ux, py + middle * uy)):
            return px + near * ux, py + near * uy
    return px + ahead[-1] * ux, py + ahead[-1] * uy


def _inside(walls: Sequence[Wall], point: Point) -> bool:
    """Return whether a point lies in the closed polygon: on a wall, or with an odd number of walls to its right."""
    size = math.lcm(point[0].denominator, point[1].denominator)
    x, y = int(point[0] * size), int(point[1] * size)
    odd = False
    for (ax, ay), (bx, by) in walls:
        from_a, from_b = ay * size - y, by * size - y
        if from_a == from_b == 0:
            if min(ax, bx) * size <= x <= max(ax, bx) * size:
                return True
        elif from_a <= 0 <= from_b or from_b <= 0 <= from_a:
            right = (from_b * (ax * size - x) - from_a * (bx * size - x)) * (1 if from_b > from_a else -1)
            if right == 0:
                return True
            if right > 0 and (from_a > 0) != (from_b > 0):
                odd = not odd
    return odd


def _landed(walls: Sequence[Wall], wall: Wall, span: Span, direction: tuple[int, int]) -> tuple[int, Span]:
    """Return on which wall a piece lands that no corner is ahead of but at its ends, and on which span of it."""
    (ux, uy), middle = direction, _along(*wall, (span[0] + span[1]) / 2)
    x, y = stop(walls, middle, direction)
    for number, ((ax, ay), (bx, by)) in enumerate(walls):
        low, high = ux * ay - uy * ax, ux * by - uy * bx
        level = ux * y - uy * x
        if min(low, high) < level < max(low, high) and (bx - ax) * (y - ay) == (by - ay) * (x - ax):
            parts = [(ux * py - uy * px - low) / (high - low) for px, py in (_along(*wall, part) for part in span)]
            return number, (min(parts), max(parts))
    raise AssertionError("a robot stops at a wall")


def _united(walls: Sequence[Wall], spans: dict[int, list[Span]], points: set[Point]) -> Places:
    """Merge spans that overlap or meet in a point of the set, and drop points that a span covers."""
    united: dict[int, list[Span]] = {}
    covered = set()
    for wall, held in spans.items():
        begin, end = walls[wall]
        merged: list[Span] = []
        for low, high in sorted(held):
            meets = merged and (low < merged[-1][1] or (low == merged[-1][1] and _along(begin, end, low) in points))
            if meets:
                merged[-1] = merged[-1][0], max(high, merged[-1][1])
            else:
                merged.append((low, high))
        united[wall] = merged
        for point in points:
            part = _part(begin, end, point)
            if part is not None and any(low < part < high for low, high in merged):
                covered.add(point)
    return Places(united, points - covered)


def _along(begin: tuple[int, int], end: tuple[int, int], part: Fraction) -> Point:
    return begin[0] + part * (end[0] - begin[0]), begin[1] + part * (end[1] - begin[1])


def _part(begin: tuple[int, int], end: tuple[int, int], point: Point) -> Fraction | None:
    """Return which part of a wall lies before a point of its line; None for other points."""
    dx, dy = end[0] - begin[0], end[1] - begin[1]
    if dx * (point[1] - begin[1]) != dy * (point[0] - begin[0]):
        return None
    return (point[0] - begin[0]) / dx if dx else (point[1] - begin[1]) / dy


def _compare(step: int, places: Places, claimed: tuple[int, int]) -> None:
    if places.sizes != claimed:
        pieces, points = places.sizes
        raise SequenceError(
            f"step {step}: {pieces} pieces of walls and {points} points are possible then, and {claimed[0]} and {claimed[1]} are claimed"
        )


def _short(number: Fraction) -> str:
    """Return about what a number is; those of a file may be too large for a double."""
    try:
        return f"{float(number):g}"
    except OverflowError:
        return f"{'-' * (number < 0)}1e{len(str(abs(int(number)))) - 1} or so"
