"""Filters to export: rooms of 19 cells with 8 headings, 152 configurations, and two of them at once."""

from fractions import Fraction

import numpy as np
import pytest

from ial.bouncing.cells.headings import Headings
from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.filters.bounce_filter import BounceFilter
from ial.bouncing.filters.building import build_filter
from ial.bouncing.filters.goal import Goal, Room
from ial.bouncing.filters.robust_building import build_robust_filter
from ial.bouncing.filters.robust_filter import RobustFilter
from ial.maps.polygons.environment import Environment
from ial.maps.polygons.outline import outlines
from tests.bouncing.exports.rooms import ROOMS
from tests.bouncing.judged_runs import ARMS


def built(names: tuple[str, ...], angle: int) -> BounceFilter:
    environments = {name: Environment(outlines(ROOMS[name], Fraction(1, 2)), Fraction(1, 2)) for name in names}
    return build_filter(environments, Headings.of_angle(Fraction(angle), 8))


@pytest.fixture(scope="session", params=[(("corner",), 45), (("corner",), 135), (("niches",), 45), (("corner", "niches"), 135)], ids=str)
def small(request: pytest.FixtureRequest) -> BounceFilter:
    """A filter whose environments have 152 configurations each."""
    return built(*request.param)


@pytest.fixture(scope="session")
def corner() -> BounceFilter:
    made = built(("corner",), 45)
    assert made.table.uncertainty[0] == 152
    assert np.count_nonzero(made.table.colours == 1) > 1
    return made


@pytest.fixture(scope="session")
def robust() -> RobustFilter:
    """A filter of a disk with errors, with two rooms."""
    rooms = Goal((Room("a *//", *map(Fraction, (0, 0, 3, 1))), Room("b", *map(Fraction, (3, 0, 10, 3)))))
    headings, bounds = Headings.of_angle(Fraction(90), 24, Fraction(4)), ExecutionBounds(Fraction(1), Fraction(1, 100))
    return build_robust_filter({"arms": ARMS}, headings, Fraction(1, 2), rooms, bounds, Fraction(2, 5), 2000)
