"""`RobustFilter`: a filter for a robot with real geometry and bounded errors; the robot is in every set that its states stand for."""

from dataclasses import dataclass
from fractions import Fraction

from ial.bouncing.automata.table import FilterTable
from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.filters.bounce_filter import Place
from ial.bouncing.filters.goal import Goal
from ial.bouncing.filters.setting import Setting
from ial.bouncing.filters.state_places import StatePlaces


@dataclass(frozen=True, eq=False)
class RobustFilter:
    """A filter for one environment or several.

    Parameters
    ----------
    table
        The states and their successors. A robot is localized in a state whose colour is 2 + number of a room, or 2.
    places
        The sets of cells and headings that states of localized robots stand for. The robot is anywhere in the closed cell, in any heading
        up to half the distance to the next one.
    setting
        The robot, and the cells.
    bounds
        What the robot may do wrong.
    goal
        When it counts as localized.
    growth
        By how much a set may be larger that stands for another one.
    """

    table: FilterTable
    places: StatePlaces
    setting: Setting
    bounds: ExecutionBounds
    goal: Goal
    growth: Fraction

    def __repr__(self) -> str:
        return f"<RobustFilter of {len(self.table) - 1} states for {', '.join(self.setting.names)}, {self.bounds}>"

    def state_places(self) -> StatePlaces:
        """Return the places of all states, written out."""
        return self.places

    def room(self, state: int) -> str | None:
        """Return the room in which the robot is in a state; None if it is not localized, or there are no rooms."""
        return self.goal.rooms[int(self.table.colours[state]) - 2].name if self.goal.rooms and self.table.is_localized(state) else None

    def where(self, state: int) -> list[Place]:
        """Return where the robot can be in a state in which it is localized; nothing for other states, whose sets are not kept."""
        setting, places = self.setting, self.places
        answer = []
        for number in places.of_state(state).tolist():
            environment = int(places.environment[number])
            x, y = setting.centre(environment, int(places.row[number]), int(places.column[number]))
            answer.append(Place(setting.names[environment], x, y, (setting.headings.angle_deg(int(places.heading_class[number])),)))
        return answer
