import random

import pytest

from ial.maps.polygons.exact.shooter import Shooter
from ial.odometer.undecided import undecided
from tests.odometer.worlds import SQUARE, WORLDS


@pytest.mark.parametrize("name", WORLDS)
def test_whatever_the_robot_does_a_segment_remains(name: str) -> None:
    shooter, chooser, kept = Shooter(WORLDS[name]), random.Random(1), 0
    for _ in range(8):
        turns = [(chooser.randrange(-99, 100), chooser.randrange(1, 100)) for _ in range(7)]  # of the plane, as complex numbers
        direction, directions = (chooser.randrange(-99, 100), chooser.randrange(1, 100)), []
        for re, im in turns:
            direction = direction[0] * re - direction[1] * im, direction[0] * im + direction[1] * re
            directions.append(direction)
        ends = undecided(shooter, chooser.randrange(len(shooter)), directions)
        if ends is not None:
            one, other = ends
            assert one.place != other.place
            assert one.edge == other.edge
            kept += 1
    assert kept >= 6


def test_only_a_drive_along_the_wall_leads_all_to_one_place() -> None:
    assert undecided(Shooter(SQUARE), 0, [(1, 0)]) is None
