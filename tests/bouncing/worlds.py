"""Environments for tests, and slow obvious twins of what is tested."""

import math
import random
from collections.abc import Iterator
from fractions import Fraction

import numpy as np
import numpy.typing as npt

from ial.bouncing.cells.cell_map import CellMap
from ial.bouncing.cells.corner import Corner
from ial.bouncing.cells.graph import LabelledGraph
from ial.bouncing.cells.headings import Headings
from ial.maps.polygons.raster import Raster

MaskArray = npt.NDArray[np.bool_]


def drawn(text: str) -> MaskArray:
    """A mask as one sees it: the first line is the top row, a dot is free."""
    return np.array([[char == "." for char in line] for line in text.split()][::-1])


HALL, STORE = drawn("....... ....... ....... ..#.... ......."), drawn(".....# ...... ..#... ...... #.....")


def random_mask(seed: int, rows: int = 7, columns: int = 8) -> MaskArray:
    """A room with a quarter of its cells blocked."""
    free = np.random.default_rng(seed).random((rows, columns)) > 0.25
    free[0, 0] = True
    return free


def cell_map(free: MaskArray, angle: int = 90, headings: int = 4, step: Fraction = Fraction(1), **more: object) -> CellMap:
    return CellMap(Raster(free), Headings.of_angle(Fraction(angle), headings, step), **more)  # type: ignore[arg-type]


def worlds(count: int) -> Iterator[CellMap]:
    """Random environments with varied angles, headings, steps and policies."""
    for seed in range(count):
        chooser = random.Random(seed)
        headings, angle = chooser.choice([(4, 90), (8, 45), (8, 135), (8, 90), (12, 30), (6, 120), (5, 72), (4, 180)])
        corner: Corner = chooser.choice(["segment", "endpoint"])
        step = chooser.choice([Fraction(1), Fraction(1), Fraction(3, 2)])
        yield cell_map(random_mask(seed), angle, headings, step, corner=corner, merge=seed % 3 == 2)


def twin_next(map_: CellMap, row: int, column: int, heading: int) -> tuple[int, int, int, int]:
    """Where the robot goes, and its observation; offsets by doubles, which only tests may trust."""
    headings, free = map_.headings, map_.raster.free
    step = float(headings.step)
    angle = 2.0 * math.pi * heading / headings.count

    def whole(value: float) -> int:
        return int(math.copysign(math.floor(abs(value) + 0.5 + 1e-9), value))

    dx, dy = whole(step * math.cos(angle)), whole(step * math.sin(angle))

    def open_at(r: int, c: int) -> bool:
        return 0 <= r < free.shape[0] and 0 <= c < free.shape[1] and bool(free[r, c])

    clear = open_at(row + dy, column + dx)
    if map_.corner == "segment":
        for k in range(25):  # walk along the segment; every closed cell that holds a point of it must be free
            x, y = Fraction(dx * k, 24), Fraction(dy * k, 24)
            near_x = {math.floor(x + Fraction(1, 2)), math.ceil(x - Fraction(1, 2))}
            near_y = {math.floor(y + Fraction(1, 2)), math.ceil(y - Fraction(1, 2))}
            clear = clear and all(open_at(row + j, column + i) for i in near_x for j in near_y)
    if clear:
        return row + dy, column + dx, heading, 0
    return row, column, (heading + headings.turn) % headings.count, 1


def twin_information_states(graph: LabelledGraph) -> tuple[list[tuple[int | None, int | None]], list[frozenset[int]]]:
    """The subset construction with frozen sets: successors and sets, breadth first."""
    to, labels = graph.successors.tolist(), graph.labels.tolist()
    start = frozenset(range(len(graph)))
    number, sets, arcs = {start: 0}, [start], []
    for held in sets:
        images = [frozenset(to[v] for v in held if labels[v] == label) for label in (False, True)]
        for image in images:
            if image and image not in number:
                number[image] = len(sets)
                sets.append(image)
        arcs.append(tuple(number.get(image) for image in images))
    return arcs, sets  # type: ignore[return-value]


def observations(graph: LabelledGraph, vertex: int, steps: int) -> tuple[list[int], list[int]]:
    """The stream that a robot observes from a start, and the vertices it passes."""
    stream, passed = [], [vertex]
    for _ in range(steps):
        arc = int(graph.arcs[passed[-1]])
        stream.append(int(arc < 0))
        passed.append(arc if arc >= 0 else ~arc)
    return stream, passed
