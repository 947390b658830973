"""Every robot through the one filter, against sets of states that are written out."""

import math
from collections.abc import Callable, Hashable, Iterable
from dataclasses import dataclass
from fractions import Fraction
from itertools import islice
from typing import Any

import numpy as np
import pytest

from ial.bouncing.cells.graph import LabelledGraph
from ial.bouncing.cells.model import BouncingModel
from ial.bouncing.cells.noisy_model import NoisyModel
from ial.bouncing.cells.set_graph import SetGraph
from ial.bouncing.rays.ray_model import RayModel
from ial.bouncing.rays.real_robot import RealRobot
from ial.compass.model import CompassModel
from ial.compass.state import InformationState
from ial.compass.verifier import follow
from ial.datasets.recording import steps
from ial.datasets.simulator import Lidar, SensorErrors, simulate
from ial.datasets.walk import random_walk
from ial.lidar.atlas import AtlasModel
from ial.lidar.configuration.config import LocalizerConfig
from ial.lidar.evidence.beams import scan_beams
from ial.lidar.model import LidarModel
from ial.maps.grids.floor_plan import floor_plan
from ial.maps.polygons.exact.shooter import Shooter
from ial.membership import ContractingModel, Lapses, Model, Recovery, SetMembershipFilter, Worlds
from ial.odometer import Command, OdometerBounds, OdometerModel
from tests.bouncing.truth import random_environment
from tests.bouncing.worlds import cell_map, random_mask
from tests.odometer import worlds as odometer_worlds

States = frozenset[int]

COLOURS = [0, 0, 1, 0, 2, 1, 1, 0, 2, 2, 0, 1]


class Coloured(ContractingModel[States, int, int]):
    """A row of coloured places: a motion shifts by one place more or less than it says, a reading is a colour."""

    def universe(self) -> States:
        return frozenset(range(len(COLOURS)))

    def predict(self, states: States, motion: int) -> States:
        return frozenset(place + motion + off for place in states for off in (-1, 0, 1)) & self.universe()

    def contract(self, states: States, reading: int) -> States:
        return frozenset(place for place in states if COLOURS[place] == reading)

    def unite(self, allowed: States, predicted: States) -> States:
        return allowed | predicted

    def empty(self, states: States) -> bool:
        return not states


class Blind(Model[States, int, None]):
    """A robot without any reading in a row with walls: it drives one place up or down, unless a wall is there."""

    def universe(self) -> States:
        return frozenset(range(12))

    def predict(self, states: States, motion: int) -> States:
        return frozenset(min(max(place + motion, 0), 11) for place in states)

    def step(self, states: States, motion: int, reading: None) -> States:
        return self.predict(states, motion)

    def unite(self, allowed: States, predicted: States) -> States:
        return allowed | predicted

    def empty(self, states: States) -> bool:
        return not states


@dataclass(frozen=True)
class World:
    """A finite world: where a motion can lead from a state, with which reading; the twin of a model.

    `sensed` says whether a reading tells about the state in which it is taken, so that a lost robot can begin with it.
    """

    model: Any
    states: frozenset[Hashable]
    moves: Callable[[Any, Any], Iterable[tuple[Hashable, Any]]]
    motions: tuple[Any, ...]
    listed: Callable[[Any], set[Hashable]]
    sensed: bool = False

    def step(self, states: Iterable[Hashable], motion: Any, reading: Any) -> set[Hashable]:
        return {to for state in states for to, read in self.moves(state, motion) if read == reading}

    def predict(self, states: Iterable[Hashable], motion: Any) -> set[Hashable]:
        return {to for state in states for to, _ in self.moves(state, motion)}

    def anew(self, reading: Any) -> set[Hashable]:
        return {state for state in self.states if COLOURS[state] == reading} if self.sensed else set(self.states)  # type: ignore[call-overload]


def vertices(states: np.ndarray) -> set[Hashable]:
    assert len(set(states.tolist())) == len(states)
    return set(states.tolist())


def arcs(graph: LabelledGraph) -> Callable[[int, None], list[tuple[Hashable, int]]]:
    ends = graph.arcs.tolist()
    return lambda vertex, _: [(ends[vertex], 0)] if ends[vertex] >= 0 else [(~ends[vertex], 1)]


