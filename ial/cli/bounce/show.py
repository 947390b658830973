"""`ial bounce show`: pictures of knowledge cycles, of basins, of the automaton, and of what is left after bumps."""

from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from ial.cli.bounce.observed import StreamBits, StreamFile, observations
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
    from ial.bouncing.filters.bounce_filter import BounceFilter
    from ial.bouncing.filters.filter_file import Filter
    from ial.bouncing.filters.piece_filter import PieceFilter
    from ial.maps.polygons.environment import Environment
    from ial.maps.polygons.raster import Raster


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
    from ial.cli.bounce.surroundings import Surroundings

    read_too = [each for each in (file, truth) if each is not None]
    check_outputs([out], [*paths, *read_too], overwrite)
    if out.suffix.lower() != ".png":
        raise ConfigError(f"{out}: the picture is a PNG; give a name that ends in .png")
    if late := next((path for path in paths[1:] if path.suffix == ".npz"), None):
        raise ConfigError(f"{late}: a filter comes first, and its environments after it: {late.name} ENV …")
    if what == "sets":
        if (stream is None) == (file is None):
            raise StreamError("--what sets shows what observations leave; give them as one of --stream BITS and --file FILE")
        if paths[0].suffix != ".npz":
            raise ConfigError(f"{paths[0]}: --what sets needs a filter; build one with --rays or an error, and give FILTER ENV")
        read = read_filter(paths[0])
        surroundings = Surroundings.read(paths[1:], resolution, simplify, read.radius_m if isinstance(read, PieceFilter) else Fraction(0))
        _draw_sets(out, read, surroundings.environments, stream, file, truth)
        for line in surroundings.lines():
            say(line)
        say(f"picture in {shown(out)}")
        return
    if stream is not None or read_too:
        raise ConfigError("--stream, --file and --truth are for --what sets; leave them out")
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


def _draw_sets(
    out: Path, made: "Filter", loaded: "dict[str, Environment]", stream: str | None, file: Path | None, truth: Path | None
) -> None:
    """Draw what a stream leaves of a filter of pieces of walls."""
    from ial.bouncing.filters.piece_filter import PieceFilter
    from ial.bouncing.stream_file import read_truth
    from ial.results.bouncing.set_picture import draw_sets

    if not isinstance(made, PieceFilter):
        raise ConfigError("a filter of cells has no pieces of walls; build one with --rays or an error")
    if len(loaded) != 1:
        raise ConfigError("a filter holds no polygons; give the one environment it was built from after it: FILTER ENV")
    (environment,) = loaded.values()
    _check_built_from(made, environment)
    draw_sets(out, made, environment, observations(stream, file), None if truth is None else read_truth(truth))


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
