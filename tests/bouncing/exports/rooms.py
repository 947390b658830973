"""Rooms of 19 free cells, and streams for the filters of them."""

from fractions import Fraction

import numpy as np

from ial.bouncing.cells.cell_map import CellMap
from ial.bouncing.filters.bounce_filter import BounceFilter
from ial.maps.polygons.raster import Raster
from tests.bouncing.worlds import drawn, observations

ROOMS = {
    "corner": drawn("....# ...#. ..#.. ..... ###.."),
    "niches": drawn("..##. ..... ##... ....# ..#.."),
}


def own_streams(made: BounceFilter, steps: int = 60) -> list[list[int]]:
    """What a robot observes from every configuration of every environment."""
    setting = made.setting
    graphs = [CellMap(Raster(ROOMS[name], Fraction(1, 2)), setting.headings, setting.corner).graph for name in setting.names]
    return [observations(graph, start, steps)[0] for graph in graphs for start in range(len(graph))]


def random_streams(count: int = 300, steps: int = 80) -> list[list[int]]:
    """Streams that no robot makes, with few bumps or many; nearly all of them trap."""
    chooser = np.random.default_rng(7)
    return [(chooser.random(steps) < chooser.random()).astype(int).tolist() for _ in range(count)]
