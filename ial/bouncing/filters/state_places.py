"""`StatePlaces`: where a robot can be in each state in which it is localized, as plain arrays that other programs can read."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ial.bouncing.automata.cycle_walk import walk_cycles
from ial.bouncing.automata.table import FilterTable
from ial.bouncing.cells.heading_classes import HeadingClasses
from ial.bouncing.filters.cycle_places import CyclePlaces
from ial.bouncing.filters.setting import Setting

IntArray = npt.NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class StatePlaces:
    """Sets of places as compressed rows: those of state s are ``places[starts[s] : starts[s + 1]]``, none if the robot is not localized.

    Parameters
    ----------
    starts
        int64 of shape (states + 2,): one row for each state, and an empty one for the trap.
    places
        Numbers of places, in increasing order within each row.
    environment, row, column, heading_class
        What each place is, by its number.
    class_starts, class_headings
        The headings of class i are ``class_headings[class_starts[i] : class_starts[i + 1]]``; no robot can tell them apart.
    """

    starts: IntArray
    places: IntArray
    environment: IntArray
    row: IntArray
    column: IntArray
    heading_class: IntArray
    class_starts: IntArray
    class_headings: IntArray

    def of_state(self, state: int) -> IntArray:
        """Return the numbers of the places of a state."""
        return self.places[self.starts[state] : self.starts[state + 1]]

    @classmethod
    def of_cycles(cls, table: FilterTable, kept: CyclePlaces, setting: Setting) -> "StatePlaces":
        """Return the places of the knowledge cycles of a filter."""
        cycles, steps = walk_cycles(table.successors, kept.anchors, table.trap)
        rows: dict[int, npt.NDArray[np.int32]] = {}
        vertices = kept.members[:0]
        for state in np.lexsort((steps, cycles))[np.count_nonzero(cycles < 0) :].tolist():
            number = cycles[state]
            vertices = kept.members[kept.starts[number] : kept.starts[number + 1]] if steps[state] == 0 else kept.following[vertices]
            rows[state] = np.sort(vertices)
        counts = np.zeros(len(table), dtype=np.int64)
        for state, vertices in rows.items():
            counts[state] = len(vertices)
        classes = HeadingClasses.merged(setting.headings) if setting.merged else HeadingClasses.single(setting.headings)
        return cls(
            np.concatenate([[0], np.cumsum(counts)]),
            np.concatenate([rows[state] for state in sorted(rows)]).astype(np.int64),
            kept.environment.astype(np.int64),
            kept.row.astype(np.int64),
            kept.column.astype(np.int64),
            kept.heading_class.astype(np.int64),
            np.concatenate([[0], np.cumsum(classes.sizes, dtype=np.int64)]),
            np.argsort(classes.of, kind="stable").astype(np.int64),
        )
