"""`build_filter`: from environments to the filter of a robot in one of them."""

from collections.abc import Callable, Mapping
from fractions import Fraction

import numpy as np

from ial.bouncing.automata.determinization import MOST_STATES, determinize
from ial.bouncing.automata.table import FilterTable
from ial.bouncing.cells.cell_map import CellMap
from ial.bouncing.cells.corner import Corner
from ial.bouncing.cells.graph import disjoint_union
from ial.bouncing.cells.headings import Headings
from ial.bouncing.filters.bounce_filter import BounceFilter
from ial.bouncing.filters.cycle_places import CyclePlaces
from ial.bouncing.filters.setting import Setting
from ial.bouncing.start import ANYWHERE, Start
from ial.errors import ConfigError, MapError
from ial.maps.polygons.environment import Environment
from ial.maps.polygons.erosion import erode
from ial.maps.polygons.raster import Raster, Rule, rasterize


def free_cells(environment: Environment, cell: Fraction, radius: Fraction = Fraction(0), rule: Rule = "centre") -> Raster:
    """Return the cells in which the centre of a disk robot can be.

    Raises
    ------
    MapError
        If there is none, or there would be too many cells.
    ConfigError
        If a number cannot be meant.
    """
    x0, y0, x1, y1 = environment.bounds
    raster = None if radius > (x1 - x0) + (y1 - y0) else erode(rasterize(environment, cell, rule), radius, rule)
    if raster is None or not raster.free.any():
        raise MapError(
            f"no cell is free for a robot of radius {float(radius):g} m in cells of {float(cell):g} m; use smaller cells, a smaller radius "
            "or the rule 'centre'"
        )
    return raster


def common_cell(environments: Mapping[str, Environment], cell: Fraction | None) -> Fraction:
    """Return the width of a cell in metres: the given one, or that of the grids the environments come from.

    Raises
    ------
    ConfigError
        If there is no environment, or the width is not known.
    """
    if not environments:
        raise ConfigError("no environment to be in; give at least one")
    width = cell or next(iter(environments.values())).cell
    if width is None or (cell is None and any(each.cell != width for each in environments.values())):
        raise ConfigError("the width of a cell is not known, since the environments are no grids with cells of one width; give it")
    return width


def all_free_cells(
    environments: Mapping[str, Environment], cell: Fraction | None = None, radius: Fraction = Fraction(0), rule: Rule = "centre"
) -> dict[str, Raster]:
    """Return the free cells of several environments by their names, all of one width.

    Parameters
    ----------
    environments
        The environments by their names.
    cell
        The width of a cell in metres; by default that of the grid the environments come from.
    radius, rule
        As for `free_cells`.

    Raises
    ------
    ConfigError
        If there is no environment, a number cannot be meant, or the width of a cell is not known.
    MapError
        If an environment has no free cell, or there would be too many.
    """
    width = common_cell(environments, cell)
    rasters = {}
    for name, environment in environments.items():
        try:
            rasters[name] = free_cells(environment, width, radius, rule)
        except MapError as error:
            raise MapError(f"{name}: {error}") from None
    return rasters


def build_filter(
    environments: Mapping[str, Environment],
    headings: Headings,
    cell: Fraction | None = None,
    radius: Fraction = Fraction(0),
    rule: Rule = "centre",
    corner: Corner = "segment",
    most_states: int = MOST_STATES,
    start: Start = ANYWHERE,
    progress: Callable[[int], object] | None = None,
    most_visits: int | None = None,
) -> BounceFilter:
    """Return the filter of a robot that is in one of several environments.

    Parameters
    ----------
    environments
        The environments by their names.
    headings
        The headings, the bouncing angle and the step.
    cell
        The width of a cell in metres; by default that of the grid the environments come from.
    radius
        The radius of the robot in metres.
    rule
        When a cell is free, see `rasterize` and `erode`.
    corner
        What a step must not touch, see `passed_cells`.
    most_states, progress, most_visits
        The number of states at which to give up, what is told how many were found, and how much work is allowed, see `determinize`.
    start
        What is known of the start, in each of the environments: the centre of the cell is in the region, and the heading is one of these.

    Raises
    ------
    ConfigError
        If there is no environment, a number cannot be meant, the width of a cell is not known, or the robot can start nowhere.
    MapError
        If an environment has no free cell, or there would be too many.
    TooManyStatesError
        If there would be too many states, or too much work to find them.
    """
    rasters = all_free_cells(environments, cell, radius, rule)
    return filter_of_cells(rasters, headings, radius, rule, corner, most_states, start, progress, most_visits)


def filter_of_cells(
    rasters: Mapping[str, Raster],
    headings: Headings,
    radius: Fraction,
    rule: Rule,
    corner: Corner,
    most_states: int,
    start: Start,
    progress: Callable[[int], object] | None,
    most_visits: int | None,
) -> BounceFilter:
    """Return the filter of a robot in one of several environments whose free cells are known already, see `all_free_cells`.

    Parameters and errors are those of `build_filter`; the radius and the rule are those that the cells were made with.
    """
    maps = [CellMap(raster, headings, corner, merge=True) for raster in rasters.values()]
    graph = disjoint_union([each.graph for each in maps])
    begins = [each.beginnings(start) + np.int32(first) for each, first in zip(maps, graph.starts, strict=False)]
    automaton = determinize(graph, most_states, begins=np.concatenate(begins), progress=progress, most_visits=most_visits)
    setting = Setting.of_rasters(dict(rasters), headings, radius, rule, corner, start=start)
    return BounceFilter(FilterTable.of(automaton), CyclePlaces.of(automaton, maps), setting)
