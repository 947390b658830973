"""`advise`: what filters of a robot come to for a few choices of cells, parts of walls and headings, and which of them to take."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction

from ial.bouncing.cells.headings import Headings
from ial.bouncing.execution_bounds import ExecutionBounds
from ial.bouncing.filters.building import all_free_cells
from ial.bouncing.planning.cell_choice import NARROWEST, CellChoice, faults_of, lattice_m
from ial.bouncing.planning.piece_choice import PieceChoice
from ial.errors import ConfigError, FilterError, MapError
from ial.maps.polygons.environment import Environment
from ial.maps.polygons.raster import Raster, Rule
from ial.maps.polygons.walls import MOST_WALLS

MOST_STATES = 2**17
_MOST_CELLS = 2**24
_USUAL_STEP = Fraction(1, 4)  # metres, of the ray mode, as `ial bounce build` has it
_PARTS, _PART_HEADINGS = (Fraction(1), Fraction(1, 2), Fraction(1, 4)), (36, 72)
_TRY_IT = "it may be too coarse to tell places apart, so try it on what `ial bounce simulate` writes; on a computer, RayModel knows more"
_RULES: tuple[Rule, ...] = ("centre", "inside")


@dataclass(frozen=True)
class Advice:
    """What was computed, and what to take.

    Parameters
    ----------
    cells
        Exact filters.
    pieces
        Set filters of a robot with real geometry.
    no_pieces
        Why there are none of these; None if there are.
    best
        What to take; None if nothing here is right for the robot.
    reason
        Why.
    """

    cells: tuple[CellChoice, ...]
    pieces: tuple[PieceChoice, ...]
    no_pieces: str | None
    best: CellChoice | PieceChoice | None
    reason: str


@dataclass(frozen=True)
class _Robot:
    bounce_deg: Fraction
    step_m: Fraction | None
    radius_m: Fraction
    bounds: ExecutionBounds


def advise(
    environments: Mapping[str, Environment],
    bounce_deg: Fraction,
    step_m: Fraction | None = None,
    radius_m: Fraction = Fraction(0),
    bounds: ExecutionBounds | None = None,
    flash_bytes: int = 64 * 1024,
    most_states: int = MOST_STATES,
    progress: Callable[[int, int], object] | None = None,
) -> Advice:
    """Return what filters of a robot come to, and which to take. Each number was computed; what would be too much work has none.

    Parameters
    ----------
    environments
        Where the robot can be, by name.
    bounce_deg
        The bouncing angle, counter-clockwise.
    step_m
        How far a step leads; by default the width of a cell in exact filters, 1/4 m in others.
    radius_m
        The radius of the robot; 0 for a point.
    bounds
        What the robot may do wrong; by default nothing.
    flash_bytes
        Of filters with real geometry, the finest that fits into so much is taken.
    most_states
        The number of states at which to give up an exact filter.
    progress
        Called with how many choices were looked at, and of how many.

    Raises
    ------
    ConfigError
        If a number cannot be meant.
    """
    if step_m is not None and step_m <= 0:
        raise ConfigError(f"the step is {float(step_m):g} m; give a length greater than 0")
    if radius_m < 0:
        raise ConfigError(f"the radius of the robot is {float(radius_m):g} m; give 0 for a point, or a positive length")
    robot = _Robot(bounce_deg, step_m, radius_m, ExecutionBounds() if bounds is None else bounds)
    Headings.of_angle(bounce_deg)  # raises for an angle that no choice could help
    lattice = lattice_m(environments.values())
    widths = cell_widths(environments, step_m, radius_m, lattice)
    total, done = len(widths) * len(_RULES) * 2 + len(_PARTS) * len(_PART_HEADINGS), 0

    def told(_: object) -> None:
        nonlocal done
        done += 1
        if progress is not None:
            progress(done, total)

    cells = []
    for choice in _cell_choices(environments, robot, widths, lattice, most_states):
        cells.append(choice)
        told(choice)
    pieces, no_pieces = [], _no_pieces(environments, robot)
    if no_pieces is None:
        try:
            for piece in _piece_choices(next(iter(environments.values())), robot):
                pieces.append(piece)
                told(piece)
        except (MapError, FilterError) as error:
            pieces, no_pieces = [], str(error)
    best, reason = _best(cells, pieces, no_pieces, robot, flash_bytes)
    return Advice(tuple(cells), tuple(pieces), no_pieces, best, reason)


def cell_widths(
    environments: Mapping[str, Environment], step_m: Fraction | None, radius_m: Fraction, lattice: Fraction | None
) -> list[Fraction]:
    """Return the widths of cells that are worth a look, widest first.

    Those of the robot and its radius, of a step, of the map's cells and of five and ten of these, and the narrowest on the lattice of the
    walls that holds the robot and is not much wider.
    """
    widths = {width for width in (2 * radius_m, radius_m, step_m) if width}
    if radius_m and lattice is not None and lattice >= 2 * radius_m:
        fitting = lattice / (lattice // (2 * radius_m))
        widths |= {fitting} if fitting * NARROWEST <= 2 * radius_m else set()
    for environment in environments.values():
        if environment.cell is not None:
            widths |= {environment.cell, 5 * environment.cell, 10 * environment.cell}
    return sorted(widths or {Fraction(1), Fraction(1, 2)}, reverse=True)


def _cell_choices(
    environments: Mapping[str, Environment], robot: _Robot, widths: list[Fraction], lattice: Fraction | None, most_states: int
) -> Iterator[CellChoice]:
    least = (robot.bounce_deg / 360).denominator
    for cell in widths:
        for rule in _RULES:
            rasters = _rasters(environments, cell, robot.radius_m, rule)
            for count in (least, least * max(2, -(-8 // least))):
                if isinstance(rasters, str):
                    yield CellChoice(cell, count, rule, rasters)
                    continue
                try:
                    headings = Headings.of_angle(robot.bounce_deg, count, Fraction(1) if robot.step_m is None else robot.step_m / cell)
                except ConfigError:
                    yield CellChoice(cell, count, rule, "a step leads out of no cell")
                    continue
                faults = faults_of(lattice, cell, headings, robot.radius_m, rule, robot.bounds)
                yield CellChoice.of(rasters, headings, robot.radius_m, rule, faults, most_states)


def _rasters(environments: Mapping[str, Environment], cell: Fraction, radius_m: Fraction, rule: Rule) -> dict[str, Raster] | str:
    """Return the free cells, or why there are none."""
    for environment in environments.values():
        x0, y0, x1, y1 = environment.bounds
        if (x1 - x0) * (y1 - y0) > _MOST_CELLS * cell**2:
            return f"more than {_MOST_CELLS:,} cells"
    try:
        return all_free_cells(environments, cell, radius_m, rule)
    except MapError:  # the number of cells was looked at
        return "no cell is free"


def _no_pieces(environments: Mapping[str, Environment], robot: _Robot) -> str | None:
    if len(environments) > 1:
        return "filters with real geometry are of one environment; give one"
    walls = sum(len(ring) for environment in environments.values() for polygon in environment.polygons for ring in polygon.rings)
    if walls > MOST_WALLS:
        return f"rays are followed among at most {MOST_WALLS:,} walls, and here are {walls:,}; use fewer (--simplify)"
    return None


def _piece_choices(environment: Environment, robot: _Robot) -> Iterator[PieceChoice]:
    step = _USUAL_STEP if robot.step_m is None else robot.step_m
    for part in _PARTS:
        for count in _PART_HEADINGS:
            yield PieceChoice.of(environment, robot.bounce_deg, step, robot.bounds, part, count, robot.radius_m)


def _best(
    cells: list[CellChoice], pieces: list[PieceChoice], no_pieces: str | None, robot: _Robot, flash_bytes: int
) -> tuple[CellChoice | PieceChoice | None, str]:
    """Return what to take, and why. What is right for whom is what `docs/bouncing.md` says under "What is guaranteed"."""
    right = [each for each in cells if each.is_right]
    if right:
        chosen = min(right, key=lambda each: (each.flash_bytes or 0, each.headings))
        return chosen, (
            f"a disk {2 * float(robot.radius_m):g} m wide keeps to cells of {float(chosen.cell_m):g} m: walls are on their lattice, and "
            "steps lead from centre to centre; the filter is right if the robot starts at a centre, in one of the headings, and never "
            "errs, and tells any other robot wrong places"
        )
    wrong = _why_not(cells)
    known = [each for each in pieces if each.flash_bytes is not None]
    fitting = [each for each in known if (each.flash_bytes or 0) <= flash_bytes]
    if fitting:
        finest = max(fitting, key=lambda each: (each.pieces, each.headings))
        return finest, (
            f"{wrong}; the filter of rays holds the robot wherever it starts, within its bounds of errors, and this is the finest here of "
            f"at most {flash_bytes:,} bytes of flash; {_TRY_IT}"
        )
    if known:
        smallest = min(known, key=lambda each: (each.flash_bytes or 0, each.pieces))
        return smallest, (
            f"{wrong}; the filter of rays holds the robot wherever it starts, within its bounds of errors; none here takes as little as "
            f"{flash_bytes:,} bytes of flash, and this is the smallest; {_TRY_IT}"
        )
    if no_pieces is None:
        return None, f"{wrong}; filters of rays are too much work here: take longer steps (--step), or fewer walls (--simplify)"
    return None, f"{wrong}; {no_pieces}"


def _why_not(cells: list[CellChoice]) -> str:
    """Return why no exact filter is to be taken."""
    made = [each for each in cells if each.refusal is None]
    shared = [fault for fault in made[0].faults if all(fault in each.faults for each in made)] if made else []
    if not made:
        return "there is no exact filter here"
    if shared:
        return f"every exact filter here tells this robot wrong places ({', '.join(shared)})"
    if any(not each.faults for each in made):
        return "the exact filter that is right for this robot has too many states"
    return "every exact filter here tells this robot wrong places"
