"""`FilterTable`: an automaton as a filter, with a colour for each state (definitions 8 and 9 of Alam et al. 2017)."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ial.bouncing.automata.automaton import Automaton
from ial.errors import StreamError


@dataclass(frozen=True, eq=False)
class FilterTable:
    """States 0 (nothing is known yet) … states − 1, and after them the trap, where the observations fit no place at all.

    Parameters
    ----------
    successors
        The state after each observation, int32 of shape (states + 1, 2).
    colours
        1 until the robot is localized, then 2 + number of its knowledge cycle; the trap has the last colour. int32 of shape (states + 1,).
    uncertainty
        In how many configurations the robot can be, int64 of shape (states + 1,); 0 in the trap.
    environments
        In which environments, as bits, uint64 of shape (states + 1,); 0 in the trap.
    """

    successors: npt.NDArray[np.int32]
    colours: npt.NDArray[np.int32]
    uncertainty: npt.NDArray[np.int64]
    environments: npt.NDArray[np.uint64]

    def __repr__(self) -> str:
        return f"<FilterTable of {len(self) - 1} states and a trap, {self.cycles} knowledge cycles>"

    @classmethod
    def of(cls, automaton: Automaton) -> "FilterTable":
        """Return the filter of an automaton for the open world: what has no arc leads to the trap, which is never left."""
        trap = len(automaton)
        arcs = np.where(automaton.successors < 0, trap, automaton.successors)
        return cls(
            np.vstack([arcs, [[trap, trap]]]).astype(np.int32),
            np.append(automaton.colours, np.int32(len(automaton.cycles) + 2)),
            np.append(automaton.uncertainty, np.int64(0)),
            np.append(automaton.environments, np.uint64(0)),
        )

    def __len__(self) -> int:
        return len(self.successors)

    @property
    def trap(self) -> int:
        """The number of the trap."""
        return len(self) - 1

    @property
    def cycles(self) -> int:
        """How many knowledge cycles there are."""
        return int(self.colours[-1]) - 2

    def restarting(self) -> "FilterTable":
        """Return a filter that goes on from the trap as from the start: for robots that may be carried elsewhere."""
        arcs = self.successors.copy()
        arcs[self.trap] = arcs[0]
        return FilterTable(arcs, self.colours, self.uncertainty, self.environments)

    def step(self, state: int, observation: int) -> int:
        """Return the state after an observation, 1 for a bump and 0 for none: one look-up."""
        return int(self.successors[state, observation])

    def run(self, stream: Iterable[int], state: int = 0) -> list[int]:
        """Return the states after each observation of a stream."""
        states = []
        for observation in stream:
            state = self.step(state, observation)
            states.append(state)
        return states

    def run_closed(self, stream: Iterable[int]) -> list[int]:
        """Return the states after each observation of a robot that is known to be in the environment.

        Raises
        ------
        StreamError
            If an observation is impossible there.
        """
        states = self.run(stream)
        if self.trap in states:
            raise StreamError(
                f"observation {states.index(self.trap) + 1} of the stream fits no place of the environment, but the world is closed; check "
                "the map and the bouncing angle, or use the open world"
            )
        return states

    def is_localized(self, state: int) -> bool:
        """Return whether a state is on a knowledge cycle, which tells as much as can ever be known."""
        return 1 < int(self.colours[state]) < int(self.colours[-1])

    def possible(self, state: int) -> list[int]:
        """Return the numbers of the environments in which the robot can be."""
        bits = int(self.environments[state])
        return [number for number in range(bits.bit_length()) if bits >> number & 1]
