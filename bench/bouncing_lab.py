"""The lab of Alam et al. 2017 as a simulation: ten runs of a disk in each of two rooms, without errors and with them."""

import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from statistics import median

from report import Report, options

sys.path.append(str(Path(__file__).parents[1]))  # what is right about an exact filter is told as in the tests

from ial.bouncing.cells.headings import Headings
from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.filters.bounce_filter import BounceFilter
from ial.bouncing.filters.building import build_filter, free_cells
from ial.bouncing.filters.goal import Goal
from ial.bouncing.filters.piece_filter import PieceFilter
from ial.bouncing.rays.piece_map import PieceMap
from ial.bouncing.rays.ray_model import RayModel
from ial.bouncing.rays.real_robot import RealPose, RealRobot
from ial.maps.polygons.environment import Environment
from ial.maps.polygons.outline import outlines
from tests.bouncing.judged_runs import NONE, holds, robots
from tests.bouncing.worlds import drawn

ABOUT = """\
The paper ran an iRobot Create ten times in two rooms, whose free space was 19 cells with 8 headings, at 45° and 135°, until a knowledge
cycle was reached, and reports in how many configurations that can leave it. It gives neither the size of the robot nor those of the rooms,
and its figures are missing from the text at hand: **the rooms and all sizes here are ours**. The disk is 0.34 m across, about as a
Create is, and a cell is as wide as the disk. Runs start at centres of cells in one of the 8 headings. The clock ticks eight
times for each cell; the exact filter is told every eighth tick, and one tick early where the clock may be wrong by one. A run ends when
its filter says that it is localized: the exact one on a knowledge cycle, the others when the place of the last bump is known to 0.34 m.
*Right* is who was there, exactly; *bumps* is the median (least to greatest) number at that moment."""

RADIUS = Fraction(17, 100)
CELL = 2 * RADIUS
TICKS = 8
STEP = CELL / TICKS
SOME = ExecutionBounds(Fraction(2), Fraction(1, 50), 1)
LABS = {name: drawn(picture) for name, picture in {"A": "...#. ..... .#..# ..#.. ..##.", "B": "##... #.... ....# .#... ....#"}.items()}
"""As one sees them: a dot is a free cell."""

PART, HEADINGS, MOST = Fraction(1, 20), 72, 20_000


@dataclass(frozen=True)
class Ending:
    """What became of a run: right, wrong, rejected or not localized; after how many bumps; how many configurations were left."""

    word: str
    bumps: int
    left: int = 0


def exact(made: BounceFilter, robot: RealRobot, legs: int, early: int) -> Ending:
    """Follow a run by the exact filter."""
    state = 0
    for bumps in range(legs):
        poses = list(robot.leg())
        ticks = [*poses[:-1][TICKS - 1 - early :: TICKS], poses[-1]]
        for pose in ticks:
            state = made.table.step(state, pose.observation)
            if state == made.table.trap:
                return Ending("rejected", bumps + pose.observation)
            if made.table.is_localized(state):
                right = any(holds(made, place, pose) for place in made.where(state))
                return Ending("right" if right else "wrong", bumps + pose.observation, int(made.table.uncertainty[state]))
    return Ending("not localized", legs)


def pieces(made: PieceFilter, robot: RealRobot, legs: int) -> Ending:
    """Follow a run by the filter with bounds of errors."""
    model = made.model
    states = model.universe()
    for bumps in range(1, legs + 1):
        poses = list(robot.leg())
        states = model.leg(states, len(poses) - 1)
        if model.empty(states):
            return Ending("rejected", bumps)
        if made.is_localized(states):
            return Ending(_judged(made.box(states), poses[-1]), bumps)
    return Ending("not localized", legs)