def set_valued(seed: int) -> tuple[SetGraph, dict[tuple[int, int], list[int]]]:
    random = np.random.default_rng(seed)
    places = range(25)
    leads = {
        (vertex, label): random.choice(25, random.integers(1, 3), replace=False).tolist() if random.random() < 0.5 else []
        for vertex in places
        for label in (0, 1)
    }
    starts = [np.concatenate([[0], np.cumsum([len(leads[v, label]) for v in places])]).astype(np.int64) for label in (0, 1)]
    ends = [np.array([to for v in places for to in leads[v, label]], dtype=np.int32) for label in (0, 1)]
    return SetGraph(tuple(starts), tuple(ends), 25), leads  # type: ignore[arg-type]


def worlds(seed: int) -> dict[str, World]:
    row = frozenset(range(12))
    one, other = (cell_map(random_mask(seed + far)).graph for far in (0, 50))
    noisy, leads = set_valued(seed)
    places = frozenset(range(len(one)))
    either = frozenset([("one", v) for v in places] + [("other", v) for v in range(len(other))])
    named = {"one": arcs(one), "other": arcs(other)}
    return {
        "a sensor": World(
            Coloured(),
            row,
            lambda at, far: [(to, COLOURS[to]) for to in range(at + far - 1, at + far + 2) if 0 <= to < 12],
            (-2, 1, 3),
            set,
            True,
        ),
        "no reading": World(Blind(), row, lambda at, far: [(min(max(at + far, 0), 11), None)], (-1, 1), set),
        "bumps": World(BouncingModel(one), places, arcs(one), (None,), vertices),
        "bumps with errors": World(
            NoisyModel(noisy),
            frozenset(range(25)),
            lambda v, _: [(to, label) for label in (0, 1) for to in leads[v, label]],
            (None,),
            vertices,
        ),
        "one of two worlds": World(
            Worlds({"one": BouncingModel(one), "other": BouncingModel(other)}),
            either,
            lambda at, motion: [((at[0], to), read) for to, read in named[at[0]](at[1], motion)],
            (None,),
            lambda states: {(name, v) for name, held in states.items() for v in vertices(held)},
        ),
    }


NAMES = tuple(worlds(0))


def readings(world: World, random: np.random.Generator, count: int) -> list[tuple[Any, Any]]:
    """Return motions and readings along a way through the world; some of the readings are any."""
    state = sorted(world.states)[random.integers(len(world.states))]  # type: ignore[type-var]
    taken = []
    for _ in range(count):
        motion = world.motions[random.integers(len(world.motions))]
        ways = sorted(world.moves(state, motion), key=repr)
        if not ways:  # it is carried elsewhere
            state = sorted(world.states)[random.integers(len(world.states))]  # type: ignore[type-var]
            continue
        state, reading = ways[random.integers(len(ways))]
        taken.append((motion, int(random.integers(3 if world.sensed else 2)) if random.random() < 0.3 and reading is not None else reading))
    return taken


@pytest.mark.parametrize("recovery", ["union", "restart", "absorb"])
@pytest.mark.parametrize("name", NAMES)
def test_a_filter_holds_exactly_the_states_that_all_readings_allow(name: str, recovery: Recovery) -> None:
    rejections = 0
    for seed in range(6):
        world = worlds(seed)[name]
        running = SetMembershipFilter(world.model, recovery)
        states = set(world.states)
        for motion, reading in readings(world, np.random.default_rng(seed), 40):
            after = world.step(states, motion, reading)
            rejected = not after
            if rejected and recovery != "absorb":
                fresh = world.anew(reading)
                after = fresh if recovery == "restart" and fresh else fresh | world.predict(states, motion)
            states = after
            assert (running.update(motion, reading) is not None) == rejected
            assert world.listed(running.states) == states
            rejections += rejected
    assert rejections > 0 or name == "no reading"


