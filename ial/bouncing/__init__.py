"""The bouncing robot: localization from a contact sensor and a clock (Alam, Bobadilla, Shell 2017).

Names are loaded when they are first used.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ial.bouncing.angle_search import AngleSequence as AngleSequence
    from ial.bouncing.angle_search import search_angles as search_angles
    from ial.bouncing.automaton import Automaton as Automaton
    from ial.bouncing.bank import FilterBank as FilterBank
    from ial.bouncing.bounce_filter import BounceFilter as BounceFilter
    from ial.bouncing.bounce_filter import Place as Place
    from ial.bouncing.building import build_filter as build_filter
    from ial.bouncing.building import free_cells as free_cells
    from ial.bouncing.cell_map import CellMap as CellMap
    from ial.bouncing.cycle_places import CyclePlaces as CyclePlaces
    from ial.bouncing.determinization import determinize as determinize
    from ial.bouncing.filter_file import read_filter as read_filter
    from ial.bouncing.filter_file import write_filter as write_filter
    from ial.bouncing.graph import LabelledGraph as LabelledGraph
    from ial.bouncing.graph import disjoint_union as disjoint_union
    from ial.bouncing.groups import PeriodicGroups as PeriodicGroups
    from ial.bouncing.groups import periodic_groups as periodic_groups
    from ial.bouncing.headings import Headings as Headings
    from ial.bouncing.information_sets import InformationSets as InformationSets
    from ial.bouncing.minimal import minimize as minimize
    from ial.bouncing.model import BouncingModel as BouncingModel
    from ial.bouncing.motion_bounds import MotionBounds as MotionBounds
    from ial.bouncing.noisy_map import NoisyMap as NoisyMap
    from ial.bouncing.noisy_model import NoisyModel as NoisyModel
    from ial.bouncing.nondeterministic import NondeterministicAutomaton as NondeterministicAutomaton
    from ial.bouncing.phase import Phase as Phase
    from ial.bouncing.ray_model import RayModel as RayModel
    from ial.bouncing.ray_set import RaySet as RaySet
    from ial.bouncing.real_robot import RealPose as RealPose
    from ial.bouncing.real_robot import RealRobot as RealRobot
    from ial.bouncing.set_automaton import SetAutomaton as SetAutomaton
    from ial.bouncing.set_automaton import determinize_sets as determinize_sets
    from ial.bouncing.set_graph import SetGraph as SetGraph
    from ial.bouncing.setting import Setting as Setting
    from ial.bouncing.stream import parse_stream as parse_stream
    from ial.bouncing.table import FilterTable as FilterTable
    from ial.bouncing.trace_classes import trace_quotient as trace_quotient
else:
    from ial.lazy import lazy as _lazy

    __getattr__, __dir__, __all__ = _lazy(
        __name__,
        {
            "angle_search": ("AngleSequence", "search_angles"),
            "automaton": ("Automaton",),
            "bank": ("FilterBank",),
            "bounce_filter": ("BounceFilter", "Place"),
            "building": ("build_filter", "free_cells"),
            "cell_map": ("CellMap",),
            "cycle_places": ("CyclePlaces",),
            "determinization": ("determinize",),
            "filter_file": ("read_filter", "write_filter"),
            "graph": ("LabelledGraph", "disjoint_union"),
            "groups": ("PeriodicGroups", "periodic_groups"),
            "headings": ("Headings",),
            "information_sets": ("InformationSets",),
            "minimal": ("minimize",),
            "model": ("BouncingModel",),
            "motion_bounds": ("MotionBounds",),
            "noisy_map": ("NoisyMap",),
            "noisy_model": ("NoisyModel",),
            "nondeterministic": ("NondeterministicAutomaton",),
            "phase": ("Phase",),
            "ray_model": ("RayModel",),
            "ray_set": ("RaySet",),
            "real_robot": ("RealPose", "RealRobot"),
            "set_automaton": ("SetAutomaton", "determinize_sets"),
            "set_graph": ("SetGraph",),
            "setting": ("Setting",),
            "stream": ("parse_stream",),
            "table": ("FilterTable",),
            "trace_classes": ("trace_quotient",),
        },
    )
