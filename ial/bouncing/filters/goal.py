"""`Goal`: when a robot with errors counts as localized: when all places where it can be lie in one room, or close together."""

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from math import ceil, floor
from typing import Any

import numpy as np
import numpy.typing as npt

from ial.bouncing.automata.set_automaton import NOT_LOCALIZED
from ial.bouncing.filters.setting import Setting
from ial.errors import ConfigError

IntArray = npt.NDArray[np.integer]


@dataclass(frozen=True)
class Room:
    """A named rectangle of an environment; its border belongs to it.

    Parameters
    ----------
    name
        Its name.
    x0, y0, x1, y1
        The least and the greatest coordinates, in metres.
    environment
        The environment it is in; any if it is empty.

    Raises
    ------
    ConfigError
        If the rectangle is empty.
    """

    name: str
    x0: Fraction
    y0: Fraction
    x1: Fraction
    y1: Fraction
    environment: str = ""

    def __post_init__(self) -> None:
        if not (self.name and self.x0 < self.x1 and self.y0 < self.y1):
            raise ConfigError(f"the room {self.name!r} has no name or no area; give NAME=X0,Y0,X1,Y1 with the least coordinates first")

    def record(self) -> dict[str, str]:
        """Return plain values that JSON can hold; `of_record` gives the room back."""
        return {name: str(value) for name, value in vars(self).items()}

    @classmethod
    def of_record(cls, record: dict[str, str]) -> "Room":
        """Return the room of a record."""
        x0, y0, x1, y1 = (Fraction(record[name]) for name in ("x0", "y0", "x1", "y1"))
        return cls(record["name"], x0, y0, x1, y1, record["environment"])


@dataclass(frozen=True)
class Goal:
    """What a robot shall find out: in which room it is, or where, up to some width.

    Parameters
    ----------
    rooms
        A robot is localized if all cells in which it can be lie in one of these.
    width
        Without rooms, a robot is localized if these cells lie in a square of this width, in metres.

    Raises
    ------
    ConfigError
        If there are neither rooms nor a positive width, both, or two rooms of one name.
    """

    rooms: tuple[Room, ...] = ()
    width: Fraction | None = None

    def __post_init__(self) -> None:
        if (self.width is None) == (not self.rooms):
            raise ConfigError("a robot is localized in one of several rooms, or within a width; give either of the two")
        if self.width is not None and self.width <= 0:
            raise ConfigError(f"a robot is to be localized within {float(self.width):g} m; give a width greater than 0")
        if len({room.name for room in self.rooms}) < len(self.rooms):
            raise ConfigError("two rooms have the same name; give each a name of its own")

    @property
    def colours(self) -> int:
        """How many colours a localized robot can have: one for each room, or one."""
        return max(len(self.rooms), 1)

    def judge(self, setting: Setting, environment: IntArray, row: IntArray, column: IntArray) -> Callable[[IntArray], int]:
        """Return the function that tells the colour of a set of places: 1, or 2 + number of the room that holds all of them, or 2.

        Parameters
        ----------
        setting
            The cells.
        environment, row, column
            The cell of each place.

        Raises
        ------
        ConfigError
            If a room is in an unknown environment, or holds no cell.
        """
        if self.width is not None:
            across = self.width // setting.cell  # so many cells

            def close(places: IntArray) -> int:
                alike = all(np.ptp(each[places]) <= most for each, most in ((environment, 0), (row, across - 1), (column, across - 1)))
                return NOT_LOCALIZED + 1 if alike else NOT_LOCALIZED

            return close
        holding = [self._cells_in(room, setting, environment, row, column) for room in self.rooms]

        def in_room(places: IntArray) -> int:
            return next((NOT_LOCALIZED + 1 + number for number, held in enumerate(holding) if held[places].all()), NOT_LOCALIZED)

        return in_room

    @staticmethod
    def _cells_in(room: Room, setting: Setting, environment: IntArray, row: IntArray, column: IntArray) -> npt.NDArray[np.bool_]:
        """Return which places lie in a room with all of their cell."""
        if room.environment and room.environment not in setting.names:
            raise ConfigError(f"the room {room.name!r} is in the environment {room.environment!r}; give one of {', '.join(setting.names)}")
        held = np.zeros(len(row), dtype=np.bool_)
        for number, (name, (x, y)) in enumerate(zip(setting.names, setting.corners, strict=True)):
            if room.environment in ("", name):
                least = [ceil((low - corner) / setting.cell) for low, corner in ((room.x0, x), (room.y0, y))]
                stop = [floor((high - corner) / setting.cell) for high, corner in ((room.x1, x), (room.y1, y))]
                inside = (column >= least[0]) & (column < stop[0]) & (row >= least[1]) & (row < stop[1])
                held |= inside & (environment == number)
        if not held.any():
            raise ConfigError(f"the room {room.name!r} holds no cell; check its coordinates, or use smaller cells")
        return held

    def record(self) -> dict[str, Any]:
        """Return plain values that JSON can hold; `of_record` gives the goal back."""
        return {"rooms": [room.record() for room in self.rooms], "width": None if self.width is None else str(self.width)}

    @classmethod
    def of_record(cls, record: dict[str, Any]) -> "Goal":
        """Return the goal of a record."""
        width = record["width"]
        return cls(tuple(Room.of_record(each) for each in record["rooms"]), None if width is None else Fraction(width))
