import random
from fractions import Fraction
from itertools import islice

import pytest

from ial.bouncing.cells.headings import Headings
from ial.bouncing.cells.noisy_map import NoisyMap
from ial.bouncing.cells.noisy_model import NoisyModel
from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.rays.real_robot import RealPose, RealRobot
from ial.membership import SetMembershipFilter
from tests.bouncing.rays.test_real_robot import PILLAR
from tests.bouncing.truth import random_environment

NONE = ExecutionBounds()
SOME = ExecutionBounds(Fraction(5), Fraction(1, 20), 1)


def standing(made: NoisyMap, pose: RealPose) -> list[int]:
    """The vertices of a simulated robot: walls at thirds are rounded to 2^-112 m there, so it may stand that much behind one."""
    some = (-Fraction(1, 10**30), Fraction(0), Fraction(1, 10**30))
    return [each for dx in some for dy in some for each in made.vertices(pose.x_m + dx, pose.y_m + dy, pose.turn)]


def noisy(bounds: ExecutionBounds = NONE, step: Fraction = Fraction(1), cell: Fraction = Fraction(1)) -> NoisyMap:
    return NoisyMap(PILLAR, cell, Headings.of_angle(Fraction(90), 8, step), bounds)


@pytest.mark.parametrize("seed", range(60))
def test_a_robot_with_real_geometry_is_never_lost(seed: int) -> None:
    chooser = random.Random(seed)
    environment = random_environment(seed)
    radius = [Fraction(0), Fraction(1, 4), Fraction(1, 7)][seed % 3 if seed % 3 else chooser.randrange(3)]
    cell, count = chooser.choice([Fraction(1, 2), Fraction(1, 3), Fraction(7, 10)]), chooser.choice([8, 12, 36])
    headings = Headings(count, chooser.randrange(1, count), chooser.choice([Fraction(1), Fraction(3, 2), Fraction(3)]))
    bounds = [ExecutionBounds(), SOME, ExecutionBounds(Fraction(15), count=2), ExecutionBounds(step=Fraction(1, 4))][seed % 4]
    made = NoisyMap(environment, cell, headings, bounds, radius)
    robot = RealRobot(environment, headings.bounce_deg, headings.step * cell, radius, bounds, seed)
    running = SetMembershipFilter(NoisyModel(made.graph), "restart")
    for pose in islice(robot.run(), 60):
        assert running.update(None, pose.observation) is None
        if bounds.count == 0 or pose.observation:  # with a wrong clock, the robot is where the set says at bumps
            assert set(standing(made, pose)) & set(running.states.tolist())


def test_a_broken_bound_is_noticed() -> None:
    made = NoisyMap(PILLAR, Fraction(1, 4), Headings.of_angle(Fraction(90), 36, Fraction(4)))
    lost = 0
    for seed in range(30):
        robot = RealRobot(PILLAR, Fraction(90), Fraction(1), bounds=ExecutionBounds(Fraction(60)), seed=seed)
        model = NoisyModel(made.graph)
        states = model.universe()
        for pose in islice(robot.run(), 80):
            states = model.step(states, None, pose.observation)
        lost += not set(made.vertices(pose.x_m, pose.y_m, pose.turn)) & set(states.tolist())
    assert lost > 0


@pytest.mark.parametrize("larger", [ExecutionBounds(Fraction(50)), ExecutionBounds(step=Fraction(1, 5)), ExecutionBounds(count=1), SOME])
def test_larger_bounds_give_larger_sets(larger: ExecutionBounds) -> None:
    less, more = noisy().graph, noisy(larger).graph
    grown = 0
    for vertex in range(len(less)):
        for label in (0, 1):
            one, other = set(less.successors(vertex, label).tolist()), set(more.successors(vertex, label).tolist())
            assert one <= other
            grown += len(other) > len(one)
    assert grown > 0
