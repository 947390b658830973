"""Filters to export: rooms of 19 cells with 8 headings, 152 configurations, and two of them at once."""

from fractions import Fraction

import numpy as np
import pytest

from ial.bouncing.cells.headings import Headings
from ial.bouncing.filters.bounce_filter import BounceFilter
from ial.bouncing.filters.building import build_filter
from ial.maps.polygons.environment import Environment
from ial.maps.polygons.outline import outlines
from tests.bouncing.exports.rooms import ROOMS


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
