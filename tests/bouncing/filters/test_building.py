from fractions import Fraction

import pytest

from ial.bouncing.cells.headings import Headings
from ial.bouncing.filters.building import build_filter
from tests.bouncing.judged_runs import WORLDS, judged, robots

QUARTERS = Headings.of_angle(Fraction(90))


@pytest.mark.slow
@pytest.mark.parametrize("world", WORLDS)
def test_disks_as_wide_as_their_cells_are_localized_where_they_are(world: str) -> None:
    environment = WORLDS[world]
    made = build_filter({world: environment}, QUARTERS, Fraction(1), Fraction(1, 2))
    assert made.setting.rule == "centre"
    assert judged(made, robots(environment, made, 100)) == {"right": 100}


def test_cells_that_are_wholly_free_are_no_filter_of_a_disk() -> None:
    environment = WORLDS["hall"]
    made = build_filter({"hall": environment}, QUARTERS, Fraction(1), Fraction(1, 2), "inside")
    assert judged(made, robots(environment, made, 30))["right"] == 0, "every bump is moved by a cell"
