import sys
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

from ial.bouncing.automata.determinization import determinize
from ial.bouncing.automata.nondeterministic import NondeterministicAutomaton
from ial.bouncing.automata.table import FilterTable
from ial.bouncing.exports.automata_lib import to_automata
from ial.bouncing.exports.finite_automaton import FiniteAutomaton
from ial.bouncing.exports.jflap import jff_text, read_jff
from ial.bouncing.filters.bounce_filter import BounceFilter
from ial.errors import FilterError
from tests.bouncing.exports.rooms import random_streams
from tests.bouncing.worlds import HALL, cell_map


@pytest.fixture(scope="module")
def nondeterministic() -> NondeterministicAutomaton:
    return NondeterministicAutomaton.of(cell_map(HALL).graph)


def test_a_filter_comes_back(small: BounceFilter, tmp_path: Path) -> None:
    automaton = FiniteAutomaton.of_table(small.table)
    (tmp_path / "a.jff").write_text(jff_text(automaton))
    again = read_jff(tmp_path / "a.jff")
    assert again == automaton
    assert again.deterministic
    arcs = np.full_like(small.table.successors, -1)
    for start, read, end in again.transitions:
        arcs[start, int(read)] = end
    assert np.array_equal(arcs, small.table.successors)
    assert again.final == {state for state in range(len(small.table)) if small.table.is_localized(state)}


def test_a_nondeterministic_automaton_comes_back(nondeterministic: NondeterministicAutomaton, tmp_path: Path) -> None:
    automaton = FiniteAutomaton.of_nondeterministic(nondeterministic)
    (tmp_path / "a.jff").write_text(jff_text(automaton))
    again = read_jff(tmp_path / "a.jff")
    assert again == automaton
    assert not again.deterministic
    assert again.transitions == tuple(nondeterministic.transitions())


def test_the_elements_are_those_of_jflap(nondeterministic: NondeterministicAutomaton) -> None:
    root = ElementTree.fromstring(jff_text(FiniteAutomaton.of_nondeterministic(nondeterministic)))
    assert [element.tag for element in root] == ["type", "automaton"]
    body = root[1]
    states, arcs = body.findall("state"), body.findall("transition")
    assert len(body) == len(states) + len(arcs)
    assert all(set(state.attrib) == {"id", "name"} for state in states)
    assert len({(state.findtext("x"), state.findtext("y")) for state in states}) == len(states) == len(nondeterministic)
    assert [state.get("id") for state in states if state.find("initial") is not None] == ["0"]
    assert [[child.tag for child in arc] for arc in arcs] == [["from", "to", "read"]] * len(arcs)
    silent = [arc for arc in arcs if not arc.find("read").text]  # type: ignore[union-attr]
    assert {arc.findtext("from") for arc in silent} == {"0"}
    assert len(silent) == len(nondeterministic) - 1


GOOD = '<structure><type>fa</type><automaton><state id="0" name="a"><initial/></state></automaton></structure>'


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (GOOD[:40], "no XML, or a truncated file"),
        (GOOD.replace("fa<", "pda<"), "no finite automaton of JFLAP"),
        (GOOD.replace("structure", "graph"), "no finite automaton of JFLAP"),
        (GOOD.replace("<initial/>", ""), "0 states are initial; mark exactly one"),
        (GOOD.replace('id="0"', 'id="zero"'), "no whole number"),
        (GOOD.replace("</auto", "<transition><from>0</from><read/></transition></auto"), "no whole number"),
        (GOOD.replace("</auto", "<transition><from>0</from><to>7</to><read/></transition></auto"), "at state 7, which does not exist"),
    ],
)
def test_other_files_are_refused(text: str, message: str, tmp_path: Path) -> None:
    (tmp_path / "a.jff").write_text(text)
    with pytest.raises(FilterError, match=message):
        read_jff(tmp_path / "a.jff")


def test_a_missing_file_is_refused(tmp_path: Path) -> None:
    with pytest.raises(FilterError, match="cannot be read"):
        read_jff(tmp_path / "nowhere.jff")


def test_automata_lib_accepts_the_same_streams(corner: BounceFilter, nondeterministic: NondeterministicAutomaton) -> None:
    pytest.importorskip("automata", reason="automata-lib is not installed")
    streams = random_streams(80, 20)
    cases = [(FiniteAutomaton.of_table(corner.table), corner.table)]
    cases.append((FiniteAutomaton.of_nondeterministic(nondeterministic), FilterTable.of(determinize(nondeterministic.graph))))
    kinds = []
    for automaton, table in cases:
        theirs = to_automata(automaton)
        kinds.append(type(theirs).__name__)
        assert len(theirs.states) == len(automaton.names)
        for stream in streams:
            word = "".join(map(str, stream))
            if automaton.deterministic:
                assert theirs.accepts_input(word) == table.is_localized(table.run(stream)[-1])
            else:
                reached = set(nondeterministic.reach(word).tolist())
                assert theirs.accepts_input(word) == bool(reached & automaton.final)
    assert kinds == ["DFA", "NFA"]


def test_without_automata_lib(corner: BounceFilter, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "automata.fa.dfa", None)
    with pytest.raises(ImportError, match="pip install automata-lib"):
        to_automata(FiniteAutomaton.of_table(corner.table))
