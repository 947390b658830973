"""Automata as files of JFLAP, the teaching tool with which the paper's automata were made."""

import math
from pathlib import Path
from xml.etree import ElementTree

from ial.bouncing.exports.finite_automaton import FiniteAutomaton
from ial.errors import FilterError

_APART = 120.0


def jff_text(automaton: FiniteAutomaton) -> str:
    """Return an automaton as XML; an empty ``<read/>`` is a silent transition. The states stand in a square; JFLAP can move them."""
    root = ElementTree.Element("structure")
    ElementTree.SubElement(root, "type").text = "fa"
    body = ElementTree.SubElement(root, "automaton")
    columns = math.ceil(math.sqrt(len(automaton.names)))
    for place, (number, name) in enumerate(automaton.names.items()):
        state = ElementTree.SubElement(body, "state", id=str(number), name=name)
        ElementTree.SubElement(state, "x").text = str(_APART * (place % columns + 1))
        ElementTree.SubElement(state, "y").text = str(_APART * (place // columns + 1))
        if number == automaton.initial:
            ElementTree.SubElement(state, "initial")
        if number in automaton.final:
            ElementTree.SubElement(state, "final")
    for start, read, end in automaton.transitions:
        arc = ElementTree.SubElement(body, "transition")
        for tag, text in (("from", str(start)), ("to", str(end)), ("read", read)):
            ElementTree.SubElement(arc, tag).text = text or None
    ElementTree.indent(root)
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + ElementTree.tostring(root, encoding="unicode") + "\n"


def read_jff(path: str | Path) -> FiniteAutomaton:
    """Read a finite automaton.

    Raises
    ------
    FilterError
        If the file cannot be read, is no finite automaton of JFLAP, has no start or several, or a transition begins or ends at no state.
    """
    path = Path(path)
    try:
        root = ElementTree.fromstring(path.read_bytes())
    except OSError as error:
        raise FilterError(f"{path}: the automaton cannot be read ({error.strerror or error}); check the path") from None
    except ElementTree.ParseError as error:
        raise FilterError(f"{path}: no XML, or a truncated file ({error}); write it again") from None
    body = root.find("automaton")
    if root.tag != "structure" or root.findtext("type") != "fa" or body is None:
        raise FilterError(f"{path}: no finite automaton of JFLAP (structure, type fa, automaton); save it as one")
    try:
        states = {int(state.attrib["id"]): state for state in body.iterfind("state")}
        transitions = tuple(
            (int(arc.findtext("from", "")), arc.findtext("read") or "", int(arc.findtext("to", ""))) for arc in body.iterfind("transition")
        )
    except (KeyError, ValueError):
        raise FilterError(f"{path}: a state or a transition has no whole number where it needs one; write the file again") from None
    strays = {end for start, _, to in transitions for end in (start, to)} - states.keys()
    if strays:
        raise FilterError(f"{path}: a transition begins or ends at state {min(strays)}, which does not exist; correct the file")
    initial = [number for number, state in states.items() if state.find("initial") is not None]
    if len(initial) != 1:
        raise FilterError(f"{path}: {len(initial)} states are initial; mark exactly one")
    final = frozenset(number for number, state in states.items() if state.find("final") is not None)
    return FiniteAutomaton({number: state.get("name", f"q{number}") for number, state in states.items()}, initial[0], final, transitions)
