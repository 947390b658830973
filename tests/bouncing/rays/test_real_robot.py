import itertools
import math
import random
from fractions import Fraction

import numpy as np
import pytest

from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.rays.real_robot import RealRobot
from ial.errors import ConfigError, MapError
from ial.maps.polygons.environment import Environment
from ial.maps.polygons.outline import outlines
from ial.maps.polygons.polygon import Polygon
from tests.bouncing import exact_disk


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


HALL = Environment((Polygon(ring((0, 0), (9, 0), (9, 4), (5, 4), (5, 7), (0, 7)), (ring((2, 2), (2, 4), (3, 4), (3, 2)),)),))


def test_a_disk_drives_past_what_it_only_grazes() -> None:
    half = Fraction(1, 2)
    (*_, last) = robot(HALL, 8, 3.5, 180, half).leg()
    assert (last.x_m, last.y_m) == (Fraction(7, 2), Fraction(7, 2)), "past the corner (5, 4) to the pillar"
    (*_, last) = robot(PILLAR, 1, 1.5, 0, half).leg()
    assert last.x_m == Fraction(15, 2), "below the pillar, all along it"
    (*_, last) = robot(PILLAR, 1, 1.5 + 2**-40, 0, half).leg()
    assert abs(last.x_m - (3 - math.sqrt(2**-40 * (1 - 2**-40)))) < 1e-12, "a hair higher"


@pytest.mark.parametrize("x", [1, 5, Fraction(17, 3)])
def test_a_corner_in_the_middle_of_a_straight_wall_is_none(x: Fraction) -> None:
    room = Environment((Polygon(ring((0, 0), (x, 0), (9, 0), (9, 4), (x, 4), (0, 4), (0, Fraction(1, 3)))),))
    half = Fraction(1, 2)
    assert [pose.x_m for pose in robot(room, 8, 0.5, 180, half).leg()][-1] == half
    assert [pose.y_m for pose in robot(room, 8, 0.5, 180, half).leg()][-1] == half
    for radius in (Fraction(0), half):
        (*_, last) = robot(room, x, 2, 270, radius).leg()
        assert (last.x_m, last.y_m) == (pytest.approx(float(x)), radius), "straight into it"


def test_a_disk_slides_along_a_slanted_wall_past_its_corners() -> None:
    """The wall leads up at 45°, with a corner in its middle; the disk touches it from below."""
    room = Environment((Polygon(ring((0, 0), (20, 0), (20, 20), (12, 20), (10, 18), (7, 15), (2, 10), (0, 10))),))
    radius = Fraction(1)
    aside = Fraction(math.isqrt(2 * 4**200), 2**200)  # right and below by the radius times the square root of 2, together
    start = (Fraction(3) + aside, Fraction(11), Fraction(1, 8))
    (*_, last) = RealRobot(room, Fraction(90), Fraction(1), radius, start=start).leg()
    assert last.y_m == pytest.approx(19.0), "to the upper wall"
    assert float(last.x_m) == pytest.approx(11.0 + math.sqrt(2.0))


def test_a_point_drives_on_from_a_corner_if_free_space_lies_ahead() -> None:
    (*_, last) = robot(HALL, 6, 3, 135).leg()
    assert (float(last.x_m), float(last.y_m)) == pytest.approx((2.0, 7.0)), "past the reflex corner (5, 4)"
    (*_, last) = robot(HALL, 4, 3, 45).leg()
    assert (float(last.x_m), float(last.y_m)) == pytest.approx((5.0, 4.0)), "into the reflex corner"
    (*_, last) = robot(HALL, 8, 3, 45).leg()
    assert (float(last.x_m), float(last.y_m)) == pytest.approx((9.0, 4.0)), "into a convex corner"
    (*_, last) = robot(HALL, 8, 4, 180).leg()
    assert (last.x_m, last.y_m) == (0, 4), "along the upper wall, and on along the pillar"


@pytest.mark.slow
def test_disks_stop_where_exact_fractions_say() -> None:
    grazed = stopped_by_corners = 0
    for seed in range(30):
        chooser = random.Random(seed)
        free = np.random.default_rng(seed).random((5, 6)) > 0.25
        free[0, 0] = True
        cell = chooser.choice([Fraction(1), Fraction(2, 3), Fraction(7, 5)])
        environment = Environment(outlines(free, cell))
        for parts, radius in itertools.product((2, 3), (Fraction(1, 2), Fraction(1, 3), Fraction(3, 10))):
            for _ in range(8):
                place = tuple(cell * Fraction(chooser.randrange(1, 6 * parts * 2), parts * 2) for _ in range(2))
                if chooser.random() < 0.5:  # beside a line of the lattice by exactly the radius
                    place = (round(place[0] / cell) * cell + chooser.choice([-1, 1]) * radius * cell, place[1])
                if not exact_disk.is_free(environment, place, radius * cell):
                    continue
                for quarters in range(4):
                    start = (*place, Fraction(quarters, 4))
                    (*_, last) = RealRobot(environment, Fraction(90), Fraction(9), radius * cell, start=start).leg()
                    ahead = exact_disk.turned((last.x_m, last.y_m), quarters)[0] - exact_disk.turned(place, quarters)[0]
                    expected = exact_disk.way(environment, place, quarters, radius * cell)
                    assert abs(ahead - expected) < Fraction(1, 2**90), (seed, start, radius, float(expected))
                    less = exact_disk.way(environment, place, quarters, radius * cell + Fraction(1, 10**30))
                    grazed += expected - less > Fraction(1, 10)
                    stopped_by_corners += expected.denominator > 2**200
    assert grazed > 100
    assert stopped_by_corners > 100


def stop_on_lattice(free: np.ndarray, x: int, y: int, quarters: int) -> tuple[int, int] | None:
    """Where a point stops that drives along a line of a lattice: where both cells ahead are not free. None if it comes between corners."""
    dx, dy = [(1, 0), (0, 1), (-1, 0), (0, -1)][quarters]
    while True:
        around = free[y - 1 : y + 1, x - 1 : x + 1]
        if not around.any() or (around[0, 0] == around[1, 1] != around[0, 1] == around[1, 0]):
            return None
        if not (around[:, (1 + dx) // 2] if dx else around[(1 + dy) // 2]).any():
            return x, y
        x, y = x + dx, y + dy


@pytest.mark.slow
def test_points_on_lines_of_a_lattice_stop_where_both_cells_ahead_are_not_free() -> None:
    tried = 0
    for seed in range(40):
        free = np.pad(np.random.default_rng(seed).random((5, 6)) > 0.35, 1)
        environment = Environment(outlines(free, Fraction(1)))
        for y, x, quarters in itertools.product(range(1, 7), range(1, 8), range(4)):
            stop = stop_on_lattice(free, x, y, quarters)
            if stop is not None:
                (*_, last) = robot(environment, x, y, 90 * quarters).leg()
                assert (last.x_m, last.y_m) == stop, (seed, x, y, quarters)
                tried += 1
    assert tried > 3000


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
