from fractions import Fraction

import mpmath
import numpy as np
import pytest

from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.rays.ray_grid import coarsened
from ial.bouncing.rays.ray_model import RayModel
from ial.bouncing.rays.ray_set import RaySet
from ial.bouncing.rays.real_robot import RealRobot
from ial.errors import ConfigError, MapError
from ial.maps.polygons.environment import Environment
from ial.maps.polygons.polygon import Polygon
from ial.maps.polygons.walls import Walls
from ial.membership import Rejection, SetMembershipFilter
from tests.bouncing import disk_truth
from tests.bouncing.exact_rays import DIGITS, ExactWalls, exact
from tests.bouncing.rays.test_real_robot import PILLAR, ROOM, ring
from tests.bouncing.truth import extent, follow, holds_leg, holds_place, random_environment

L_ROOM = Environment((Polygon(ring((0, 0), (9, 0), (9, 4), (5, 4), (5, 7), (0, 7))),))


@pytest.mark.slow
@pytest.mark.parametrize("first", range(100_000, 100_240, 24))
def test_a_robot_with_real_geometry_is_never_lost(first: int) -> None:
    assert sum(follow(seed, 3).losses for seed in range(first, first + 24)) == 0


@pytest.mark.slow
@pytest.mark.parametrize("first", range(200_000, 200_144, 24))
def test_a_disk_is_never_lost(first: int) -> None:
    assert sum(disk_truth.follow(seed, 3).losses for seed in range(first, first + 24)) == 0


def localized(angle: Fraction, bounds: ExecutionBounds, told: ExecutionBounds, seed: int, legs: int = 14) -> tuple[int, int]:
    """At how many bumps a robot was in its set, and how many bumps the set rejected, if it is told these bounds."""
    model = RayModel(L_ROOM, angle, Fraction(1, 8), told, 6000)
    running = SetMembershipFilter(model, "restart")
    robot = RealRobot(L_ROOM, Fraction(100), Fraction(1, 8), bounds=bounds, seed=seed)
    held = rejected = 0
    for _ in range(legs):
        for pose in robot.leg():
            rejected += running.update(None, pose.observation) is not None
        held += holds_leg(L_ROOM, running.states, pose.x_m, pose.y_m, pose.turn)
    return held, rejected


@pytest.mark.slow
def test_a_robot_that_breaks_its_bounds_is_rejected_and_one_that_keeps_them_is_not() -> None:
    none, some = ExecutionBounds(), ExecutionBounds(Fraction(2), Fraction(1, 50), 1)
    assert localized(Fraction(100), none, none, 1) == (14, 0)
    assert localized(Fraction(100), some, some, 2) == (14, 0)
    held, rejected = localized(Fraction(100), some, none, 2)
    assert held < 14
    assert rejected > 0
    assert localized(Fraction(101), none, none, 1)[0] < 14, "another bouncing angle"


def test_bumps_localize() -> None:
    model = RayModel(L_ROOM, Fraction(100), Fraction(1, 8), most_pieces=6000)
    states = model.universe()
    everything = extent(model, states)
    robot = RealRobot(L_ROOM, Fraction(100), Fraction(1, 8), seed=3)
    for _ in range(20):
        states = model.leg(states, len(list(robot.leg())) - 1)
    assert extent(model, states) < 1e-3 * everything
    x, y, turn = robot.pose
    assert holds_place(model, states, x, y, turn)
    boxes = model.places(states)
    assert (boxes.lower[:, 0] >= -1e-9).all()
    assert (boxes.upper[:, 0] <= 9 + 1e-9).all()


def test_bumps_localize_a_disk() -> None:
    model = RayModel(L_ROOM, Fraction(100), Fraction(1, 8), most_pieces=8000, radius_m=Fraction(1, 4))
    states = model.universe()
    everything = extent(model, states)
    robot = RealRobot(L_ROOM, Fraction(100), Fraction(1, 8), Fraction(1, 4), seed=3)
    for _ in range(20):
        states = model.leg(states, len(list(robot.leg())) - 1)
    assert extent(model, states) < 1e-2 * everything
    assert holds_place(model, states, *robot.pose)
    with pytest.raises(MapError, match="radius 4 m fits nowhere"):
        RayModel(L_ROOM, Fraction(100), Fraction(1, 8), most_pieces=8000, radius_m=Fraction(4)).universe()


