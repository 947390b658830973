"""`CellRobot`: a simulated bouncing robot that is put back to the centre of its cell after each step, as filters of cells take it."""

import random
from collections.abc import Iterator
from fractions import Fraction

from ial.bouncing.cells.cell_map import CellMap
from ial.bouncing.rays.real_robot import RealPose
from ial.errors import ConfigError

_FULL_DEG = 360


class CellRobot:
    """A robot that steps from centre to centre, and turns where a step is not free.

    Parameters
    ----------
    map_
        The cells, with headings that are not merged.
    seed
        The same seed gives the same run.
    start
        x, y in metres and the heading as a part of a full turn; a cell and a heading at random if it is left out.

    Raises
    ------
    ConfigError
        If the start is in no free cell, or its heading is none of those of the map.
    """

    def __init__(self, map_: CellMap, seed: int = 0, start: tuple[Fraction, Fraction, Fraction] | None = None) -> None:
        self.map = map_
        self.vertex = random.Random(seed).randrange(len(map_.graph)) if start is None else self._vertex(*start)

    def __repr__(self) -> str:
        row, column, heading = (int(each) for each in self.map.configurations(self.vertex))
        return f"<CellRobot in row {row}, column {column}, heading {float(self.map.headings.angle_deg(heading)):g}°>"

    def _vertex(self, x_m: Fraction, y_m: Fraction, turn: Fraction) -> int:
        raster, headings = self.map.raster, self.map.headings
        heading = turn % 1 * headings.count
        if heading.denominator != 1:
            raise ConfigError(
                f"the robot cannot start in heading {float(turn * _FULL_DEG):g}°, since those of its cells are multiples of "
                f"{float(headings.angle_deg(1)):g}°; give one of these"
            )
        row, column = (y_m - raster.y) // raster.cell, (x_m - raster.x) // raster.cell
        try:
            return self.map.vertex(row, column, int(heading))
        except ConfigError:
            raise ConfigError(f"the robot cannot start at ({float(x_m):g}, {float(y_m):g}); give a place in a free cell") from None

    def run(self) -> Iterator[RealPose]:
        """Drive on for ever; yield the pose after each observation."""
        while True:
            arc = int(self.map.graph.arcs[self.vertex])
            self.vertex = arc if arc >= 0 else ~arc
            row, column, heading = (int(each) for each in self.map.configurations(self.vertex))
            yield RealPose(int(arc < 0), *self.map.centre(row, column), Fraction(heading, self.map.headings.count))
