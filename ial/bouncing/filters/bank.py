"""`FilterBank`: one filter for each of several environments, run side by side (section IV-D of the paper)."""

from collections.abc import Mapping

from ial.bouncing.automata.table import FilterTable
from ial.errors import ConfigError


class FilterBank:
    """Tells in which environments a robot can be. The filter of their union tells the same in one table.

    Parameters
    ----------
    tables
        The filters by the names of their environments.

    Raises
    ------
    ConfigError
        If there is none.
    """

    def __init__(self, tables: Mapping[str, FilterTable]) -> None:
        if not tables:
            raise ConfigError("no environment to be in; give at least one filter")
        self.tables = dict(tables)
        self.states = dict.fromkeys(self.tables, 0)

    def __repr__(self) -> str:
        return f"<FilterBank of {len(self.tables)}: {', '.join(self.tables)}>"

    def update(self, observation: int) -> list[str]:
        """Take an observation; return the environments in which the robot can be."""
        self.states = {name: self.tables[name].step(state, observation) for name, state in self.states.items()}
        return self.possible

    @property
    def possible(self) -> list[str]:
        """The names of the environments whose filter is not in its trap."""
        return [name for name, state in self.states.items() if state != self.tables[name].trap]

    @property
    def uncertainty(self) -> int:
        """In how many configurations of all environments the robot can be."""
        return sum(int(self.tables[name].uncertainty[state]) for name, state in self.states.items())
