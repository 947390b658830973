import numpy as np
import pytest

from ial.bouncing.automata.cycle_walk import walk_cycles


@pytest.mark.parametrize("trap", [-1, 6])
def test_states_are_numbered_along_their_cycles(trap: int) -> None:
    # 0 leads to both cycles: 3 → 1 → 4 → 3, and 5 alone; 2 leads to the first. With a trap, 6 is the trap itself.
    arcs = [[3, 5], [4, trap], [trap, 1], [trap, 1], [3, trap], [trap, 5], [6, 6]]
    successors = np.array(arcs[: 6 if trap < 0 else 7], dtype=np.int32)
    cycle, steps = walk_cycles(successors, np.array([3, 5], dtype=np.int32), trap)
    assert cycle.tolist()[:6] == [-1, 0, -1, 0, 0, 1]
    assert steps.tolist()[:6] == [-1, 1, -1, 0, 2, 0]
    assert set(cycle.tolist()[6:]) <= {-1}
