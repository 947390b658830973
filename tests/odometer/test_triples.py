import math
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
import pytest

from ial.membership import SetMembershipFilter
from ial.odometer import Command, OdometerModel, OdometerRobot
from ial.odometer.certificate import isolated
from ial.odometer.hypotheses import hypotheses
from ial.odometer.model import Chord
from tests.maps.polygons.random_polygons import random_polygon
from tests.odometer.scan import Scan
from tests.odometer.worlds import CARDAN, HALL, L_SHAPE, SQUARE, robot


@dataclass(frozen=True)
class Begun:
    """What a robot knows after its first measured drive, that, and the second one with the turns between."""

    chord: Chord
    first: float
    second: float
    last: Command
    turn: float


def started(model: OdometerModel, driven: OdometerRobot) -> Begun | None:
    """Drive back and across, to the right if not to the left; None if a corner forbids it."""
    driven.execute(Command(Fraction(0)))
    known = SetMembershipFilter(model, "absorb")
    back = Command(Fraction(180))
    first = driven.execute(back)
    known.update(back, first)
    for last, turn in ((Command(Fraction(90)), 90), (Command(Fraction(-180)), -90)):
        second = driven.execute(last)
        if second > 0.0:
            return Begun(known.states, first, second, last, math.radians(turn)) if isinstance(known.states, Chord) else None
        known.update(last, second)
    return None


@pytest.mark.slow
def test_candidates_are_those_of_a_scan_over_the_boundary() -> None:
    compared = 0
    for seed in range(1, 61):
        polygon = random_polygon(corners=6 + seed % 4, seed=seed) if seed % 3 else L_SHAPE
        model, scan = OdometerModel(polygon), Scan(polygon)
        driven = robot(polygon, 100 + seed)
        if (driven.x, driven.y) in {(float(x), float(y)) for x, y in polygon.outer}:
            continue  # it would come back past its corner, and the scan knows no touching
        driven = OdometerRobot(polygon, driven.x, driven.y, 33.7 + 23 * seed)
        begun = started(model, driven)
        if begun is None:
            continue
        first, second, turn = begun.first, begun.second, begun.turn
        states = model.step(begun.chord, begun.last, second)
        places = [(each.x, each.y, each.heading_rad) for each in hypotheses("", states)]  # type: ignore[arg-type]
        found = scan.candidates(first, second, turn, 400)
        near = 2e-2 * model.walls.size
        for x, y, heading in found:  # nothing that the scan finds is missing
            assert any(math.hypot(x - a, y - b) < near and math.cos(heading - c) > 0.99 for a, b, c in places), (
                *(seed, x, y, heading, places),
            )
        for x, y, heading in places:  # and every candidate explains the readings
            bx, by = x - second * math.cos(heading), y - second * math.sin(heading)
            ax, ay = bx - first * math.cos(heading - turn), by - first * math.sin(heading - turn)
            reach = scan.way(ax + 1e-7 * (bx - ax), ay + 1e-7 * (by - ay), heading - turn)[0], scan.way(bx, by, heading)[0]
            assert abs(reach[0] - first) < 1e-4 * model.walls.size
            assert abs(reach[1] - second) < 1e-4 * model.walls.size
        compared += len(found)
    assert compared > 100


def test_cardans_curve_is_kept_as_a_chain_of_boxes_with_many_headings() -> None:
    model = OdometerModel(CARDAN)
    driven = OdometerRobot(CARDAN, -2.0, -0.5, math.degrees(math.atan2(1, -2)))
    begun = started(model, driven)
    assert begun is not None
    assert begun.second == pytest.approx(begun.first)
    states = model.step(begun.chord, begun.last, begun.second)
    assert states.holds(driven.x, driven.y, driven.heading_rad)
    held = 0
    for part in np.linspace(0.9, 1.15, 40).tolist():  # p_b = (−t, −t), p_a = (−a, 0) with |w| = √5, and p_c = (0, c) at right angles
        a = part + math.sqrt(5.0 - part**2)
        heading = math.atan2(a - part, part)  # of (t, a − t), which is at right angles to w = (a − t, −t)
        held += states.holds(0.0, a - 2.0 * part, heading)
    assert held == 40


def test_sliding_along_parallel_walls_keeps_the_heading() -> None:
    model = OdometerModel(SQUARE)
    begun = started(model, OdometerRobot(SQUARE, 1, 1, 90))
    assert begun is not None
    states = model.step(begun.chord, begun.last, begun.second)
    for heading in (0.0, 0.5 * math.pi, math.pi, -0.5 * math.pi):
        x, y = 1.5 + 1.5 * math.cos(heading), 1.5 + 1.5 * math.sin(heading)
        assert states.holds(x, y, heading) or states.holds(*_corner(heading), heading)


def _corner(heading: float) -> tuple[float, float]:
    """Where a robot ends that slides along a wall of the square to the corner in front of it."""
    x, y = math.cos(heading), math.sin(heading)
    return round(1.5 + 1.5 * (x + y)), round(1.5 + 1.5 * (y - x))


def test_isolated_candidates_are_proved_to_be_single() -> None:
    model = OdometerModel(HALL)
    begun = started(model, OdometerRobot(HALL, 1, 1, 37))
    assert begun is not None
    way, turn = model.bounds.distance(begun.second), model.bounds.turn(begun.last.turn_deg)
    rows, origins = model.crossings(begun.chord, turn, way)
    assert len(rows) == len(origins) > 0
    proved = isolated(model.walls, origins, begun.chord.length, way, turn)
    assert proved.all()
