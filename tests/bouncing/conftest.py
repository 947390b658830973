"""A filter of two environments."""

from fractions import Fraction

import pytest

from ial.bouncing.cells.headings import Headings
from ial.bouncing.filters.bounce_filter import BounceFilter
from ial.bouncing.filters.building import build_filter
from ial.maps.polygons.environment import Environment
from ial.maps.polygons.outline import outlines
from tests.bouncing.worlds import HALL, STORE


@pytest.fixture(scope="session")
def made() -> BounceFilter:
    environments = {name: Environment(outlines(free, Fraction(1, 2)), Fraction(1, 2)) for name, free in (("hall", HALL), ("store", STORE))}
    return build_filter(environments, Headings.of_angle(Fraction(90), 24))
