"""`ial bounce show`: pictures of knowledge cycles, of basins, of the automaton, and of what is left after bumps."""

from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from ial.cli.bounce.observed import ClockError, LogFile, Speed, SpeedError, StreamBits, StreamFile, TurnTime, observations, timing
from ial.cli.bounce.options import (
    Angle,
    Cell,
    CornerPolicy,
    FreeRule,
    HeadingCount,
    MostStates,
    Radius,
    Resolution,
    Simplify,
    StepLength,
    cell_width,
    number,
    step_cells,
)
from ial.cli.shell.options import Overwrite
from ial.cli.shell.outputs import check_outputs
from ial.cli.shell.terminal import counting, say, shown
from ial.errors import ConfigError, StreamError

if TYPE_CHECKING:
    from ial.bouncing.bump_timing import BumpTiming
    from ial.bouncing.filters.bounce_filter import BounceFilter
    from ial.bouncing.filters.piece_filter import PieceFilter
    from ial.bouncing.rays.piece_model import PieceSet
    from ial.bouncing.rays.real_robot import RealPose
    from ial.maps.polygons.environment import Environment
    from ial.maps.polygons.raster import Raster

_TIMES = "--speed, --turn-time, --clock-error, --speed-error"


def show(
    paths: Annotated[
        list[Path],
        typer.Argument(metavar="[FILTER] [ENV]...", help="A filter (.npz), the environments it was built from, or both, the filter first."),
    ],
    out: Annotated[Path, typer.Option(metavar="PNG", help="The picture to write.")],
    what: Annotated[
        Literal["cycles", "basins", "automaton", "sets"],
        typer.Option(
            help="The paths of localized robots, where each start leads, the states of a small filter, or what a stream leaves of a "
            "filter with --rays."
        ),
    ] = "cycles",
    stream: StreamBits = None,
    file: StreamFile = None,
    log: LogFile = None,
    speed: Speed = None,
    turn_time: TurnTime = None,
    clock_error: ClockError = None,
    speed_error: SpeedError = None,
    truth: Annotated[
        Path | None, typer.Option(metavar="CSV", help="With --what sets: where the robot was, as `ial bounce simulate` writes it.")
    ] = None,
    angle: Angle = "90",
    cell: Cell = None,
    headings: HeadingCount = None,
    radius: Radius = "0",
    step: StepLength = None,
    rule: FreeRule = "centre",
    corner: CornerPolicy = "segment",
    most_states: MostStates = 2**24,
    resolution: Resolution = None,
    simplify: Simplify = None,
    overwrite: Overwrite = False,
) -> None:
    """Draw a filter. A filter file says how it was built, so the options are for environments alone."""
    from ial.bouncing.cells.headings import Headings
    from ial.bouncing.filters.bounce_filter import BounceFilter
    from ial.bouncing.filters.building import all_free_cells, build_filter
    from ial.bouncing.filters.filter_file import read_filter
    from ial.bouncing.filters.piece_filter import PieceFilter
    from ial.bouncing.stream_file import read_truth
    from ial.cli.bounce.surroundings import Surroundings

    read_too = [each for each in (file, log, truth) if each is not None]
    check_outputs([out], [*paths, *read_too], overwrite)
    if out.suffix.lower() != ".png":
        raise ConfigError(f"{out}: the picture is a PNG; give a name that ends in .png")
    if late := next((path for path in paths[1:] if path.suffix == ".npz"), None):
        raise ConfigError(f"{late}: a filter comes first, and its environments after it: {late.name} ENV …")
    times = speed, turn_time, clock_error, speed_error
    if what == "sets":
        if sum(each is not None for each in (stream, file, log)) != 1:
            raise StreamError("--what sets shows what observations leave; give them as one of --stream BITS, --file FILE and --log FILE")
        if paths[0].suffix != ".npz":
            raise ConfigError(f"{paths[0]}: --what sets needs a filter; build one with --rays or an error, and give FILTER ENV")
        read = read_filter(paths[0])
        surroundings = Surroundings.read(paths[1:], resolution, simplify, read.radius_m if isinstance(read, PieceFilter) else Fraction(0))
        if not isinstance(read, PieceFilter):
            raise ConfigError("a filter of cells has no pieces of walls; build one with --rays or an error")
        poses = None if truth is None else read_truth(truth)
        if log is not None:
            sets = sets_of_log(read, log, timing(speed, turn_time, clock_error, speed_error))
        else:
            if any(given is not None for given in times):
                raise StreamError(f"{_TIMES} are for a --log with times; leave them out")
            observed = observations(stream, file)
            if poses is not None and [pose.observation for pose in poses] != observed:
                raise StreamError("the true poses are those of other observations; give the stream and the truth of one run")
            sets = read.after_bumps(observed)
        _draw_sets(out, read, surroundings.environments, sets, poses)
        for line in surroundings.lines():
            say(line)
        say(f"picture in {shown(out)}")
        return
    if stream is not None or read_too or any(given is not None for given in times):
        raise ConfigError(f"--stream, --file, --log, {_TIMES} and --truth are for --what sets; leave them out")
    if paths[0].suffix == ".npz":
        read = read_filter(paths[0])
        if not isinstance(read, BounceFilter):
            raise ConfigError(
                f"{paths[0]}: the filter of a robot with errors has no cycles and no basins; give one without errors, or --what sets"
            )
        made = read
        surroundings = Surroundings.read(paths[1:], resolution, simplify, made.setting.radius)
        rasters = _walls(made, surroundings.environments)
    else:
        surroundings = Surroundings.read(paths, resolution, simplify, number(radius, "--radius"))
        loaded = surroundings.environments
        width = cell_width(loaded, cell)
        robot = Headings.of_angle(number(angle, "--angle"), headings, step_cells(step, loaded, width))
        with counting("states") as progress:
            made = build_filter(loaded, robot, width, number(radius, "--radius"), rule, corner, most_states, progress=progress)
        rasters = all_free_cells(loaded, width, number(radius, "--radius"), rule)
    if what == "basins" and not rasters:
        raise ConfigError(f"{paths[0]}: a filter holds no basins; give the environments after it: {paths[0].name} ENV …")
    _draw(out, made, rasters, what)
    for line in surroundings.lines():
        say(line)
    say(f"picture in {shown(out)}")