def test_a_leg_is_the_same_as_its_steps() -> None:
    model = RayModel(PILLAR, Fraction(50), Fraction(1, 2), most_pieces=4000)
    stepped = legs = model.universe()
    for count in (3, 0, 5, 2):
        for _ in range(count):
            stepped = model.step(stepped, None, 0)
        stepped, legs = model.step(stepped, None, 1), model.leg(legs, count)
        assert np.array_equal(stepped.walls, legs.walls)
        assert np.array_equal(stepped.lower, legs.lower)
        assert np.array_equal(stepped.upper, legs.upper)


def test_a_step_is_within_what_is_predicted() -> None:
    model = RayModel(ROOM, Fraction(70), Fraction(1), most_pieces=4000)
    states = model.leg(model.universe(), 1)
    predicted = model.predict(states, None)
    robot = RealRobot(ROOM, Fraction(70), Fraction(1), seed=2)
    assert not model.empty(predicted)
    for reading in (0, 1):
        after = model.step(states, None, reading)
        assert len(after) > 0
        assert set(after.steps.tolist()) <= set(predicted.steps.tolist())
        assert extent(model, after) <= extent(model, predicted) + 1e-9
    assert robot.pose[0] >= 0


@pytest.mark.parametrize("seed", range(6))
def test_a_robot_that_drove_k_steps_exactly_is_in_its_place(seed: int) -> None:
    """Places are compared in 60 digits, in the frame of the environment, which lies far away."""
    random = np.random.default_rng(seed)
    x0, y0, step = Fraction(10**5, 3), Fraction(-(10**4), 7), Fraction(1, 7)
    rings = [[tuple((x + x0, y + y0) for x, y in ring) for ring in polygon.rings] for polygon in random_environment(seed).polygons]
    there = Environment(tuple(Polygon.trusted(outer, tuple(holes)) for outer, *holes in rings))
    model, exactly = RayModel(there, Fraction(90), step, most_pieces=30_000), ExactWalls.of(there)
    for _ in range(60):
        wall, part, heading = int(random.integers(len(model.walls))), float(random.random()), float(random.uniform(-7.0, 7.0))
        count, at = int(random.integers(0, 30)), np.array([[part, heading]])
        one = RaySet(np.array([wall], np.int32), at, at, np.array([count], np.int32), np.zeros(1, np.bool_), np.array([np.inf]))
        box = model.places(one)
        with mpmath.workdps(DIGITS):
            x, y = exactly.point(wall, part)
            origin, way = [exact(each) for each in there.bounds[:2]], count * exact(step)
            place = (origin[0] + x + way * mpmath.cos(exact(heading)), origin[1] + y + way * mpmath.sin(exact(heading)))
            for side in (0, 1):
                assert exact(float(box.lower[0, side])) <= place[side] <= exact(float(box.upper[0, side]))
                assert box.upper[0, side] - box.lower[0, side] < 1e-9


@pytest.mark.parametrize("mirrored", [False, True])
def test_a_robot_that_touches_the_end_of_a_wall_may_go_on_along_the_other_wall_of_the_corner(mirrored: bool) -> None:
    """It comes from where the other wall is not in its way, turns by 60°, and passes the corner on the side of that wall."""
    corners = [(0, 0), (9, 0), (9, 4), (5, 4), (5, 7), (0, 7)]
    room = Environment((Polygon(ring(*([(y, x) for x, y in corners[::-1]] if mirrored else corners))),))
    model = RayModel(room, Fraction(60 if mirrored else 300), Fraction(1), most_pieces=6000)
    ends = [(model.walls.x[at], model.walls.y[at]) for at in range(6)]
    start, other = (ends.index((0.0, 0.0)), ends.index((4.0, 5.0))) if mirrored else (ends.index((0.0, 7.0)), ends.index((9.0, 4.0)))
    along = (3.0 - 5.0 * np.tan(np.radians(10.0))) / 7.0
    at = np.array([[1.0 - along if mirrored else along, np.radians(100.0 if mirrored else -10.0)]])
    one = RaySet(np.array([start], np.int32), at - 1e-9, at + 1e-9, np.zeros(1, np.int32), np.zeros(1, np.bool_), np.array([np.inf]))
    after = model.leg(one, 5)
    heading = np.radians(160.0 if mirrored else 290.0)
    corner = after.lower[:, 0] <= 0.0 if mirrored else after.upper[:, 0] >= 1.0
    assert ((after.walls == other) & corner & (after.lower[:, 1] <= heading) & (heading <= after.upper[:, 1])).any()


