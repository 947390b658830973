"""`Setting`: what a filter was built for; it is of use only to a robot that moves like that."""

from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from ial.bouncing.cells.corner import Corner
from ial.bouncing.cells.headings import Headings
from ial.bouncing.start import ANYWHERE, Start
from ial.errors import ConfigError
from ial.maps.polygons.raster import Raster, Rule


@dataclass(frozen=True)
class Setting:
    """The robot, and the lattices its environments were divided into.

    Parameters
    ----------
    names
        The environments.
    corners
        The lower left corner of the cells of each, in its own frame, in metres.
    cell
        The width of a cell in metres.
    headings
        The headings, the bouncing angle and the step.
    radius
        The radius of the robot in metres.
    rule
        When a cell is free, see `rasterize`.
    corner
        What a step must not touch, see `passed_cells`.
    merged
        Whether headings that cannot be told apart are one vertex.
    start
        What is known of where the robot starts.
    """

    names: tuple[str, ...]
    corners: tuple[tuple[Fraction, Fraction], ...]
    cell: Fraction
    headings: Headings
    radius: Fraction = Fraction(0)
    rule: Rule = "centre"
    corner: Corner = "segment"
    merged: bool = True
    start: Start = ANYWHERE

    def centre(self, environment: int, row: int, column: int) -> tuple[Fraction, Fraction]:
        """Return the centre of a cell in the frame of its environment, in metres."""
        x, y = self.corners[environment]
        return x + (column + Fraction(1, 2)) * self.cell, y + (row + Fraction(1, 2)) * self.cell

    def check_restart(self) -> None:
        """Check that a robot which was rejected can begin anew.

        Raises
        ------
        ConfigError
            If something was known of its start, which no longer holds where it was carried.
        """
        if self.start != ANYWHERE:
            raise ConfigError(
                "the filter knows where the robot started, and after a rejection it may be anywhere: do not restart, or build a filter "
                "without a region and headings"
            )

    def record(self) -> dict[str, Any]:
        """Return plain values that JSON can hold; `of_record` gives the setting back."""
        return {
            "names": list(self.names),
            "corners": [[str(x), str(y)] for x, y in self.corners],
            "cell": str(self.cell),
            "headings": self.headings.count,
            "turn": self.headings.turn,
            "step": str(self.headings.step),
            "radius": str(self.radius),
            "rule": self.rule,
            "corner": self.corner,
            "merged": self.merged,
            "start": self.start.record(),
        }

    @classmethod
    def of_record(cls, record: dict[str, Any]) -> "Setting":
        """Return the setting of a record."""
        return cls(
            tuple(record["names"]),
            tuple((Fraction(x), Fraction(y)) for x, y in record["corners"]),
            Fraction(record["cell"]),
            Headings(record["headings"], record["turn"], Fraction(record["step"])),
            Fraction(record["radius"]),
            record["rule"],
            record["corner"],
            record["merged"],
            Start.of_record(record["start"]),
        )

    @classmethod
    def of_rasters(
        cls,
        rasters: dict[str, Raster],
        headings: Headings,
        radius: Fraction,
        rule: Rule,
        corner: Corner,
        merged: bool = True,
        start: Start = ANYWHERE,
    ) -> "Setting":
        """Return the setting of environments that were divided into cells of one width."""
        cells = list(rasters.values())
        return cls(tuple(rasters), tuple((each.x, each.y) for each in cells), cells[0].cell, headings, radius, rule, corner, merged, start)