def sets_of_log(made: "PieceFilter", log: Path, times: "BumpTiming") -> "list[PieceSet]":
    """Return what is left after each bump of the one robot of a log."""
    from ial.bouncing.filters.bump_tracker import BumpTracker, legs_of
    from ial.cli.bounce.log_run import log_events

    tracker, sets, robots = BumpTracker(legs_of(made, times)), [], set()
    with log_events(log) as events:
        for event in events:
            robots.add(event.robot)
            if len(robots) > 1:
                raise StreamError(f"{event.where}: the log is of several robots, {' and '.join(sorted(robots))}; give the lines of one")
            tracker.take(event)
            if event.kind == "bump":
                sets.append(tracker.states)
    return sets


def _draw_sets(
    out: Path, made: "PieceFilter", loaded: "dict[str, Environment]", sets: "list[PieceSet]", truth: "list[RealPose] | None"
) -> None:
    """Draw what bumps leave of a filter of pieces of walls."""
    from ial.results.bouncing.set_picture import draw_sets

    if len(loaded) != 1:
        raise ConfigError("a filter holds no polygons; give the one environment it was built from after it: FILTER ENV")
    (environment,) = loaded.values()
    _check_built_from(made, environment)
    draw_sets(out, made, environment, sets, truth)


def _check_built_from(made: "PieceFilter", environment: "Environment") -> None:
    from ial.maps.polygons.walls import Walls

    walls, known = Walls.of(environment, made.radius_m), made.map.walls
    same = all(getattr(walls, name).tobytes() == getattr(known, name).tobytes() for name in ("x", "y", "after", "bulge", "tilt"))
    if not same or walls.origin != known.origin:
        raise ConfigError(
            f"{made.name}: the environment is not the one the filter was built from; give --resolution and --simplify as then"
        )


def _walls(made: "BounceFilter", loaded: "dict[str, Environment]") -> "dict[str, Raster]":
    """Return the free cells of the environments a filter was built from; none if no environment is given."""
    from ial.bouncing.filters.building import all_free_cells

    if not loaded:
        return {}
    setting, places = made.setting, made.places
    names = ", ".join(setting.names)
    if sorted(loaded) != sorted(setting.names):
        raise ConfigError(f"the filter is one of {names}, not of {', '.join(loaded)}; give the environments it was built from")
    rasters = all_free_cells({name: loaded[name] for name in setting.names}, setting.cell, setting.radius, setting.rule)
    for index, (name, corner) in enumerate(zip(setting.names, setting.corners, strict=True)):
        raster, held = rasters[name], places.environment == index
        rows, columns = places.row[held], places.column[held]
        fits = (raster.x, raster.y) == corner and bool((rows < raster.free.shape[0]).all() and (columns < raster.free.shape[1]).all())
        if not fits or not raster.free[rows, columns].all():
            raise ConfigError(f"{name}: the environment is not the one the filter was built from; give --resolution and --simplify as then")
    return rasters


def _draw(out: Path, made: "BounceFilter", rasters: "dict[str, Raster]", what: str) -> None:
    from ial.bouncing.cells.cell_map import CellMap
    from ial.results.bouncing.automaton_picture import draw_automaton
    from ial.results.bouncing.basin_picture import draw_basins
    from ial.results.bouncing.cycle_picture import draw_cycles
    from ial.results.bouncing.ground import BounceGround

    setting, places = made.setting, made.places
    grounds = [BounceGround(name, raster) for name, raster in rasters.items()]
    if what == "automaton":
        draw_automaton(out, made.table, ", ".join(setting.names))
    elif what == "basins":
        maps = [CellMap(raster, setting.headings, setting.corner, setting.merged) for raster in rasters.values()]
        draw_basins(out, maps, grounds)
    else:
        cells = [(places.row[held], places.column[held]) for held in (places.environment == index for index in range(len(setting.names)))]
        draw_cycles(out, made, grounds or BounceGround.of_setting(setting, cells))
