"""Candidates by brute force: every place of the boundary is tried, in plain doubles, with rays of its own."""

import math
from itertools import pairwise

from ial.maps.polygons.polygon import Polygon

Place = tuple[float, float, float]
Wall = tuple[float, float, float, float]


class Scan:
    """The walls of a polygon, and how far it is to them."""

    def __init__(self, polygon: Polygon) -> None:
        self.walls = [
            (float(ax), float(ay), float(bx) - float(ax), float(by) - float(ay))
            for each in polygon.rings
            for (ax, ay), (bx, by) in zip(each, (*each[1:], each[0]), strict=True)
        ]
        self.size = max(math.hypot(ex, ey) for _, _, ex, ey in self.walls)

    def way(self, x: float, y: float, heading: float) -> tuple[float, int]:
        """How far it is to a wall that is met from inside, and which."""
        ux, uy = math.cos(heading), math.sin(heading)
        best = math.inf, -1
        for number, (ax, ay, ex, ey) in enumerate(self.walls):
            into = ux * ey - uy * ex
            if into > 1e-12 * self.size:
                far = ((ax - x) * ey - (ay - y) * ex) / into
                part = ((ax - x) * uy - (ay - y) * ux) / into
                if far > 1e-9 * self.size and 0.0 <= part <= 1.0:
                    best = min(best, (far, number))
        return best

    def chords(self, x: float, y: float, length: float, own: Wall) -> dict[tuple[int, int], float]:
        """The headings in which a drive from a place on a wall of its own has a length: by wall, and which of its two points."""
        found = {}
        for number, (ax, ay, ex, ey) in enumerate(self.walls):
            square, middle = ex * ex + ey * ey, (ax - x) * ex + (ay - y) * ey
            root = middle * middle - square * ((ax - x) ** 2 + (ay - y) ** 2 - length * length)
            for sign in (-1, 1) if root >= 0.0 else ():
                part = (-middle + sign * math.sqrt(root)) / square
                if 0.0 <= part <= 1.0:
                    heading = math.atan2(ay + part * ey - y, ax + part * ex - x)
                    if own[2] * math.sin(heading) - own[3] * math.cos(heading) <= 0.0:
                        continue  # into the wall
                    far, hit = self.way(x, y, heading)
                    if hit == number and abs(far - length) < 1e-9 * self.size:
                        found[number, sign] = heading
        return found

    def candidates(self, first: float, second: float, turn: float, steps: int) -> list[Place]:
        """Where robots are after two drives, by changes of sign between neighbouring places, at the middle of these."""
        found: list[Place] = []
        for own in self.walls:
            ax, ay, ex, ey = own
            column = []
            for step in range(steps):
                x, y = ax + (step + 0.5) / steps * ex, ay + (step + 0.5) / steps * ey
                row = {}
                for key, heading in self.chords(x, y, first, own).items():
                    _, _, fx, fy = self.walls[key[0]]
                    if fx * math.sin(heading + turn) - fy * math.cos(heading + turn) <= 0.0:
                        continue  # into the wall
                    bx, by = x + first * math.cos(heading), y + first * math.sin(heading)
                    far, hit = self.way(bx, by, heading + turn)
                    if hit >= 0:
                        row[(*key, hit)] = (
                            far - second,
                            bx + far * math.cos(heading + turn),
                            by + far * math.sin(heading + turn),
                            heading + turn,
                        )
                column.append(row)
            for one, other in pairwise(column):
                for key in one.keys() & other.keys():
                    (a, *place), (b, *_) = one[key], other[key]
                    near_by = abs(place[2] - other[key][3]) < 0.03  # where the heading changes quickly, the middle is not near a root
                    if near_by and (a < 0.0) != (b < 0.0):
                        share = a / (a - b)
                        near = [p + share * (q - p) for p, q in zip(place, other[key][1:], strict=True)]
                        found.append((near[0], near[1], near[2]))
        return found
