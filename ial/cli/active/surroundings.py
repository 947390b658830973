"""`Surroundings`: the map of an exploration, and what the robot really drives in."""

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from ial.cli.shell.inputs import Inputs
from ial.maps.grids.alike_plans import alike_plan
from ial.maps.grids.map_metadata import Semantics
from ial.maps.grids.occupancy_grid import OccupancyGrid

_PLAN = "plan:"


@dataclass(frozen=True)
class Surroundings:
    """Two maps by what the options say: a file, or ``plan:NAME``.

    Parameters
    ----------
    map_choice
        What the localizer believes in.
    world_choice
        What the robot drives in; None for the same.
    semantics, map_topic
        How both are read, as in `load_map`.
    """

    map_choice: str
    world_choice: str | None = None
    semantics: Semantics = "nav2"
    map_topic: str | None = None

    @property
    def name(self) -> str:
        """What to call the map in results."""
        return self.map_choice.removeprefix(_PLAN) if self.map_choice.startswith(_PLAN) else Path(self.map_choice).name

    @property
    def paths(self) -> list[Path]:
        """The files that are read."""
        return [Path(each) for each in (self.map_choice, self.world_choice) if each is not None and not each.startswith(_PLAN)]

    @cached_property
    def grid(self) -> OccupancyGrid:
        """The map.

        Raises
        ------
        MapError
            If it cannot be read, or there is no such plan.
        """
        return self._read(self.map_choice)

    @cached_property
    def world(self) -> OccupancyGrid:
        """What the robot drives in.

        Raises
        ------
        MapError
            If it cannot be read, or there is no such plan.
        """
        return self.grid if self.world_choice is None else self._read(self.world_choice)

    def _read(self, choice: str) -> OccupancyGrid:
        if choice.startswith(_PLAN):
            return alike_plan(choice.removeprefix(_PLAN))
        return Inputs(map_path=Path(choice), semantics=self.semantics, map_topic=self.map_topic).grid()
