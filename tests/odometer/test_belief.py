import math
from fractions import Fraction

import pytest

from ial.errors import ConfigError, StreamError
from ial.odometer import Command, OdometerBelief, OdometerModel, OdometerRobot
from ial.pose import Pose
from tests.odometer.worlds import L_SHAPE, S_SHAPE, SQUARE

BACK, LEFT = Command(Fraction(180)), Command(Fraction(90))


def test_two_measured_drives_leave_hypotheses() -> None:
    known, driven = OdometerBelief({"L": OdometerModel(L_SHAPE), "S": OdometerModel(S_SHAPE)}), OdometerRobot(L_SHAPE, 1, 1, 25)
    assert (known.status, known.estimate, known.measured) == ("ambiguous", None, 0)
    first = known.update(None, driven.execute(Command(Fraction(0))))
    assert (first.hypotheses, first.command, known.measured) == (None, None, 0)
    second = known.update(BACK, driven.execute(BACK))
    assert (second.status, second.hypotheses, known.measured) == ("ambiguous", None, 1)
    third = known.update(LEFT, driven.execute(LEFT))
    assert third.hypotheses is not None
    assert third.hypotheses == known.estimate.hypotheses  # type: ignore[union-attr]
    assert {each.world for each in third.hypotheses} <= {"L", "S"}
    near = [math.hypot(each.x - driven.x, each.y - driven.y) for each in third.hypotheses if each.world == "L"]
    assert min(near) < 1e-4
    assert known.width(third.hypotheses) < 1e-3


def test_it_knows_how_it_moved_from_where_the_first_drive_ended() -> None:
    known = OdometerBelief({"": OdometerModel(SQUARE)})
    known.update(None, 2.0)
    assert known.moved == Pose(0.0, 0.0, 0.0)
    known.update(BACK, 3.0)
    known.update(LEFT, 1.0)
    assert (known.moved.x, known.moved.y) == pytest.approx((-3.0, -1.0))
    assert math.cos(known.moved.theta + 0.5 * math.pi) == pytest.approx(1.0)


def test_a_collision_is_what_it_is_localized_by() -> None:
    one, other = (OdometerBelief({"": OdometerModel(SQUARE)}) for _ in range(2))
    for command, reading in ((None, 2.0), (BACK, 3.0), (LEFT, 1.25)):
        found, same = one.update(command, reading), other.update(command, reading, collided=True)
    assert [repr(each) for each in found.hypotheses or ()] == [repr(each) for each in same.hypotheses or ()] != []


def test_hypotheses_that_a_rotation_makes_one_are_the_same() -> None:
    known = OdometerBelief({"S": OdometerModel(S_SHAPE)})
    known.update(None, 1.0)
    driven = OdometerRobot(S_SHAPE, 1, 1, 25)
    driven.execute(Command(Fraction(0)))
    known.update(BACK, driven.execute(BACK))
    found = known.update(LEFT, driven.execute(LEFT)).hypotheses
    assert found is not None
    twins = [[known.same([one, other]) for other in found] for one in found]
    assert all(sum(row) == 2 for row in twins), "itself, and its image by half a turn"


@pytest.mark.parametrize("reading", [-1.0, math.nan, math.inf])
def test_a_reading_that_is_no_distance_is_refused_at_once(reading: float) -> None:
    with pytest.raises(StreamError, match="cannot have driven"):
        OdometerBelief({"": OdometerModel(SQUARE)}).update(None, reading)


def test_no_environment_is_refused() -> None:
    with pytest.raises(ConfigError, match="no environment to be in"):
        OdometerBelief({})
