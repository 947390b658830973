"""`ExportedFilter`: what of a filter goes into other programs, after it was made smaller or made to restart."""

from dataclasses import dataclass

from ial.bouncing.automata.minimal import Keep, minimize
from ial.bouncing.automata.table import FilterTable
from ial.bouncing.exports.state_places import StatePlaces
from ial.bouncing.filters.bounce_filter import BounceFilter
from ial.bouncing.filters.setting import Setting


@dataclass(frozen=True, eq=False)
class ExportedFilter:
    """A table with the places of its states.

    Parameters
    ----------
    table
        The states and their successors.
    places
        Where the robot can be in states of knowledge cycles; None if that was given up for fewer states.
    setting
        What the filter was built for.
    kept
        What minimization has kept, or None if there was none.
    """

    table: FilterTable
    places: StatePlaces | None
    setting: Setting
    kept: Keep | None = None

    @classmethod
    def of(cls, made: BounceFilter, keep: Keep | None = None, restart: bool = False) -> "ExportedFilter":
        """Return what to export.

        Parameters
        ----------
        made
            A filter, as `read_filter` and `build_filter` give it.
        keep
            What `minimize` shall keep; None for the filter as it is.
        restart
            Whether the trap is left as the start is, see `FilterTable.restarting`.
        """
        table = made.table if keep is None else minimize(made.table, keep)
        places = StatePlaces.of(made) if keep is None else None
        return cls(table.restarting() if restart else table, places, made.setting, keep)

    def about(self) -> list[str]:
        """Return lines that say what it is, of letters that are safe in a comment of any language."""
        setting = self.setting
        lines = [
            f"{len(self.table) - 1} states and a trap, {self.table.cycles} knowledge cycles.",
            f"{setting.headings.count} headings, of which number t is t * 360 / {setting.headings.count} degrees; a bump turns by "
            f"{setting.headings.turn} of them.",
            f"Cells of {setting.cell} m, steps of {setting.headings.step} cells, radius {setting.radius} m.",
        ]
        for number, (name, (x, y)) in enumerate(zip(setting.names, setting.corners, strict=True)):
            safe = "".join(each if each.isascii() and (each.isalnum() or each in " -_.") else "_" for each in name)
            lines.append(f"Environment {number}: {safe}, lower left corner of cell (0, 0) at x {x} m, y {y} m.")
        if self.kept:
            lines.append(f"Minimized ({self.kept}): sizes are the largest of the states that were taken together, places are not kept.")
        return lines
