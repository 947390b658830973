"""The bouncing robot: localization from a contact sensor and a clock (Alam, Bobadilla, Shell 2017).

Names are loaded when they are first used.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ial.bouncing.automaton import Automaton as Automaton
    from ial.bouncing.cell_map import CellMap as CellMap
    from ial.bouncing.determinization import determinize as determinize
    from ial.bouncing.graph import LabelledGraph as LabelledGraph
    from ial.bouncing.graph import disjoint_union as disjoint_union
    from ial.bouncing.groups import PeriodicGroups as PeriodicGroups
    from ial.bouncing.groups import periodic_groups as periodic_groups
    from ial.bouncing.headings import Headings as Headings
    from ial.bouncing.model import BouncingModel as BouncingModel
    from ial.bouncing.nondeterministic import NondeterministicAutomaton as NondeterministicAutomaton
else:
    from ial.lazy import lazy as _lazy

    __getattr__, __dir__, __all__ = _lazy(
        __name__,
        {
            "automaton": ("Automaton",),
            "cell_map": ("CellMap",),
            "determinization": ("determinize",),
            "graph": ("LabelledGraph", "disjoint_union"),
            "groups": ("PeriodicGroups", "periodic_groups"),
            "headings": ("Headings",),
            "model": ("BouncingModel",),
            "nondeterministic": ("NondeterministicAutomaton",),
        },
    )
