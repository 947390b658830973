"""`CTables`: the tables of an exported filter in C, and how much memory they take."""

from dataclasses import dataclass

import numpy as np

from ial.bouncing.exports.c_array import CArray, width_of
from ial.bouncing.exports.exported_filter import ExportedFilter
from ial.bouncing.exports.identifier import check_identifier
from ial.errors import ConfigError

FLASH_BUDGET = 64 * 1024


@dataclass(frozen=True, eq=False)
class CTables:
    """The tables.

    Parameters
    ----------
    prefix
        What all names begin with.
    stepping
        What a robot needs to step and to know its colour.
    telling
        What tells in how many places it can be, and in which.
    state_bits
        The width of the one variable that a robot needs.
    """

    prefix: str
    stepping: tuple[CArray, ...]
    telling: tuple[CArray, ...]
    state_bits: int

    @classmethod
    def of(cls, exported: ExportedFilter, prefix: str) -> "CTables":
        """Return the tables of a filter.

        Raises
        ------
        ConfigError
            If the prefix is no identifier.
        """
        check_identifier(prefix)
        table, places = exported.table, exported.places

        def array(name: str, values: np.typing.NDArray[np.integer], comment: str) -> CArray:
            return CArray(f"{prefix}_{name}", values, comment)

        stepping = (
            array("next", table.successors, "the successor of each state without a bump and with one; the trap is the last state"),
            array("colours", table.colours, "1 until the robot is localized, then 2 + number of the knowledge cycle; last is the trap"),
        )
        telling = [
            array("sizes", table.uncertainty, "in how many configurations the robot can be; 0 in the trap"),
            array("environments", table.environments, "in which environments it can be: bit i stands for environment i"),
        ]
        if places is not None:
            telling += [
                array("place_starts", places.starts, "where the places of each state begin in the next table, and where they end"),
                array("places", places.places, "numbers of places, for states of knowledge cycles only"),
                array("place_environments", places.environment, "the environment of each place"),
                array("place_rows", places.row, "its row of cells, from 0 at the bottom"),
                array("place_columns", places.column, "its column of cells, from 0 at the left"),
                array("place_classes", places.heading_class, "its class of headings that no robot can tell apart"),
                array("class_starts", places.class_starts, "where the headings of each class begin in the next table, and where they end"),
                array("class_headings", places.class_headings, "numbers of headings"),
            ]
        return cls(prefix, stepping, tuple(telling), width_of(table.trap))

    @property
    def stepping_bytes(self) -> int:
        """The bytes of flash that stepping and colours take."""
        return sum(each.size for each in self.stepping)

    @property
    def flash_bytes(self) -> int:
        """The bytes of flash that all tables take."""
        return self.stepping_bytes + sum(each.size for each in self.telling)

    @property
    def ram_bytes(self) -> int:
        """The bytes of memory that a robot writes to: its state."""
        return self.state_bits // 8

    def excess(self, budget: int = FLASH_BUDGET) -> str | None:
        """Return what to say about tables that are larger than a number of bytes, or None.

        Raises
        ------
        ConfigError
            If the budget is negative.
        """
        if budget < 0:
            raise ConfigError(f"the flash budget is {budget} bytes; give 0 or more")
        if self.flash_bytes <= budget:
            return None
        return (
            f"the tables take {self.flash_bytes:,} bytes of flash, and the budget is {budget:,}; {self.stepping_bytes:,} of them are for "
            "steps and colours, and compilers leave out the others if the program does not use them; to make them smaller, use "
            "--minimize colours, --minimize localized or a larger cell"
        )
