"""`SetAutomaton`: the deterministic automaton of a set-valued map, which shows what compiling one would cost."""

from collections import deque
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ial.bouncing.cells.noisy_model import NoisyModel
from ial.bouncing.cells.set_graph import SetGraph
from ial.errors import FilterError


@dataclass(frozen=True, eq=False)
class SetAutomaton:
    """The deterministic automaton of a set-valued graph; state 0 is the start.

    Parameters
    ----------
    successors
        The state after each observation, int32 of shape (states, 2), −1 where there is none.
    sizes
        How many vertices the robot can be in, int64 of shape (states,).
    """

    successors: npt.NDArray[np.int32]
    sizes: npt.NDArray[np.int64]

    def __len__(self) -> int:
        return len(self.sizes)

    def __repr__(self) -> str:
        return f"<SetAutomaton of {len(self)} states>"


def determinize_sets(graph: SetGraph, most_states: int = 100_000) -> SetAutomaton:
    """Return the deterministic automaton of a set-valued graph. Sets may overlap in every way, so there may be very many.

    Raises
    ------
    FilterError
        If there would be more states than allowed.
    """
    model = NoisyModel(graph)
    start = model.universe()
    numbers = {start.tobytes(): 0}
    waiting, successors, sizes = deque([start]), [], [len(start)]
    while waiting:
        held, row = waiting.popleft(), []
        for label in (0, 1):
            reached = np.sort(model.step(held, None, label))
            if not len(reached):
                row.append(-1)
                continue
            number = numbers.setdefault(reached.tobytes(), len(numbers))
            if number == len(sizes):
                if number >= most_states:
                    raise FilterError(
                        f"the automaton has more than {most_states} states; use larger cells, smaller bounds of errors, or the filter "
                        "of sets, which needs no automaton"
                    )
                sizes.append(len(reached))
                waiting.append(reached)
            row.append(number)
        successors.append(row)
    return SetAutomaton(np.array(successors, dtype=np.int32), np.array(sizes, dtype=np.int64))
