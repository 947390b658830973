"""`ial bounce search-angle`: the bouncing angle, or the sequence of angles, that localizes best."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ial.cli.bounce.options import (
    Cell,
    CornerPolicy,
    EnvironmentPaths,
    FreeRule,
    MostStates,
    Radius,
    Resolution,
    Simplify,
    StepLength,
    cell_width,
    number,
    step_cells,
)
from ial.cli.shell.options import Json
from ial.cli.shell.terminal import out, say, say_json

if TYPE_CHECKING:
    from ial.bouncing.planning.angle_search import AngleSequence

_MOST_ROWS = 10  # of the sequences; single angles are all shown


def search_angle(
    environments: EnvironmentPaths,
    headings: Annotated[int, typer.Option(metavar="N", help="How many headings; angles are multiples of 360° / N.")] = 8,
    angle: Annotated[list[str] | None, typer.Option(metavar="DEGREES", help="An angle to choose from; repeated, all if left out.")] = None,
    sequence: Annotated[int, typer.Option(min=1, metavar="N", help="Try sequences of up to N angles, changed when localized.")] = 1,
    cell: Cell = None,
    radius: Radius = "0",
    step: StepLength = None,
    rule: FreeRule = "centre",
    corner: CornerPolicy = "segment",
    most_states: MostStates = 2**24,
    resolution: Resolution = None,
    simplify: Simplify = None,
    as_json: Json = False,
) -> None:
    """Find the bouncing angle that localizes best: least uncertainty at worst, then on average, then fewest angles and observations."""
    from ial.bouncing.filters.building import all_free_cells
    from ial.bouncing.planning.angle_search import search_angles
    from ial.cli.bounce.surroundings import Surroundings

    surroundings = Surroundings.read(environments, resolution, simplify, number(radius, "--radius"))
    loaded = surroundings.environments
    width = cell_width(loaded, cell)
    rasters = all_free_cells(loaded, width, number(radius, "--radius"), rule)
    chosen = None if angle is None else [number(each, "--angle") for each in angle]
    moved = step_cells(step, loaded, width)
    outcomes = search_angles(list(rasters.values()), headings, moved, corner, chosen, sequence, most_states)
    if as_json:
        record = {"environments": list(loaded), "headings": headings, "simplified": surroundings.record()}
        say_json({**record, "best": _record(outcomes[0]), "sequences": [*map(_record, outcomes)]})
        return
    for line in surroundings.lines():
        say(line)
    configurations = headings * sum(int(each.free.sum()) for each in rasters.values())
    cells_m = float(next(iter(rasters.values())).cell)
    say(f"{', '.join(loaded)}: {configurations} configurations, {headings} headings, cells of {cells_m:g} m")
    _print_angles([each for each in outcomes if len(each.angles_deg) == 1])
    longer = [each for each in outcomes if len(each.angles_deg) > 1]
    if longer:
        say()
        _print_sequences(longer)
    elif sequence > 1:
        say("no longer sequence was tried: one angle leaves no robot uncertain")
    best = outcomes[0]
    say()
    say(
        f"best: {_angles(best)}; a robot ends in {best.worst} configuration{'s' * (best.worst != 1)} at worst, {float(best.mean):.4g} on "
        f"average, after at most {best.observations} observations"
    )


def _print_angles(rows: Sequence["AngleSequence"]) -> None:
    from rich.table import Table

    table = Table("angle", box=None, pad_edge=False, header_style="bold")
    for name in ("states", "cycles", "least", "mean", "worst", "depth"):
        table.add_column(name, justify="right")
    for row in rows:
        table.add_row(_angles(row), str(row.states), str(row.cycles), *_uncertainty(row), str(row.observations))
    out.print(table)


def _print_sequences(rows: Sequence["AngleSequence"]) -> None:
    from rich.table import Table

    table = Table("sequence", box=None, pad_edge=False, header_style="bold")
    for name in ("ends", "least", "mean", "worst", "depth"):
        table.add_column(name, justify="right")
    for row in rows[:_MOST_ROWS]:
        table.add_row(_angles(row), str(row.ends), *_uncertainty(row), str(row.observations))
    out.print(table)
    if len(rows) > _MOST_ROWS:
        say(f"and {len(rows) - _MOST_ROWS} more; --json lists all")


def _uncertainty(row: "AngleSequence") -> tuple[str, str, str]:
    return str(row.least), f"{float(row.mean):.4g}", str(row.worst)


def _angles(row: "AngleSequence") -> str:
    return ", then ".join(f"{float(each):g}°" for each in row.angles_deg)


def _record(row: "AngleSequence") -> dict[str, Any]:
    """Return plain values that JSON can hold."""
    return {
        "angles_deg": [float(each) for each in row.angles_deg],
        "states": row.states,
        "knowledge_cycles": row.cycles,
        "ends": row.ends,
        "least_configurations": row.least,
        "mean_configurations": float(row.mean),
        "worst_configurations": row.worst,
        "observations": row.observations,
    }
