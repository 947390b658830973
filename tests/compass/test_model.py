import random

import pytest

from ial.compass.model import CompassModel
from ial.compass.planning import localizing_sequence
from ial.compass.state import InformationState
from ial.errors import ConfigError
from ial.maps.polygons.exact.rational import fraction
from ial.membership import Lapses, SetMembershipFilter
from tests.maps.polygons.known_polygons import HOLED, SPIKES
from tests.maps.polygons.random_polygons import random_polygon


@pytest.mark.parametrize("polygon", [SPIKES, HOLED, random_polygon(15, 1)])
def test_the_filter_ends_with_the_point_of_the_certificate(polygon) -> None:  # type: ignore[no-untyped-def]
    sequence = localizing_sequence(polygon)
    robot = SetMembershipFilter(CompassModel(polygon))
    sizes = [robot.states.sizes]
    for direction in sequence.directions:
        assert robot.update(direction, None) is None
        sizes.append(robot.states.sizes)
    assert tuple(sizes) == sequence.sizes
    x, y = robot.states.single or (0, 0)
    assert (fraction(x), fraction(y)) == sequence.end


def test_sets_as_every_model_has_them() -> None:
    model = CompassModel(SPIKES)
    everything = model.universe()
    assert not model.empty(everything)
    assert model.empty(InformationState((), ()))
    half = model.predict(everything, (1, 0))
    assert model.step(everything, (1, 0), None) == half
    assert model.unite(everything, half) == everything
    assert model.unite(half, half) == half
    assert model.anew(None) == everything
    assert repr(model) == "CompassModel(<Polygon: 9 corners, 0 holes>)"
    lapses = Lapses(model, 1)
    assert lapses.predict(lapses.universe(), (1, 0)) == (half,)


def test_floats_are_refused() -> None:
    with pytest.raises(ConfigError, match="give whole numbers or fractions"):
        CompassModel(SPIKES).predict(CompassModel(SPIKES).universe(), (random.Random(1).random(), 1))  # type: ignore[arg-type]
