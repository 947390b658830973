"""`BounceFilter`: everything a robot needs to localize itself by bumps: the table, the places, and what it was built for."""

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

import numpy as np
import numpy.typing as npt

from ial.bouncing.automata.cycle_walk import walk_cycles
from ial.bouncing.automata.table import FilterTable
from ial.bouncing.cells.heading_classes import HeadingClasses
from ial.bouncing.filters.cycle_places import CyclePlaces
from ial.bouncing.filters.setting import Setting
from ial.bouncing.filters.state_places import StatePlaces


@dataclass(frozen=True)
class Place:
    """Where a robot can be: a cell, and headings that cannot be told apart.

    Parameters
    ----------
    environment
        Its name.
    x_m, y_m
        The centre of the cell in the frame of the environment, in metres.
    headings_deg
        The headings, counter-clockwise from the x axis, in degrees.
    """

    environment: str
    x_m: Fraction
    y_m: Fraction
    headings_deg: tuple[Fraction, ...]


@dataclass(frozen=True, eq=False)
class BounceFilter:
    """A filter for one environment or several.

    Parameters
    ----------
    table
        The states and their successors.
    places
        The sets of configurations that the states of knowledge cycles stand for.
    setting
        What the filter was built for.
    """

    table: FilterTable
    places: CyclePlaces
    setting: Setting

    def __repr__(self) -> str:
        return (
            f"<BounceFilter of {len(self.table) - 1} states and {self.table.cycles} knowledge cycles for {', '.join(self.setting.names)}>"
        )

    @cached_property
    def _steps(self) -> npt.NDArray[np.int64]:
        """How many steps each state stands past the anchor of its cycle."""
        return walk_cycles(self.table.successors, self.places.anchors, self.table.trap)[1]

    @cached_property
    def _classes(self) -> HeadingClasses:
        headings = self.setting.headings
        return HeadingClasses.merged(headings) if self.setting.merged else HeadingClasses.single(headings)

    def step_of(self, heading_class: int) -> tuple[int, int]:
        """Return by how many columns and rows a step leads in a class of headings, as they are numbered in the places."""
        x, y = self._classes.offsets[heading_class]
        return int(x), int(y)

    def state_places(self) -> StatePlaces:
        """Return the places of all states, written out."""
        return StatePlaces.of_cycles(self.table, self.places, self.setting)

    @property
    def trapped(self) -> int:
        """In how many configurations a robot is so near to obstacles all around that it can only turn on the spot, for ever."""
        places = self.places
        following = places.following
        turning = (places.row[following] == places.row) & (places.column[following] == places.column)
        for _ in range(self.setting.headings.orbit):  # after so many bumps it has its first heading again
            turning = turning & turning[following]
        return int(self._classes.sizes[places.heading_class[turning]].sum())

    def where(self, state: int) -> list[Place]:
        """Return where the robot can be in a state of a knowledge cycle; nothing for other states, whose sets are not kept."""
        if not self.table.is_localized(state):
            return []
        setting, places = self.setting, self.places
        answer = []
        for vertex in places.at(int(self.table.colours[state]) - 2, int(self._steps[state])).tolist():
            environment = int(places.environment[vertex])
            x, y = setting.centre(environment, int(places.row[vertex]), int(places.column[vertex]))
            members = self._classes.members(int(places.heading_class[vertex]))
            answer.append(Place(setting.names[environment], x, y, tuple(setting.headings.angle_deg(each) for each in members)))
        return answer
