"""Filters of a bouncing robot that follow simulated runs, each with what it holds, what it claims, and how much memory that takes."""

import sys
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

import numpy as np

sys.path.append(str(Path(__file__).parents[1]))  # the rooms are those of the tests

from ial.bouncing.cells.cell_map import CellMap
from ial.bouncing.cells.headings import Headings
from ial.bouncing.cells.model import BouncingModel
from ial.bouncing.cells.noisy_map import NoisyMap
from ial.bouncing.cells.noisy_model import NoisyModel
from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.exports.c_tables import CTables
from ial.bouncing.exports.exported_filter import ExportedFilter
from ial.bouncing.filters.bounce_filter import BounceFilter
from ial.bouncing.filters.building import free_cells
from ial.bouncing.rays.piece_map import PieceMap
from ial.bouncing.rays.piece_model import PieceModel
from ial.bouncing.rays.ray_model import RayModel
from ial.particles.bounce_monte_carlo import BounceMonteCarlo
from tests.bouncing.judged_runs import NONE, WORLDS

GOAL_M = 1.0
Box = tuple[float, float, float, float]
HALL = WORLDS["hall"]


@dataclass(frozen=True)
class Robot:
    """A kind of robot: what it is, and the grids of the filters for it."""

    name: str
    angle: Fraction
    step: Fraction
    radius: Fraction
    bounds: ExecutionBounds
    cell: Fraction
    headings: int
    from_centres: bool
    part: Fraction
    piece_headings: int

    @property
    def lattice(self) -> Headings:
        """The headings of filters of cells."""
        return Headings.of_angle(self.angle, self.headings, self.step / self.cell)

    @property
    def known_deg(self) -> tuple[tuple[Fraction, Fraction], ...]:
        """The headings at the start, if something is known of them."""
        every = (Fraction(360 * at, self.headings) for at in range(self.headings))
        return tuple((each, each) for each in every) if self.from_centres else ()


KEEPS = Robot(
    "A disk of 0.5 m that keeps to cells of 1 m: from a centre in one of 4 headings, 90°, no errors; all filters know the headings",
    *(Fraction(90), Fraction(1), Fraction(1, 2), NONE, Fraction(1), 4, True, Fraction(1, 4), 72),
)
ERRS = Robot(
    "A disk of 0.2 m from anywhere in any heading, turns of 100° ± 2°, steps of 0.25 m ± 2 %, counts ± 1",
    *(Fraction(100), Fraction(1, 4), Fraction(1, 5), ExecutionBounds(Fraction(2), Fraction(1, 50), 1), Fraction(1, 4), 36, False),
    *(Fraction(1, 4), 72),
)


class Followed(ABC):
    """A filter that follows one run after the other."""

    name: str
    map_bytes: int
    state_bytes = 0

    @abstractmethod
    def start(self, seed: int) -> None:
        """Begin anew."""

    @abstractmethod
    def update(self, observation: int) -> None:
        """Take an observation."""

    @abstractmethod
    def gone(self) -> bool:
        """Return whether nothing is left."""

    @abstractmethod
    def claim(self) -> list[Box]:
        """Return the rectangles that hold the place of the last bump; none if the robot is not localized."""


class Table(Followed):
    """The exact filter."""

    name = "exact filter, Python"

    def __init__(self, made: BounceFilter) -> None:
        self.made = made
        tables = CTables.of(ExportedFilter.of(made), "robot")
        self.map_bytes, self.state_bytes = tables.flash_bytes, tables.ram_bytes

    def start(self, seed: int) -> None:
        """Begin anew."""
        self.state = 0

    def update(self, observation: int) -> None:
        """Take an observation."""
        self.state = self.made.table.step(self.state, observation)

    def gone(self) -> bool:
        """Return whether nothing is left."""
        return self.state == self.made.table.trap

    def claim(self) -> list[Box]:
        """Return the rectangles of a claim."""
        half = float(self.made.setting.cell) / 2.0
        centres = [(float(place.x_m), float(place.y_m)) for place in self.made.where(self.state)]
        return [(x - half, y - half, x + half, y + half) for x, y in centres]


class Sets(Followed):
    """A model of sets, and how a set is told as a rectangle."""

    def __init__(self, name: str, model, map_bytes: int, size: Callable, box: Callable) -> None:  # type: ignore[no-untyped-def,type-arg]
        self.name, self.model, self.map_bytes, self._size, self._box = name, model, map_bytes, size, box

    def start(self, seed: int) -> None:
        """Begin anew."""
        self.states = self.model.universe()

    def update(self, observation: int) -> None:
        """Take an observation."""
        self.states = self.model.step(self.states, None, observation)

    def gone(self) -> bool:
        """Return whether nothing is left."""
        return bool(self.model.empty(self.states))

    def claim(self) -> list[Box]:
        """Return the rectangles of a claim."""
        self.state_bytes = max(self.state_bytes, self._size(self.states))
        return narrow(self._box(self.states))


