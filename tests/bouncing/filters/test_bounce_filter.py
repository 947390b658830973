from fractions import Fraction

import numpy as np
import pytest

from ial.bouncing.automata.determinization import determinize
from ial.bouncing.cells.graph import disjoint_union
from ial.bouncing.cells.groups import periodic_groups
from ial.bouncing.cells.headings import Headings
from ial.bouncing.filters.bounce_filter import BounceFilter
from ial.bouncing.filters.building import build_filter
from ial.errors import ConfigError, FilterError, MapError
from ial.maps.polygons.environment import Environment
from ial.maps.polygons.outline import outlines
from ial.maps.polygons.wkt import parse_wkt
from tests.bouncing.worlds import HALL, STORE, cell_map, drawn, twin_information_states


def test_places_are_those_of_the_sets(made: BounceFilter) -> None:
    maps = [cell_map(free, 90, 24) for free in (HALL, STORE)]
    automaton = determinize(disjoint_union([each.graph for each in maps]))
    _, sets = twin_information_states(automaton.graph)
    assert len(made.table) == len(automaton) + 1
    for state in np.flatnonzero(automaton.colours > 1).tolist():
        places = {(p.environment, p.x_m, p.y_m, heading) for p in made.where(state) for heading in p.headings_deg}
        expected = set()
        for vertex in sets[state]:
            number = int(automaton.graph.part_of(vertex))
            row, column, heading = (int(each) for each in maps[number].configurations(vertex - automaton.graph.starts[number]))
            x, y = Fraction(2 * column + 1, 4), Fraction(2 * row + 1, 4)
            expected.add((("hall", "store")[number], x, y, Fraction(15 * heading)))
        assert places == expected
        assert len(places) == made.table.uncertainty[state]
    assert made.where(0) == made.where(made.table.trap) == []


def test_trapped_configurations_are_counted(made: BounceFilter) -> None:
    free = drawn(".#.... ##.... ...... .....#")
    environment = Environment(outlines(free), Fraction(1))
    assert build_filter({"cell": environment}, Headings.of_angle(Fraction(90), 8)).trapped == 8
    groups = [periodic_groups(cell_map(mask, 90, 24).graph) for mask in (HALL, STORE)]
    assert made.trapped == sum(int(each.periods[each.bumping].sum()) for each in groups)


def test_what_cannot_be_built_is_refused() -> None:
    room, headings = Environment(parse_wkt("POLYGON ((0 0, 4 0, 4 3, 0 3, 0 0))")), Headings.of_angle(Fraction(90))
    with pytest.raises(ConfigError, match="no environment"):
        build_filter({}, headings)
    with pytest.raises(ConfigError, match="width of a cell is not known"):
        build_filter({"room": room}, headings)
    with pytest.raises(MapError, match=r"room: no cell is free for a robot of radius 2 m in cells of 1 m"):
        build_filter({"room": room}, headings, Fraction(1), Fraction(2))
    with pytest.raises(FilterError, match="more than 3 states"):
        build_filter({"room": room}, headings, Fraction(1), most_states=3)
    assert build_filter({"room": room}, headings, Fraction(1), Fraction(1)).table.uncertainty[0] == 8


def test_the_step_of_a_class_of_headings_is_where_its_places_lead(made: BounceFilter) -> None:
    places = made.places
    for vertex, following in enumerate(places.following.tolist()):
        moved = (int(places.column[following] - places.column[vertex]), int(places.row[following] - places.row[vertex]))
        assert moved in ((0, 0), made.step_of(int(places.heading_class[vertex])))
    assert made.step_of(0) == (1, 0)