def rays(model: RayModel, robot: RealRobot, legs: int) -> Ending:
    """Follow a run by the ray mode."""
    states = model.universe()
    for bumps in range(1, legs + 1):
        poses = list(robot.leg())
        states = model.leg(states, len(poses) - 1)
        if model.empty(states):
            return Ending("rejected", bumps)
        places = model.places(states)
        (x0, y0), (x1, y1) = places.lower.min(axis=0)[:2].tolist(), places.upper.max(axis=0)[:2].tolist()
        if max(x1 - x0, y1 - y0) <= CELL:
            return Ending(_judged((x0, y0, x1, y1), poses[-1]), bumps)
    return Ending("not localized", legs)


def _judged(box: tuple[float, float, float, float] | None, pose: RealPose) -> str:
    x0, y0, x1, y1 = map(Fraction, box or (1, 1, 0, 0))
    return "right" if x0 <= pose.x_m <= x1 and y0 <= pose.y_m <= y1 else "wrong"


def told(endings: list[Ending]) -> str:
    """Return in words how runs ended."""
    words = Counter(each.word for each in endings)
    bumps = sorted(each.bumps for each in endings if each.word in ("right", "wrong"))
    when = f"; {median(bumps):g} ({bumps[0]} to {bumps[-1]})" if bumps else ""
    left = [each.left for each in endings if each.left]
    many = f"; {min(left)} to {max(left)}" if left else ""
    return " / ".join(str(words[each]) for each in ("right", "wrong", "rejected", "not localized")) + when + many


def rows(count: int, legs: int) -> Iterator[tuple[str, ...]]:
    """Yield, for each room, angle and kind of robot, how its runs ended."""
    for name, free in LABS.items():
        environment = Environment(outlines(free, CELL))
        if int(free_cells(environment, CELL, RADIUS).free.sum()) != 19:
            raise AssertionError(f"lab {name} has not 19 free cells for the centre of the disk")
        for angle in (45, 135):
            made = build_filter({name: environment}, Headings.of_angle(Fraction(angle), 8), CELL, RADIUS)
            robot = Fraction(angle), STEP, SOME
            sets = PieceFilter(PieceMap.of(environment, *robot, PART, HEADINGS, RADIUS), name, *robot, Goal(width=CELL), RADIUS)
            model = RayModel(environment, *robot, MOST, radius_m=RADIUS)
            for words, bounds in (("none", NONE), ("2°, 2 %, 1", SOME)):
                starts = [each.pose for each in robots(environment, made, count)]
                runs = [
                    [RealRobot(environment, *robot[:2], RADIUS, bounds, seed, start) for seed, start in enumerate(starts)] for _ in range(3)
                ]
                outcomes = (
                    [exact(made, each, legs, bounds.count) for each in runs[0]],
                    [pieces(sets, each, legs) for each in runs[1]],
                    [rays(model, each, legs) for each in runs[2]],
                )
                yield f"{name}, {angle}°", words, *map(told, outcomes)


def main() -> None:
    """Measure, print, and write."""
    parser = options(__doc__ or "")
    parser.add_argument("--runs", type=int, default=10, metavar="N", help="how many runs of each kind; ten in the paper")
    parser.add_argument("--legs", type=int, default=60, metavar="N", help="after how many bumps a run is given up")
    chosen = parser.parse_args()
    report = Report("The paper's lab, simulated", ABOUT)
    for name, free in LABS.items():
        report.say(f"Lab {name}:\n\n```text\n" + "\n".join("".join(".#"[not cell] for cell in row) for row in free[::-1]) + "\n```\n")
    report.say(
        f"{chosen.runs} runs of each kind: right / wrong / rejected / not localized after {chosen.legs} bumps; bumps; for the exact "
        "filter, configurations. In all rows the bounds of `PieceFilter` and `RayModel` are "
        f"{SOME.turn_deg}°, {float(SOME.step):.0%} and {SOME.count}.\n"
    )
    report.table(("lab", "errors", "exact filter", "`PieceFilter`", "`RayModel`"), rows(chosen.runs, chosen.legs))
    report.write(chosen.out)


if __name__ == "__main__":
    main()