def test_more_steps_than_fit_are_a_rejection() -> None:
    model = RayModel(ROOM, Fraction(90), Fraction(1), most_pieces=4000)
    robot = SetMembershipFilter(model, "restart")
    rejections = [robot.update(None, 0) for _ in range(6)]
    assert rejections == [None] * 5 + [Rejection(5)], "the diagonal is 5 m"
    assert len(robot.states) == len(model.universe())
    with pytest.raises(ConfigError, match="has not bumped yet"):
        model.places(robot.states)


def test_what_is_known_at_the_start_is_used() -> None:
    everywhere = RayModel(L_ROOM, Fraction(100), Fraction(1, 2), most_pieces=6000)
    north = RayModel(L_ROOM, Fraction(100), Fraction(1, 2), most_pieces=6000, headings_deg=((Fraction(80), Fraction(100)),))
    corner = (Fraction(7), Fraction(1), Fraction(8), Fraction(2))
    there = RayModel(L_ROOM, Fraction(100), Fraction(1, 2), most_pieces=6000, headings_deg=((Fraction(80), Fraction(100)),), region=corner)
    every, up, known = (model.leg(model.universe(), 4) for model in (everywhere, north, there))
    assert 0 < extent(there, known) < 0.5 * extent(north, up) < 0.1 * extent(everywhere, every)
    assert set(known.walls.tolist()) == {2}, "the wall above the right arm"


@pytest.mark.parametrize("most", [2000, 4000])
def test_a_coarser_set_holds_every_point_of_a_finer_one(most: int) -> None:
    walls = Walls.of(PILLAR)
    model = RayModel(PILLAR, Fraction(50), Fraction(1, 2), most_pieces=40_000)
    fine = model.leg(model.leg(model.universe(), 4), 3)
    coarse = coarsened(fine, walls, most)
    assert len(coarse) <= most < len(fine)
    chooser = np.random.default_rng(0)
    for at in chooser.integers(0, len(fine), 200).tolist():
        part, heading = (chooser.uniform(fine.lower[at, side], fine.upper[at, side]) for side in (0, 1))
        turns = np.array([-1.0, 0.0, 1.0])[:, None] * 2.0 * np.pi
        in_part = (coarse.walls == fine.walls[at]) & (coarse.lower[:, 0] <= part) & (part <= coarse.upper[:, 0])
        assert (in_part & (coarse.lower[:, 1] <= heading + turns) & (heading + turns <= coarse.upper[:, 1])).any()


def test_coordinates_far_from_the_origin_keep_their_bits() -> None:
    shift = Fraction(5_000_000), Fraction(400_000) + Fraction(1, 3)
    far = Environment((Polygon(tuple((x + shift[0], y + shift[1]) for x, y in L_ROOM.polygons[0].outer)),))
    here, there = (RayModel(each, Fraction(100), Fraction(1, 4), most_pieces=6000) for each in (L_ROOM, far))
    first, second = (model.leg(model.leg(model.universe(), 6), 4) for model in (here, there))
    assert np.array_equal(first.lower, second.lower)
    moved = here.places(first).lower[:, 0] + 5e6 - there.places(second).lower[:, 0]
    assert np.abs(moved).max() < 1e-8


@pytest.mark.parametrize(
    ("more", "message"),
    [
        ({"step_m": Fraction(0)}, "step is 0 m"),
        ({"bounce_deg": Fraction(720)}, "multiple of 360°"),
        ({"most_pieces": 10}, "at most 10 pieces are too coarse for 4 walls"),
        ({"headings_deg": ((Fraction(2), Fraction(1)),)}, "ends before it begins"),
        ({"region": (Fraction(2), Fraction(0), Fraction(1), Fraction(1))}, "region at the start is empty"),
    ],
)
def test_what_cannot_be_meant_is_refused(more: dict[str, object], message: str) -> None:
    with pytest.raises(ConfigError, match=message):
        RayModel(**({"environment": ROOM, "bounce_deg": Fraction(90), "step_m": Fraction(1)} | more))  # type: ignore[arg-type]


def test_too_many_walls_are_refused() -> None:
    corners = [(x, (x % 2)) for x in range(5000)]
    saw = Environment((Polygon.trusted(ring(*corners, (5000, -1), (0, -1)), ()),))
    with pytest.raises(MapError, match="5002 walls"):
        Walls.of(saw)
