"""What exact filters come to, and for whom they are right: simulated robots with real geometry decide that."""

from fractions import Fraction

import numpy as np
import pytest

from ial.bouncing.cells.headings import Headings
from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.exports.c_tables import CTables
from ial.bouncing.exports.exported_filter import ExportedFilter
from ial.bouncing.filters.building import all_free_cells, build_filter
from ial.bouncing.planning import cell_choice
from ial.bouncing.planning.cell_choice import CellChoice, faults_of, lattice_m
from ial.maps.polygons.environment import Environment
from ial.maps.polygons.outline import outlines
from ial.maps.polygons.raster import Rule
from ial.maps.polygons.wkt import parse_wkt
from tests.bouncing.judged_runs import WORLDS, judged, robots

HALL = WORLDS["hall"]
SQUARE, DIAGONAL = Headings.of_angle(Fraction(90)), Headings.of_angle(Fraction(45))
NONE = ExecutionBounds()
ERRORS = ExecutionBounds(Fraction(1), Fraction(1, 50))


def faults(cell: Fraction, headings: Headings, radius: Fraction, rule: Rule = "centre", bounds: ExecutionBounds = NONE) -> list[str]:
    return list(faults_of(lattice_m([HALL]), cell, headings, radius, rule, bounds))


@pytest.mark.parametrize("world", WORLDS)
@pytest.mark.parametrize(("cell", "radius"), [("1", "1/2"), ("1", "2/5"), ("1", "3/10"), ("1/2", "1/4"), ("1/2", "1/5"), ("1/3", "1/6")])
def test_a_robot_for_which_a_filter_is_right_is_told_the_right_places(world: str, cell: str, radius: str) -> None:
    environment, width, size = WORLDS[world], Fraction(cell), Fraction(radius)
    assert list(faults_of(lattice_m([environment]), width, SQUARE, size, "centre", NONE)) == []
    made = build_filter({world: environment}, SQUARE, width, size)
    assert judged(made, robots(environment, made, 12)) == {"right": 12}


@pytest.mark.parametrize(
    ("cell", "headings", "radius", "rule", "bounds", "fault"),
    [
        (1, SQUARE, 0, "centre", NONE, "it is a point"),
        (1, SQUARE, Fraction(1, 2), "inside", NONE, "the rule inside"),
        (1, SQUARE, Fraction(1, 2), "centre", ERRORS, "it errs"),
        (1, DIAGONAL, Fraction(1, 2), "centre", NONE, "steps do not lead from centre to centre"),
    ],
)
def test_a_robot_for_which_a_filter_is_wrong_is_told_wrong_places(
    cell: int, headings: Headings, radius: Fraction, rule: Rule, bounds: ExecutionBounds, fault: str
) -> None:
    assert [each for each in faults(Fraction(cell), headings, Fraction(radius), rule, bounds) if each.startswith(fault)]
    made = build_filter({"hall": HALL}, headings, Fraction(cell), Fraction(radius), rule)
    outcomes = judged(made, robots(HALL, made, 40, bounds))
    assert outcomes["right"] < 40
    assert outcomes["wrong"] + outcomes["rejected"] > 0


def test_each_fault_is_named() -> None:
    half, one = Fraction(1, 2), Fraction(1)
    assert faults(one, SQUARE, half) == []
    assert faults(one, SQUARE, Fraction(1, 4)) == ["it is much narrower than a cell"]
    assert faults(half, SQUARE, half) == ["it is wider than a cell"]
    assert faults(Fraction(2, 3), SQUARE, Fraction(1, 3)) == ["walls are not on the lattice of cells"]
    assert faults(one, Headings.of_angle(Fraction(90), None, Fraction(2)), half) == ["a step leads over several cells"]
    assert faults(one, Headings.of_angle(Fraction(90), None, Fraction(3, 4)), half) == ["steps do not lead from centre to centre"]
    assert list(faults_of(None, one, SQUARE, half, "centre", NONE)) == ["walls are not on the lattice of cells"]


def test_the_lattice_of_walls_is_the_widest_on_which_all_run() -> None:
    free = np.zeros((9, 9), dtype=bool)
    free[:6, :9] = free[:9, :3] = True
    assert lattice_m([Environment(outlines(free, Fraction(1, 20), (Fraction(1, 7), Fraction(0))))]) == Fraction(3, 20)
    two = [Environment(parse_wkt(f"POLYGON ((0 0, {w} 0, {w} {h}, 0 {h}, 0 0))")) for w, h in (("6", "9"), ("1.2", "4.8"))]
    assert lattice_m(two[:1]) == 3
    assert lattice_m(two) == Fraction(3, 5)
    assert lattice_m([*two, Environment(parse_wkt("POLYGON ((0 0, 6 0, 0 6, 0 0))"))]) is None


def test_what_a_filter_takes_is_what_it_takes() -> None:
    rasters = all_free_cells({"hall": HALL}, Fraction(1), Fraction(1, 2))
    choice = CellChoice.of(rasters, SQUARE, Fraction(1, 2), "centre", [], 10_000)
    made = build_filter({"hall": HALL}, SQUARE, Fraction(1), Fraction(1, 2))
    tables = CTables.of(ExportedFilter.of(made), "bounce")
    assert (choice.configurations, choice.states, choice.more_than) == (made.table.uncertainty[0], len(made.table) - 1, None)
    assert (choice.flash_bytes, choice.stepping_bytes, choice.ram_bytes) == (tables.flash_bytes, tables.stepping_bytes, tables.ram_bytes)
    assert choice.is_right
    assert not CellChoice.of(rasters, SQUARE, Fraction(1, 2), "centre", ["it errs"], 10_000).is_right


def test_what_is_too_large_is_not_guessed(monkeypatch: pytest.MonkeyPatch) -> None:
    rasters = all_free_cells({"hall": HALL}, Fraction(1))
    choice = CellChoice.of(rasters, SQUARE, Fraction(0), "centre", [], 50)
    assert (choice.states, choice.more_than, choice.flash_bytes, choice.configurations) == (None, 50, None, 196)
    assert not choice.is_right
    monkeypatch.setattr(cell_choice, "MOST_CONFIGURATIONS", 195)
    choice = CellChoice.of(rasters, SQUARE, Fraction(0), "centre", [], 50)
    assert (choice.refusal, choice.states, choice.more_than) == ("more than 195 configurations", None, None)
