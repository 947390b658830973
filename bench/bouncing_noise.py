"""What noise costs: the set-valued cell map for growing bounds of errors, beside the exact map."""

from collections.abc import Iterator
from fractions import Fraction
from itertools import islice

import numpy as np
from report import Report, options
from timing import timed

from ial.bouncing.automata.determinization import determinize
from ial.bouncing.automata.set_automaton import determinize_sets
from ial.bouncing.cells.cell_map import CellMap
from ial.bouncing.cells.headings import Headings
from ial.bouncing.cells.noisy_map import NoisyMap
from ial.bouncing.cells.noisy_model import NoisyModel
from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.rays.real_robot import RealRobot
from ial.errors import FilterError
from ial.maps.polygons.environment import Environment
from ial.maps.polygons.polygon import Polygon
from ial.maps.polygons.raster import rasterize

ABOUT = """\
An L of 9 m × 7 m with a pillar, cells of 1/4 m, 36 headings, bouncing angle 100°, steps of 1 m. *Known*: the share of all vertices in
which a robot with real geometry can be after 100 observations, the median of 20 robots whose errors keep the bounds; the exact map is
followed by its own robot, which is put back to the centre of its cell. An automaton is given up at 20,000 states."""
MOST = 20_000


def ring(*corners: tuple[int, int]) -> tuple[tuple[Fraction, Fraction], ...]:
    """Return a ring with whole coordinates."""
    return tuple((Fraction(x), Fraction(y)) for x, y in corners)


HALL = Environment((Polygon(ring((0, 0), (9, 0), (9, 4), (5, 4), (5, 7), (0, 7)), (ring((2, 2), (2, 4), (3, 4), (3, 2)),)),))
CELL, HEADINGS = Fraction(1, 4), Headings.of_angle(Fraction(100), 36, Fraction(4))
BOUNDS = {
    "none, real geometry": ExecutionBounds(),
    "turn ± 1°": ExecutionBounds(Fraction(1)),
    "turn ± 10°": ExecutionBounds(Fraction(10)),
    "step ± 2 %": ExecutionBounds(step=Fraction(1, 50)),
    "step ± 10 %": ExecutionBounds(step=Fraction(1, 10)),
    "count ± 1": ExecutionBounds(count=1),
    "all: 1°, 2 %, 1": ExecutionBounds(Fraction(1), Fraction(1, 50), 1),
}


def rows() -> Iterator[tuple[str, ...]]:
    """Yield the exact map, and the noisy ones."""
    exact = CellMap(rasterize(HALL, CELL), HEADINGS).graph
    determinize(exact)  # compiles
    seconds, automaton = timed(determinize, exact)
    known = f"{np.median(automaton.cycles.uncertainty) / len(exact):.1e}"
    yield "none, put back to the centre", f"{len(exact):,}", f"{len(exact):,}", f"{len(automaton):,}", f"{seconds:.3f}", known, "–"
    for name, bounds in BOUNDS.items():
        seconds, graph = timed(lambda bounds=bounds: NoisyMap(HALL, CELL, HEADINGS, bounds).graph, runs=1)
        try:
            took, outcome = timed(determinize_sets, graph, MOST, runs=1)
            states, words = f"{len(outcome):,}", f"{took:.1f}"
        except FilterError:
            states, words = f"> {MOST:,}", "–"
        model, left, times = NoisyModel(graph), [], []
        for seed in range(20):
            robot = RealRobot(HALL, Fraction(100), Fraction(1), bounds=bounds, seed=seed)
            stream = [pose.observation for pose in islice(robot.run(), 100)]
            spent, states_left = timed(follow, model, stream, runs=1)
            left.append(states_left / graph.first)
            times.append(spent / len(stream))
        yield name, f"{len(graph):,}", f"{graph.arcs:,}", states, words, f"{np.median(left):.1e}", f"{1e3 * float(np.median(times)):.2f}"


def small() -> Iterator[tuple[str, ...]]:
    """Yield the automata of a room that is small enough for them."""
    room = Environment((Polygon(ring((0, 0), (4, 0), (4, 3), (0, 3))),))
    headings = Headings.of_angle(Fraction(90), 12, Fraction(3))
    exact = CellMap(rasterize(room, Fraction(1, 2)), headings).graph
    seconds, automaton = timed(determinize, exact)
    yield (
        "none, put back to the centre",
        f"{len(exact)}",
        f"{len(automaton):,}",
        f"{seconds:.4f}",
        f"{np.median(automaton.uncertainty):.0f}",
    )
    for name, bounds in BOUNDS.items():
        graph = NoisyMap(room, Fraction(1, 2), headings, bounds).graph
        try:
            seconds, outcome = timed(determinize_sets, graph, MOST, runs=1)
            yield name, f"{graph.arcs}", f"{len(outcome):,}", f"{seconds:.3f}", f"{np.median(outcome.sizes):.0f}"
        except FilterError:
            yield name, f"{graph.arcs}", f"> {MOST:,}", "–", "–"


def follow(model: NoisyModel, stream: list[int]) -> int:
    """Return in how many vertices the robot can be."""
    states = model.universe()
    for reading in stream:
        states = model.step(states, None, reading)
    return len(states)


def main() -> None:
    """Measure, print, and write."""
    chosen = options(__doc__ or "").parse_args()
    report = Report("The bouncing robot with noise", ABOUT)
    report.table(("errors", "vertices", "arcs", "states", "s", "known", "ms per observation"), rows())
    report.say("The automata of a room of 4 m × 3 m, cells of 1/2 m, 12 headings, 90°, steps of 1.5 m.\n")
    report.table(("errors", "arcs", "states", "s", "median of the sizes of sets"), small())
    report.write(chosen.out)


if __name__ == "__main__":
    main()
