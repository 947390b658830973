"""The walk along the knowledge cycles of an automaton: on which cycle a state lies, and how far from its anchor."""

import numpy as np
import numpy.typing as npt

from ial.contractors.kernels import kernel


def walk_cycles(
    successors: npt.NDArray[np.int32], anchors: npt.NDArray[np.int32], trap: int = -1
) -> tuple[npt.NDArray[np.int32], npt.NDArray[np.int64]]:
    """Return the number of the knowledge cycle of each state, and how many steps the state stands past the anchor of that cycle.

    Parameters
    ----------
    successors
        The state after each observation, int32 of shape (states, 2). On a cycle one of the two is `trap`.
    anchors
        One state of each cycle, int32 of shape (cycles,).
    trap
        Where an observation leads that cannot be made.

    Returns
    -------
    cycle, steps
        int32 and int64 of shape (states,); −1 outside of knowledge cycles.
    """
    cycle, steps = np.full(len(successors), -1, dtype=np.int32), np.full(len(successors), -1, dtype=np.int64)
    _walk(successors, anchors, trap, cycle, steps)
    return cycle, steps


@kernel
def _walk(successors, anchors, trap, cycle, steps):  # type: ignore[no-untyped-def]
    for number in range(len(anchors)):
        state = anchors[number]
        step = 0
        while cycle[state] < 0:
            cycle[state] = number
            steps[state] = step
            state = successors[state, 0] if successors[state, 1] == trap else successors[state, 1]
            step += 1
