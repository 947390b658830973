"""`FiniteAutomaton`: states, transitions and final states as other tools know them."""

from dataclasses import dataclass

import numpy as np

from ial.bouncing.automata.nondeterministic import NondeterministicAutomaton
from ial.bouncing.automata.table import FilterTable

Transition = tuple[int, str, int]


@dataclass(frozen=True)
class FiniteAutomaton:
    """An automaton over texts, deterministic or not.

    Parameters
    ----------
    names
        The names of the states by their numbers.
    initial
        Where it starts.
    final
        Which states are final.
    transitions
        (from, read, to); what reads an empty text is silent.
    """

    names: dict[int, str]
    initial: int
    final: frozenset[int]
    transitions: tuple[Transition, ...]

    @classmethod
    def of_table(cls, table: FilterTable) -> "FiniteAutomaton":
        """Return a filter with its trap; the states in which the robot is localized are final."""
        names = {state: "trap" if state == table.trap else f"q{state}" for state in range(len(table))}
        final = frozenset(state for state in names if table.is_localized(state))
        arcs = enumerate(table.successors.tolist())
        return cls(names, 0, final, tuple((state, str(letter), to) for state, row in arcs for letter, to in enumerate(row)))

    @classmethod
    def of_nondeterministic(cls, automaton: NondeterministicAutomaton) -> "FiniteAutomaton":
        """Return a nondeterministic automaton with its start, ``start``, and its vertices, ``v0`` and so on."""
        names = {0: "start"} | {state: f"v{state - 1}" for state in range(1, len(automaton))}
        return cls(names, 0, frozenset(np.flatnonzero(automaton.final).tolist()), tuple(automaton.transitions()))

    @property
    def deterministic(self) -> bool:
        """Whether no transition is silent, and no state has two that read the same."""
        read = [(state, text) for state, text, _ in self.transitions]
        return all(text for _, text in read) and len(set(read)) == len(read)