class Particles(Followed):
    """A particle filter, with weights of 0 and 1, or soft ones and some roughening."""

    def __init__(self, robot: Robot, count: int, soft: bool) -> None:
        self.name = f"{count:,} particles, {'soft' if soft else '0 or 1'}"
        self._robot, self._count = robot, count
        self._noise = {"miss_steps": 0.5, "roughening_rad": 0.01} if soft else {}

    def start(self, seed: int) -> None:
        """Begin anew."""
        robot = self._robot
        place = HALL, robot.angle, robot.step, robot.radius, robot.bounds
        self.cloud = BounceMonteCarlo(*place, particles=self._count, seed=seed, **self._noise)
        if robot.from_centres:
            part = 2.0 * np.pi / robot.headings
            self.cloud.poses[:, 2] = part * np.round(self.cloud.poses[:, 2] / part)
        self.map_bytes = self.cloud.rays.walls.nbytes
        self.state_bytes = self.cloud.memory_bytes - self.map_bytes

    def update(self, observation: int) -> None:
        """Take an observation."""
        self.cloud.update(observation)

    def gone(self) -> bool:
        """Return whether nothing is left."""
        return not len(self.cloud.poses)

    def claim(self) -> list[Box]:
        """Return the rectangles of a claim."""
        return narrow(self.cloud.box())


def narrow(box: Box | None) -> list[Box]:
    """Return a rectangle if it fits into a square of 1 m."""
    return [box] if box is not None and max(box[2] - box[0], box[3] - box[1]) <= GOAL_M else []


def nbytes(thing: object) -> int:
    """Return the bytes of the arrays that an object holds itself."""
    return sum(each.nbytes for each in vars(thing).values() if isinstance(each, np.ndarray))


def graph_bytes(noisy: NoisyMap) -> int:
    """Return the bytes of the successors of a set-valued map."""
    return sum(each.nbytes for each in (*noisy.graph.starts, *noisy.graph.ends))


def filters(robot: Robot, exact: BounceFilter, pieces: PieceMap, counts: list[int]) -> Iterator[Followed]:
    """Yield all filters for a robot."""
    yield Table(exact)
    raster = free_cells(HALL, robot.cell, robot.radius)
    graph = CellMap(raster, robot.lattice).graph
    yield Sets("`BouncingModel`", BouncingModel(graph), nbytes(graph), lambda states: states.nbytes, lambda states: None)
    noisy = NoisyMap(HALL, robot.cell, robot.lattice, robot.bounds, robot.radius)
    yield Sets("`NoisyModel`", NoisyModel(noisy.graph), graph_bytes(noisy), lambda states: states.nbytes, cells_box(noisy))
    bounds = robot.angle, robot.step, robot.bounds
    rays = RayModel(HALL, *bounds, 5_000, robot.known_deg, radius_m=robot.radius)
    yield Sets("`RayModel`", rays, sum(each.nbytes for each in rays.walls.table), nbytes, rays_box(rays))
    yield Sets("`PieceModel`", PieceModel(pieces), nbytes(pieces), nbytes, pieces_box(pieces))
    for count in counts:
        for soft in (False, True):
            yield Particles(robot, count, soft)


def cells_box(noisy: NoisyMap) -> Callable[[np.typing.NDArray[np.int64]], Box]:
    """Return what tells a set of vertices as a rectangle."""
    raster = noisy.raster
    rows, columns = np.nonzero(raster.free)
    x, y, cell = float(raster.x), float(raster.y), float(raster.cell)

    def box(states: np.typing.NDArray[np.int64]) -> Box:
        at = states % len(rows)
        low_x, high_x, low_y, high_y = columns[at].min(), columns[at].max() + 1, rows[at].min(), rows[at].max() + 1
        return x + cell * low_x, y + cell * low_y, x + cell * high_x, y + cell * high_y

    return box


def rays_box(model: RayModel) -> Callable:  # type: ignore[type-arg]
    """Return what tells a set of the ray mode as a rectangle."""

    def box(states) -> Box | None:  # type: ignore[no-untyped-def]
        places = model.places(states)
        return *places.lower.min(axis=0)[:2].tolist(), *places.upper.max(axis=0)[:2].tolist()

    return box


def pieces_box(pieces: PieceMap) -> Callable:  # type: ignore[type-arg]
    """Return what tells a set of pieces as a rectangle."""
    return lambda states: pieces.bounds_m(states.pieces)
