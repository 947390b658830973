"""`build_robust_filter`: from environments to the filter of a robot with real geometry and bounded errors."""

from collections.abc import Mapping
from fractions import Fraction

import numpy as np

from ial.bouncing.automata.set_automaton import NOT_LOCALIZED, SetAutomaton, determinize_sets
from ial.bouncing.automata.table import FilterTable
from ial.bouncing.cells.headings import Headings
from ial.bouncing.cells.noisy_map import NoisyMap
from ial.bouncing.cells.set_graph import disjoint_set_union
from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.filters.building import common_cell
from ial.bouncing.filters.goal import Goal
from ial.bouncing.filters.robust_filter import RobustFilter
from ial.bouncing.filters.setting import Setting
from ial.bouncing.filters.state_places import StatePlaces
from ial.errors import FilterError
from ial.maps.polygons.environment import Environment

GROWTHS = tuple(map(Fraction, ("0", "1/2", "1", "2", "3", "4", "6", "8")))
MOST_ROBUST_STATES = 20_000


def build_robust_filter(
    environments: Mapping[str, Environment],
    headings: Headings,
    cell: Fraction | None,
    goal: Goal,
    bounds: ExecutionBounds,
    radius: Fraction = Fraction(0),
    most_states: int = MOST_ROBUST_STATES,
) -> RobustFilter:
    """Return the filter of a robot in one of several environments, a point or a disk, that starts anywhere in any heading.

    Parameters
    ----------
    environments
        The environments by their names.
    headings
        The headings, the bouncing angle and the step.
    cell
        The width of a cell in metres; by default that of the grid the environments come from.
    goal
        When the robot counts as localized.
    bounds
        What the robot may do wrong.
    radius
        The radius of the robot in metres.
    most_states
        At most so many states: larger sets stand for others as far as that is needed, see `determinize_sets`.

    Raises
    ------
    ConfigError
        If a number cannot be meant.
    MapError
        If the robot fits nowhere in an environment, or there would be too many cells or walls.
    FilterError
        If no filter of so many states ever localizes the robot.
    """
    width = common_cell(environments, cell)
    maps = {name: NoisyMap(each, width, headings, bounds, radius) for name, each in environments.items()}
    graph, place_of = disjoint_set_union([each.graph for each in maps.values()])
    rasters = {name: each.raster for name, each in maps.items()}
    setting = Setting.of_rasters(rasters, headings, radius, "centre", "segment", merged=False)
    parts = [np.nonzero(raster.free) for raster in rasters.values()]
    environment = np.concatenate([np.full(len(rows) * headings.count, number) for number, (rows, _) in enumerate(parts)])
    row, column = (np.concatenate([np.tile(part[side], headings.count) for part in parts]) for side in (0, 1))
    heading = np.concatenate([np.repeat(np.arange(headings.count), len(rows)) for rows, _ in parts])
    judge = goal.judge(setting, environment, row, column)
    for growth in GROWTHS:
        try:
            automaton = determinize_sets(graph, most_states, lambda held: judge(place_of[held]), growth, environment[place_of])
        except FilterError:
            continue
        if (automaton.colours != NOT_LOCALIZED).any():
            break
        raise FilterError(
            f"a filter of at most {most_states} states never localizes this robot; allow more states, a larger width or larger rooms, "
            "use more headings and smaller cells, or the ray mode, which needs no table"
        )
    else:
        raise FilterError(f"no filter of at most {most_states} states exists; allow more")
    starts = np.append(automaton.starts, automaton.starts[-1])
    places = StatePlaces(
        starts,
        place_of[automaton.members].astype(np.int64),
        environment,
        row.astype(np.int64),
        column.astype(np.int64),
        heading,
        np.arange(headings.count + 1),
        np.arange(headings.count),
    )
    return RobustFilter(_table(automaton, goal), places, setting, bounds, goal, growth)


def _table(automaton: SetAutomaton, goal: Goal) -> FilterTable:
    """Return the table of an automaton for the open world: what has no successor leads to the trap, which is never left."""
    trap = len(automaton)
    arcs = np.where(automaton.successors < 0, trap, automaton.successors)
    return FilterTable(
        np.vstack([arcs, [[trap, trap]]]).astype(np.int32),
        np.append(automaton.colours, np.int32(2 + goal.colours)),
        np.append(automaton.sizes, np.int64(0)),
        np.append(automaton.parts, np.uint64(0)),
    )
