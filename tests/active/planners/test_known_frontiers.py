import math
from itertools import pairwise

from ial.active.belief import Belief
from ial.active.explored_area import ExploredArea
from ial.active.planners.known_frontiers import KnownFrontiers
from ial.active.planners.route import Route
from ial.active.robot import Drive
from ial.maps.grids.alike_plans import alike_plan
from ial.maps.grids.occupancy_grid import OccupancyGrid
from ial.pose import Pose
from tests.active.scenes import belief, robot, room


def test_a_frontier_that_is_seen_again_keeps_its_age() -> None:
    grid, route = alike_plan("rooms"), Route()
    known, driving = belief(grid), robot(grid, Pose(6.2, 1.0, 0.0))  # in the corridor, before a door
    area = ExploredArea(grid)
    frontiers = KnownFrontiers(area, 4, route)
    looks = []
    for number in range(3):
        driven = driving.drive(Drive(0.0, 0.7)) if number else None
        known.update(driven.motion if driven else None, driven.reading if driven else driving.look())
        assert known.view is not None
        area.add(known.view)
        looks.append(frontiers.look(known, route.space(known, known.groups()), number, 10 + number))
        assert looks[-1] == frontiers.left
    assert {(each.born, each.since) for each in looks[0]} == {(0, 10)}
    for earlier, later in pairwise(looks):
        for each in later:
            same = [old.since for old in earlier if math.dist(old.place, each.place) < route.near_m]
            assert each.since == min(same, default=each.since)
    assert {each.since for each in looks[-1]} & {10, 11}, "some are still there"
    assert {each.since for each in looks[-1]} & {11, 12}, "others are new"
    place = looks[-1][0].place
    assert frontiers.holds(place)
    assert not frontiers.holds((place[0] + 50.0, place[1]))


def test_in_a_room_that_is_seen_as_a_whole_there_is_none() -> None:
    grid, start = room(), Pose(1.0, 2.8, 0.0)
    known = seen(grid, start)
    assert known.view is not None
    frontiers = KnownFrontiers(ExploredArea(grid, [known.view]), 40, Route())
    some = frontiers.look(known, Route().space(known, known.groups()), 0, 1)
    more = KnownFrontiers(ExploredArea(grid, [known.view]), 1, Route()).look(known, Route().space(known, known.groups()), 0, 1)
    assert len(some) < len(more), "small ones are of no interest"


def seen(grid: OccupancyGrid, start: Pose) -> Belief:
    known = belief(grid)
    known.update(None, robot(grid, start).look())
    return known
