import dataclasses
import math

import pytest

from ial.active.planners.look_around import LookAround
from ial.active.planners.outlook import MOST_GROUPS, Outlook
from ial.active.planners.route import Route
from ial.active.virtual_sensors import VirtualSensors
from ial.maps.grids.alike_plans import alike_plan
from ial.pose import Pose
from tests.active.scenes import LIDAR, belief, robot

GRID = alike_plan("rooms")


@pytest.mark.parametrize(("degrees", "turns"), [(90.0, 3), (180.0, 1), (360.0, 0)])
def test_it_turns_until_all_directions_were_seen(degrees: float, turns: int) -> None:
    known, driving = belief(GRID), robot(GRID, Pose(10.4, 1.1, 0.0))
    driving.lidar = dataclasses.replace(LIDAR, angle_min=-math.radians(degrees) / 2.0, angle_increment=math.radians(degrees) / LIDAR.beams)
    known.update(None, driving.look())
    around = LookAround(Outlook(VirtualSensors(GRID), 0.2))
    around.begin(known)
    assert around.has_seen_all(known) == (not turns)
    taken = 0
    while around.begun:
        groups = known.groups(most=MOST_GROUPS)
        decision = around.further(known, groups, Route().space(known, groups))
        if decision is None:
            break
        assert decision.drive is not None
        assert decision.drive.distance_m == 0.0
        driven = driving.drive(decision.drive)
        known.update(driven.motion, driven.reading)
        taken += 1
    assert taken == turns
    assert around.has_seen_all(known)