@pytest.mark.parametrize("most", [0, 1, 3])
@pytest.mark.parametrize("name", NAMES)
def test_with_lapses_a_filter_holds_the_states_that_all_but_some_readings_allow(name: str, most: int) -> None:
    for seed in range(4):
        world = worlds(seed)[name]
        running = SetMembershipFilter(Lapses(world.model, most), "absorb")
        states = {(state, 0) for state in world.states}
        for motion, reading in readings(world, np.random.default_rng(seed), 25):
            right = {(to, wrong) for state, wrong in states for to in world.step([state], motion, reading)}
            missed = {(to, wrong + 1) for state, wrong in states if wrong < most for to in world.predict([state], motion)}
            states = right | missed
            running.update(motion, reading)
            assert {(state, wrong) for wrong, held in enumerate(running.states) for state in world.listed(held)} == states


@pytest.mark.many
@pytest.mark.parametrize("seed", range(3))
def test_a_lidar_in_one_or_several_maps_holds_the_truth(seed: int) -> None:
    grid, config = floor_plan(9.0, 7.0, 0.05, seed), LocalizerConfig()
    here = LidarModel(grid, config)
    one = SetMembershipFilter(here, config.recovery)
    several = SetMembershipFilter(
        AtlasModel({"here": here, "there": LidarModel(floor_plan(9.0, 7.0, 0.05, seed + 9), config)}), config.recovery
    )
    lapsed = SetMembershipFilter(Lapses(here, 1), "absorb")
    path = random_walk(grid, 6, seed)
    lidar = Lidar(beams=90, angle_min=-math.pi, angle_increment=math.pi / 45.0)
    recording = simulate(grid, path, lidar, SensorErrors(0.02, 0.002, 4), config.bounds.motion, seed).recording
    for step, truth in zip(steps(recording, config.bounds.motion), path, strict=True):
        beams, at = scan_beams(step.scan, config), grid.pose_to_grid(truth)
        for running in (one, several, lapsed):
            assert running.update(step.motion, beams) is None  # type: ignore[attr-defined]
        assert one.states.contains(at)
        assert several.states["here"].contains(at)
        assert any(each.contains(at) for each in lapsed.states)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(3))
def test_a_bouncing_robot_with_real_geometry_holds_the_truth(seed: int) -> None:
    environment = random_environment(seed)
    model = RayModel(environment, Fraction(97), Fraction(1, 2), most_pieces=4000)
    running = SetMembershipFilter(model, "restart")
    bumps = 0
    for pose in islice(RealRobot(environment, Fraction(97), Fraction(1, 2), seed=seed).run(), 60):
        assert running.update(None, pose.observation) is None
        bumps += pose.observation
        if bumps:
            boxes = model.places(running.states)
            assert ((boxes.lower[:, :2] <= [pose.x_m, pose.y_m]) & ([pose.x_m, pose.y_m] <= boxes.upper[:, :2])).all(axis=1).any()


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(4))
def test_a_robot_with_a_compass_holds_the_truth(seed: int) -> None:
    """Without any reading: exactly the places of robots from everywhere, and each of them."""
    polygon = random_environment(seed).polygons[0]
    motions = [(1, 0), (2, 3), (-5, 1), (0, -1), (-1, -1)]
    running = SetMembershipFilter(CompassModel(polygon))
    ways = [follow(polygon, corner, motions) for ring in polygon.rings for corner in ring]
    for step, motion in enumerate(motions, 1):
        assert running.update(motion, None) is None
        state = InformationState.of(Shooter(polygon), running.states.pieces, running.states.points)
        for way in ways:
            (here,) = Shooter(polygon).shoot_all([way[step - 1]], [motion])
            assert (here.x, here.y) == way[step]
            assert InformationState.of(Shooter(polygon), state.pieces, [*state.points, here]) == state


@pytest.mark.slow
@pytest.mark.parametrize("bounds", [None, OdometerBounds(0.01, 0.5)], ids=["exact", "with errors"])
def test_a_robot_with_odometers_holds_the_truth(bounds: OdometerBounds | None) -> None:
    for name, seed in (("hall", 1), ("comb", 2), ("S", 3)):
        robot = odometer_worlds.robot(odometer_worlds.WORLDS[name], seed, bounds)
        robot.execute(Command(Fraction(0)))  # to the wall where the model begins
        running = SetMembershipFilter(OdometerModel(odometer_worlds.WORLDS[name], bounds), "restart")
        for turn in (180, 90, -135, 40, 160, 75):
            command = Command(Fraction(turn))
            assert running.update(command, robot.execute(command)) is None
            assert running.states.holds(robot.x, robot.y, robot.heading_rad)
