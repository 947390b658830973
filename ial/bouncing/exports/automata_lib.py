"""`to_automata`: an automaton as an object of automata-lib, which is no dependency of ial."""

from importlib import import_module
from typing import Any

from ial.bouncing.exports.finite_automaton import FiniteAutomaton


def to_automata(automaton: FiniteAutomaton) -> Any:
    """Return ``automata.fa.dfa.DFA`` if the automaton is deterministic, else ``automata.fa.nfa.NFA``; states are numbers.

    Raises
    ------
    ImportError
        If automata-lib is not installed.
    """
    kind = "DFA" if automaton.deterministic else "NFA"
    try:
        library = import_module(f"automata.fa.{kind.lower()}")
    except ImportError as error:
        raise ImportError("automata-lib is not installed; install it with 'pip install automata-lib'") from error
    arcs: dict[int, dict[str, Any]] = {state: {} for state in automaton.names}
    for start, read, end in automaton.transitions:
        if kind == "DFA":
            arcs[start][read] = end
        else:
            arcs[start].setdefault(read, set()).add(end)
    return getattr(library, kind)(
        states=set(automaton.names),
        input_symbols={"0", "1"},
        transitions=arcs,
        initial_state=automaton.initial,
        final_states=set(automaton.final),
        **({"allow_partial": True} if kind == "DFA" else {}),
    )
