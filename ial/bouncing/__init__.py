"""The bouncing robot: localization from a contact sensor and a clock (Alam, Bobadilla, Shell 2017).

Names are loaded when they are first used.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ial.bouncing.automata.automaton import Automaton as Automaton
    from ial.bouncing.automata.determinization import determinize as determinize
    from ial.bouncing.automata.minimal import minimize as minimize
    from ial.bouncing.automata.nondeterministic import NondeterministicAutomaton as NondeterministicAutomaton
    from ial.bouncing.automata.set_automaton import SetAutomaton as SetAutomaton
    from ial.bouncing.automata.set_automaton import determinize_sets as determinize_sets
    from ial.bouncing.automata.table import FilterTable as FilterTable
    from ial.bouncing.bump_event import BumpEvent as BumpEvent
    from ial.bouncing.bump_log import bump_events as bump_events
    from ial.bouncing.bump_log_file import write_log as write_log
    from ial.bouncing.bump_timing import BumpTiming as BumpTiming
    from ial.bouncing.calibration import Calibration as Calibration
    from ial.bouncing.calibration import LeastBound as LeastBound
    from ial.bouncing.cells.cell_map import CellMap as CellMap
    from ial.bouncing.cells.graph import LabelledGraph as LabelledGraph
    from ial.bouncing.cells.graph import disjoint_union as disjoint_union
    from ial.bouncing.cells.groups import PeriodicGroups as PeriodicGroups
    from ial.bouncing.cells.groups import periodic_groups as periodic_groups
    from ial.bouncing.cells.headings import Headings as Headings
    from ial.bouncing.cells.model import BouncingModel as BouncingModel
    from ial.bouncing.cells.noisy_map import NoisyMap as NoisyMap
    from ial.bouncing.cells.noisy_model import NoisyModel as NoisyModel
    from ial.bouncing.cells.set_graph import SetGraph as SetGraph
    from ial.bouncing.execution_bounds import ExecutionBounds as ExecutionBounds
    from ial.bouncing.filters.bank import FilterBank as FilterBank
    from ial.bouncing.filters.bounce_filter import BounceFilter as BounceFilter
    from ial.bouncing.filters.bounce_filter import Place as Place
    from ial.bouncing.filters.building import build_filter as build_filter
    from ial.bouncing.filters.building import free_cells as free_cells
    from ial.bouncing.filters.bump_tracker import BumpTracker as BumpTracker
    from ial.bouncing.filters.bump_tracker import legs_of as legs_of
    from ial.bouncing.filters.cycle_places import CyclePlaces as CyclePlaces
    from ial.bouncing.filters.filter_file import read_filter as read_filter
    from ial.bouncing.filters.filter_file import write_filter as write_filter
    from ial.bouncing.filters.goal import Goal as Goal
    from ial.bouncing.filters.goal import Room as Room
    from ial.bouncing.filters.robust_building import build_robust_filter as build_robust_filter
    from ial.bouncing.filters.robust_filter import RobustFilter as RobustFilter
    from ial.bouncing.filters.setting import Setting as Setting
    from ial.bouncing.known_run import KnownRun as KnownRun
    from ial.bouncing.known_run import known_runs as known_runs
    from ial.bouncing.planning.angle_search import AngleSequence as AngleSequence
    from ial.bouncing.planning.angle_search import search_angles as search_angles
    from ial.bouncing.planning.information_sets import InformationSets as InformationSets
    from ial.bouncing.planning.phase import Phase as Phase
    from ial.bouncing.planning.trace_classes import trace_quotient as trace_quotient
    from ial.bouncing.rays.piece_map import PieceMap as PieceMap
    from ial.bouncing.rays.piece_model import PieceModel as PieceModel
    from ial.bouncing.rays.piece_model import PieceSet as PieceSet
    from ial.bouncing.rays.ray_model import RayModel as RayModel
    from ial.bouncing.rays.ray_set import RaySet as RaySet
    from ial.bouncing.rays.real_robot import RealPose as RealPose
    from ial.bouncing.rays.real_robot import RealRobot as RealRobot
    from ial.bouncing.simulated_log import simulated_log as simulated_log
    from ial.bouncing.stream import parse_stream as parse_stream
else:
    from ial.lazy import lazy as _lazy

    __getattr__, __dir__, __all__ = _lazy(
        __name__,
        {
            "planning.angle_search": ("AngleSequence", "search_angles"),
            "automata.automaton": ("Automaton",),
            "bump_event": ("BumpEvent",),
            "bump_log": ("bump_events",),
            "bump_log_file": ("write_log",),
            "bump_timing": ("BumpTiming",),
            "calibration": ("Calibration", "LeastBound"),
            "known_run": ("KnownRun", "known_runs"),
            "simulated_log": ("simulated_log",),
            "filters.bump_tracker": ("BumpTracker", "legs_of"),
            "filters.bank": ("FilterBank",),
            "filters.bounce_filter": ("BounceFilter", "Place"),
            "filters.building": ("build_filter", "free_cells"),
            "cells.cell_map": ("CellMap",),
            "filters.cycle_places": ("CyclePlaces",),
            "automata.determinization": ("determinize",),
            "filters.filter_file": ("read_filter", "write_filter"),
            "cells.graph": ("LabelledGraph", "disjoint_union"),
            "cells.groups": ("PeriodicGroups", "periodic_groups"),
            "cells.headings": ("Headings",),
            "planning.information_sets": ("InformationSets",),
            "automata.minimal": ("minimize",),
            "cells.model": ("BouncingModel",),
            "execution_bounds": ("ExecutionBounds",),
            "cells.noisy_map": ("NoisyMap",),
            "cells.noisy_model": ("NoisyModel",),
            "automata.nondeterministic": ("NondeterministicAutomaton",),
            "planning.phase": ("Phase",),
            "rays.piece_map": ("PieceMap",),
            "rays.piece_model": ("PieceModel", "PieceSet"),
            "rays.ray_model": ("RayModel",),
            "rays.ray_set": ("RaySet",),
            "rays.real_robot": ("RealPose", "RealRobot"),
            "automata.set_automaton": ("SetAutomaton", "determinize_sets"),
            "cells.set_graph": ("SetGraph",),
            "filters.goal": ("Goal", "Room"),
            "filters.robust_building": ("build_robust_filter",),
            "filters.robust_filter": ("RobustFilter",),
            "filters.setting": ("Setting",),
            "stream": ("parse_stream",),
            "automata.table": ("FilterTable",),
            "planning.trace_classes": ("trace_quotient",),
        },
    )
