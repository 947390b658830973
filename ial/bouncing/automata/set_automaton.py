"""`SetAutomaton`: the deterministic automaton of a set-valued map: what a robot with errors knows, as a table.

Sets may overlap in every way, so there can be very many. A set that is held by a known one which is not much larger need not become a state
of its own: the robot goes on with the larger one. It is never lost by that, and there are fewer states. What an observation tells must not
be given away, or the robot would stay at the start for ever: where the set has shrunk, a part of that is kept.
"""

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
import numpy.typing as npt

from ial.bouncing.automata.set_store import SetStore
from ial.bouncing.cells.noisy_model import NoisyModel, Vertices
from ial.bouncing.cells.set_graph import SetGraph
from ial.errors import FilterError

MOST_SETS = 100_000
NOT_LOCALIZED = 1
_GIVEN_AWAY = Fraction(9, 10)  # of what an observation has ruled out, at most


@dataclass(frozen=True, eq=False)
class SetAutomaton:
    """The deterministic automaton of a set-valued graph; state 0 is the start.

    Parameters
    ----------
    successors
        The state after each observation, int32 of shape (states, 2), −1 where there is none.
    sizes
        How many vertices the robot can be in, int64 of shape (states,).
    colours
        What each set tells, int32 of shape (states,); 1 for nothing in particular.
    parts
        In which parts of the graph the robot can be, as bits, uint64 of shape (states,).
    starts, members
        The sets of states whose colour is not 1, as compressed rows: int64 of shape (states + 1,) and int32.
    """

    successors: npt.NDArray[np.int32]
    sizes: npt.NDArray[np.int64]
    colours: npt.NDArray[np.int32]
    parts: npt.NDArray[np.uint64]
    starts: npt.NDArray[np.int64]
    members: npt.NDArray[np.int32]

    def __len__(self) -> int:
        return len(self.sizes)

    def __repr__(self) -> str:
        return f"<SetAutomaton of {len(self)} states>"


def _no_colour(vertices: Vertices) -> int:
    return NOT_LOCALIZED


def determinize_sets(
    graph: SetGraph,
    most_states: int = MOST_SETS,
    colour_of: Callable[[Vertices], int] = _no_colour,
    growth: Fraction = Fraction(0),
    part_of: npt.NDArray[np.integer] | None = None,
) -> SetAutomaton:
    """Return the deterministic automaton of a set-valued graph.

    Parameters
    ----------
    graph
        Where the robot can go.
    most_states
        The number of states at which to give up.
    colour_of
        What a set tells, a number from 1 on.
    growth
        A known set of the same colour stands for a new one that it holds if it has at most 1 + `growth` times as many vertices, and is
        smaller than the set before where the new one is. With 0 only equal sets are one state, and the automaton tells what the filter of
        sets tells.
    part_of
        The number of the part that each vertex belongs to; by default all are of part 0.

    Raises
    ------
    FilterError
        If there would be more states than allowed.
    """
    model, store = NoisyModel(graph), SetStore(len(graph))
    start = model.universe()
    store.add(start, colour_of(start))
    bit_of = np.ones(len(graph), dtype=np.uint64) if part_of is None else np.uint64(1) << part_of.astype(np.uint64)
    waiting, successors, parts = deque([start]), [], []
    kept: list[Vertices] = []
    while waiting:
        held, row = waiting.popleft(), []
        parts.append(np.bitwise_or.reduce(bit_of[held]))
        kept.append(np.sort(held) if store.colour(len(kept)) != NOT_LOCALIZED else held[:0])
        for label in (0, 1):
            reached = model.step(held, None, label)
            if not len(reached):
                row.append(-1)
                continue
            colour = colour_of(reached)
            most = int(len(reached) * (1 + growth))
            if len(reached) < len(held):
                most = min(most, int(len(reached) + _GIVEN_AWAY * (len(held) - len(reached))))
            number = store.find(reached, colour, most)
            if number < 0:
                if len(store) >= most_states:
                    raise FilterError(
                        f"the automaton has more than {most_states} states; use larger cells, smaller bounds of errors, or the filter "
                        "of sets, which needs no automaton"
                    )
                number = store.add(reached, colour)
                waiting.append(reached)
            row.append(number)
        successors.append(row)
    starts = np.concatenate([[0], np.cumsum([len(each) for each in kept])])
    return SetAutomaton(
        np.array(successors, dtype=np.int32), store.sizes, store.colours, np.array(parts, dtype=np.uint64), starts, np.concatenate(kept)
    )
