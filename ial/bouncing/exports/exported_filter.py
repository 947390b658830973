"""`ExportedFilter`: what of a filter goes into other programs, after it was made smaller or made to restart."""

from dataclasses import dataclass, replace

from ial.bouncing.automata.minimal import Keep, minimize
from ial.bouncing.automata.table import FilterTable
from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.filters.bounce_filter import BounceFilter
from ial.bouncing.filters.robust_filter import RobustFilter
from ial.bouncing.filters.setting import Setting
from ial.bouncing.filters.state_places import StatePlaces
from ial.bouncing.start import ANYWHERE


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
    bounds
        What the robot may do wrong; None for the filter of a robot that is put back to the centre of its cell.
    rooms
        The rooms that colours from 2 on stand for, if they do.
    """

    table: FilterTable
    places: StatePlaces | None
    setting: Setting
    kept: Keep | None = None
    bounds: ExecutionBounds | None = None
    rooms: tuple[str, ...] = ()

    @classmethod
    def of(cls, made: BounceFilter | RobustFilter, keep: Keep | None = None, restart: bool = False) -> "ExportedFilter":
        """Return what to export.

        Parameters
        ----------
        made
            A filter, as `read_filter` and `build_filter` give it.
        keep
            What `minimize` shall keep; None for the filter as it is.
        restart
            Whether the trap is left as the start is, see `FilterTable.restarting`.

        Raises
        ------
        ConfigError
            If it shall restart and knows of its start.
        """
        if restart:
            made.setting.check_restart()
        table = made.table if keep is None else minimize(made.table, keep)
        places = made.state_places() if keep is None else None
        kept = cls(table.restarting() if restart else table, places, made.setting, keep)
        if not isinstance(made, RobustFilter):
            return kept
        return replace(kept, bounds=made.bounds, rooms=tuple(room.name for room in made.goal.rooms))

    def about(self) -> list[str]:
        """Return lines that say what it is, of letters that are safe in a comment of any language."""
        setting = self.setting
        count = len(self.table) - 1
        lines = [f"{count} states and a trap, {self.table.cycles} knowledge cycles."]
        if self.bounds is not None:
            lines = [
                f"{count} states and a trap.",
                f"For a robot that errs by at most {self.bounds.turn_deg} degrees in a turn, {self.bounds.step} of a step, and",
                f"{self.bounds.count} steps in a count. A place is all of a cell, with headings half way to the next ones.",
                *(f"Colour {number}: {_safe(name)}." for number, name in enumerate(self.rooms, 2)),
            ]
        if setting.start != ANYWHERE:
            lines.append("For a robot of whose start something is known: a region, or a heading.")
        lines += [
            f"{setting.headings.count} headings, of which number t is t * 360 / {setting.headings.count} degrees; a bump turns by "
            f"{setting.headings.turn} of them.",
            f"Cells of {setting.cell} m, steps of {setting.headings.step} cells, radius {setting.radius} m.",
        ]
        for number, (name, (x, y)) in enumerate(zip(setting.names, setting.corners, strict=True)):
            lines.append(f"Environment {number}: {_safe(name)}, lower left corner of cell (0, 0) at x {x} m, y {y} m.")
        if self.kept:
            lines.append(f"Minimized ({self.kept}): sizes are the largest of the states that were taken together, places are not kept.")
        return lines


def _safe(name: str) -> str:
    return "".join(each if each.isascii() and (each.isalnum() or each in " -_.") else "_" for each in name)
