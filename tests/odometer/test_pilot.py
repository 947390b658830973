import math
from collections import Counter

import pytest

from ial.active.exploration import explore
from ial.odometer import CommandedRobot, OdometerBelief, OdometerBounds, OdometerModel, Pilot, Session
from ial.odometer.estimate import OdometerEstimate
from ial.odometer.splitting import Rule, by_direction, by_expectation
from tests.maps.polygons.random_polygons import random_polygon, rectilinear_polygon
from tests.odometer.followed_robot import FollowedRobot
from tests.odometer.worlds import L_SHAPE, S_SHAPE, SERPENTINE, SQUARE, regular, robot

RULES = {"expectation": by_expectation, "direction": by_direction}
ENVIRONMENTS = [
    *(random_polygon(corners=6 + seed % 9, seed=seed) for seed in range(30)),
    *(rectilinear_polygon(4 + seed % 4, seed=seed) for seed in range(14)),
    *(L_SHAPE, S_SHAPE, SQUARE, SERPENTINE, regular(5), regular(3)),
]


def explored(model: OdometerModel, seed: int, rule: Rule, most: int = 60) -> tuple[OdometerEstimate, list[str]]:
    """Explore, look for the truth after each drive, and return the last answer and the reasons of all commands."""
    known = OdometerBelief({"here": model})
    driven = FollowedRobot(robot(model.walls.polygon, seed, model.bounds))
    reasons = []
    for step in explore(known, CommandedRobot(driven), Pilot(known, rule), most):
        assert driven.is_in(known.states["here"]), (driven.driven, step.decision)
        assert step.estimate is known.estimate
        reasons += [step.decision.reason] if step.decision else []
    assert len(reasons) < most, "it ends"
    return step.estimate, reasons


@pytest.mark.slow
def test_either_rule_keeps_the_truth_and_ends_as_localize_does() -> None:
    ends: Counter[str] = Counter()
    directions = 0
    for seed, polygon in enumerate(ENVIRONMENTS):
        model = OdometerModel(polygon)
        expected = Session({"here": model}, robot(polygon, seed)).run()  # what localize runs
        assert expected.status in ("localized", "symmetric")
        for name, rule in RULES.items():
            last, reasons = explored(model, seed, rule)
            assert last.hypotheses is not None
            assert (last.status, len(last.hypotheses)) == (expected.status, len(model.symmetries)), (seed, name)
            directions += name == "direction" and "by a direction" in reasons
        ends[expected.status] += 1
    assert ends["symmetric"] >= 4
    assert ends["localized"] >= 40
    assert directions > 25


@pytest.mark.slow
@pytest.mark.parametrize("rule", RULES)
def test_the_truth_is_kept_with_errors_as_large_as_allowed(rule: str) -> None:
    bounds = OdometerBounds(0.01, 0.5)
    for seed in range(3):
        polygon = random_polygon(corners=8, seed=seed) if seed else L_SHAPE
        last, _ = explored(OdometerModel(polygon, bounds), seed, RULES[rule], 40)
        assert last.status in ("localized", "ambiguous")


def test_where_no_place_explains_the_readings_it_stops() -> None:
    known = OdometerBelief({"here": OdometerModel(SQUARE)})
    steps = list(explore(known, CommandedRobot(robot(SERPENTINE, 3)), Pilot(known)))
    assert steps[-1].estimate.status == "rejected"
    assert steps[-1].estimate.hypotheses == ()
    assert steps[-1].decision is not None
    assert (steps[-1].decision.drive, steps[-1].decision.reason) == (None, "no place explains the readings")


def test_a_robot_that_never_moves_runs_out_of_commands() -> None:
    class Stuck:
        def execute(self, command: object) -> float:
            return 0.0

    known = OdometerBelief({"here": OdometerModel(SQUARE)})
    drives = sum(1 for _ in explore(known, CommandedRobot(Stuck()), Pilot(known), 300))
    assert drives < 300
    assert known.status in ("rejected", "ambiguous")
    assert math.isfinite(drives)
