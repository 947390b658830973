"""Legs of an exploration that was never driven, for the tests of its files: one look, and decisions as a test wants them."""

from functools import cache

from ial.active.belief import Belief
from ial.active.decision import Decision
from ial.active.exploration import ExplorationStep
from ial.active.robot import Drive
from ial.datasets.odometry import Odometry
from ial.datasets.recording import Step
from ial.pose import Pose
from ial.results.active.leg import Leg
from tests.active.scenes import belief, robot, room

START = Pose(1.5, 1.0, 0.4)


@cache
def looked() -> tuple[Belief, Step]:
    known, driving = belief(room()), robot(room(), START)
    scan = driving.look()
    known.update(None, scan)
    return known, Step(0, scan.stamp_ns, None, scan, Odometry.of(known.moved))


def leg(number: int, decision: Decision | None = None, collided: bool = False) -> Leg:
    known, step = looked()
    assert known.estimate is not None
    taken = ExplorationStep(decision, known.estimate, known.moved, collided, 0.25)
    return Leg(number, None if decision is None else 3, step, taken, known.groups(), START)


def driven(stage: str, **more: object) -> Decision:
    return Decision(Drive(0.5, 0.4), stage, "because", **more)  # type: ignore[arg-type]
