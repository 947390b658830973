import math
from fractions import Fraction

import pytest

from ial.errors import StreamError
from ial.membership import SetMembershipFilter
from ial.odometer import Command, Configurations, OdometerBounds, OdometerModel, OdometerRobot
from tests.odometer.worlds import L_SHAPE, SQUARE, WORLDS, robot

HALF = Command(Fraction(180))


@pytest.mark.slow
@pytest.mark.parametrize("part", [0.0, 0.02])
def test_the_truth_survives_random_commands_and_predictions(part: float) -> None:
    bounds = OdometerBounds(part, 30.0 * part)
    for seed, (name, polygon) in enumerate(WORLDS.items()):
        model = OdometerModel(polygon, bounds, 3000)
        driven = robot(polygon, 7 * seed, bounds)
        driven.execute(Command(Fraction(0)))
        known = SetMembershipFilter(model, "absorb")
        size = model.walls.size
        for step in range(7):
            turn = Fraction((180, 90, 37, 211, 90, 45, 300)[step])
            command = Command(turn, size / 8 if step % 3 == 2 else math.inf)
            reading = driven.execute(command)
            predicted = model.predict(known.states, command) if step in (3, 5) else None
            assert known.update(command, reading) is None, (name, step)
            assert known.states.holds(driven.x, driven.y, driven.heading_rad), (name, step)
            assert predicted is None or predicted.holds(driven.x, driven.y, driven.heading_rad), (name, step)


def test_a_robot_near_a_reflex_corner_may_pass_it_or_not() -> None:
    model = OdometerModel(L_SHAPE, OdometerBounds(1e-3, 0.1))
    driven = OdometerRobot(L_SHAPE, 0, 4, -45)
    start = model.universe()
    rows = [row for row in start.rows if row[8] == 5][:1]  # type: ignore[union-attr]
    assert len(rows) == 1
    rows[0][0:2], rows[0][6:8] = (0.0, 0.0), (-0.25 * math.pi, -0.25 * math.pi)
    after = model.predict(Configurations(model.walls, rows[0][None, :]), Command(Fraction(0)))
    assert {row[8] for row in after.rows} == {0.0, 3.0}  # type: ignore[union-attr]
    driven.execute(Command(Fraction(0)))
    assert after.holds(driven.x, driven.y, driven.heading_rad)


def test_a_robot_that_can_neither_go_on_nor_back_stands_in_a_corner() -> None:
    model = OdometerModel(SQUARE)
    states = model.step(model.universe(), HALF, 0.0)
    assert isinstance(states, Configurations)
    corners = {(0.0, 0.0), (3.0, 0.0), (3.0, 3.0), (0.0, 3.0)}
    assert {(round(x, 9), round(y, 9)) for x, y, _ in states.middles().tolist()} == corners
    assert states.holds(0.0, 0.0, math.radians(135))
    assert states.holds(0.0, 0.0, math.radians(-45))
    assert not states.holds(0.0, 0.0, math.radians(45))


def test_a_reading_that_no_place_explains_leaves_nothing() -> None:
    model = OdometerModel(SQUARE)
    assert model.empty(model.step(model.universe(), HALF, 5.0))
    chord = model.step(model.universe(), HALF, 3.0)
    assert not model.empty(chord)
    assert model.empty(model.step(chord, Command(Fraction(90)), 4.0))


def test_unions_hold_both() -> None:
    model = OdometerModel(SQUARE)
    one = model.step(model.step(model.universe(), HALF, 3.0), Command(Fraction(90)), 1.25)
    other = model.step(model.step(model.universe(), HALF, 3.5), Command(Fraction(90)), 0.5)
    both = model.unite(one, other)
    for x, y, heading in [*one.middles().tolist(), *other.middles().tolist()]:  # type: ignore[union-attr]
        assert both.holds(x, y, heading)


@pytest.mark.parametrize("reading", [-1.0, math.nan, math.inf])
def test_a_reading_that_is_no_distance_is_refused(reading: float) -> None:
    model = OdometerModel(SQUARE)
    with pytest.raises(StreamError, match="cannot have driven"):
        model.step(model.universe(), HALF, reading)
