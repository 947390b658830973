import math
from fractions import Fraction

import pytest

from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.rays.real_robot import RealRobot
from ial.errors import ConfigError, MapError
from ial.maps.polygons.environment import Environment
from ial.maps.polygons.polygon import Polygon


def ring(*corners: tuple[float, float]) -> tuple[tuple[Fraction, Fraction], ...]:
    return tuple((Fraction(x), Fraction(y)) for x, y in corners)


ROOM = Environment((Polygon(ring((0, 0), (4, 0), (4, 3), (0, 3))),))
PILLAR = Environment((Polygon(ring((0, 0), (8, 0), (8, 6), (0, 6)), (ring((3, 2), (5, 2), (5, 4), (3, 4)),)),))


def robot(environment: Environment, x: float, y: float, degrees: int, radius: Fraction = Fraction(0), **more: object) -> RealRobot:
    start = (Fraction(x), Fraction(y), Fraction(degrees, 360))
    return RealRobot(environment, Fraction(90), Fraction(1), radius, start=start, **more)  # type: ignore[arg-type]


def test_a_robot_counts_its_steps_to_the_wall_and_turns() -> None:
    made = robot(ROOM, 0.5, 1, 0)
    poses = list(made.leg())
    assert [pose.observation for pose in poses] == [0, 0, 0, 1]
    assert [(pose.x_m, pose.y_m) for pose in poses] == [(1.5, 1), (2.5, 1), (3.5, 1), (4, 1)]
    assert [pose.turn for pose in poses] == [0, 0, 0, Fraction(1, 4)]
    assert [(pose.observation, pose.x_m, pose.y_m) for pose in made.leg()] == [(0, 4, 2), (0, 4, 3), (1, 4, 3)], (
        "along the wall, to the corner"
    )


def test_a_robot_that_faces_the_wall_after_its_turn_bumps_at_once() -> None:
    made = RealRobot(ROOM, Fraction(45), Fraction(1), start=(Fraction(1), Fraction(1), Fraction(1, 2)))
    assert [pose.observation for pose in made.leg()] == [0, 1]
    assert [pose.observation for pose in made.leg()] == [1], "at 225° it still faces the left wall"


def test_a_disk_stops_at_its_radius_from_walls_and_corners() -> None:
    half = Fraction(1, 2)
    (*_, last) = robot(PILLAR, 1, 3, 0, half).leg()
    assert (last.x_m, last.y_m) == (Fraction(5, 2), 3)
    (*_, last) = robot(PILLAR, 1, 1.75, 0, half).leg()  # its centre passes below the corner (3, 2), and its edge does not
    assert math.hypot(last.x_m - 3, last.y_m - 2) == pytest.approx(0.5, abs=1e-15)
    assert float(last.x_m) == pytest.approx(3 - math.sqrt(0.25 - 0.0625))
    (*_, last) = robot(PILLAR, 1, 1.25, 0, half).leg()
    assert last.x_m == Fraction(15, 2)


def test_rays_meet_what_slow_sampling_meets() -> None:
    made = RealRobot(PILLAR, Fraction(100), Fraction(1, 4), Fraction(1, 3), seed=5)
    for _ in range(12):
        x, y, turn = (float(value) for value in made.pose)
        (*_, last) = made.leg()
        far = math.hypot(float(last.x_m) - x, float(last.y_m) - y)

        def clear(way: float, x: float = x, y: float = y, turn: float = turn) -> bool:
            px, py = x + way * math.cos(2 * math.pi * turn), y + way * math.sin(2 * math.pi * turn)
            gap = math.hypot(max(3 - px, 0, px - 5), max(2 - py, 0, py - 4))
            return min(px, 8 - px, py, 6 - py, gap) >= 1 / 3 - 1e-9

        assert all(clear(far * part / 200) for part in range(201))
        assert not clear(far + 1e-6)


def test_errors_stay_within_their_bounds_and_reach_them() -> None:
    bounds = ExecutionBounds(Fraction(2), Fraction(1, 20), 1)
    made = RealRobot(ROOM, Fraction(100), Fraction(1, 8), bounds=bounds, seed=1)
    wrong, counted = [], set()
    for _ in range(200):
        x, y, turn = made.pose
        poses = list(made.leg())
        wrong.append(((poses[-1].turn - turn - Fraction(100, 360) + Fraction(1, 2)) % 1 - Fraction(1, 2)) * 360)
        way = math.hypot(poses[-1].x_m - x, poses[-1].y_m - y)
        assert (len(poses) - 2) * 0.125 * 0.95 <= way + 1e-12
        assert way <= (len(poses) + 1) * 0.125 * 1.05 + 1e-12
        counted.add(len(poses) - 1 - math.floor(way / 0.125))
    assert max(wrong) == 2
    assert min(wrong) == -2
    assert {-1, 0, 1} <= counted


def test_the_same_seed_gives_the_same_run() -> None:
    first, again, other = (list(RealRobot(PILLAR, Fraction(70), Fraction(1), seed=seed).leg()) for seed in (3, 3, 4))
    assert first == again
    assert first != other


@pytest.mark.parametrize(
    ("make", "error", "message"),
    [
        (lambda: robot(PILLAR, 4, 3, 0), ConfigError, "cannot start at"),
        (lambda: robot(PILLAR, 0.25, 3, 0, Fraction(1, 2)), ConfigError, "cannot start at"),
        (lambda: RealRobot(ROOM, Fraction(90), Fraction(0)), ConfigError, "step is 0 m"),
        (lambda: RealRobot(ROOM, Fraction(90), Fraction(1), Fraction(-1)), ConfigError, "radius of the robot is -1 m"),
        (lambda: RealRobot(ROOM, Fraction(90), Fraction(1), Fraction(2)), MapError, "no free place was found"),
        (lambda: ExecutionBounds(turn_deg=Fraction(180)), ConfigError, "error of a turn is 180°"),
        (lambda: ExecutionBounds(step=Fraction(1)), ConfigError, "error of a step is 1 of"),
        (lambda: ExecutionBounds(count=-1), ConfigError, "error of a count is -1"),
    ],
)
def test_what_cannot_be_meant_is_refused(make: object, error: type[Exception], message: str) -> None:
    with pytest.raises(error, match=message):
        make()  # type: ignore[operator]
