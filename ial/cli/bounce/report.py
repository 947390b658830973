"""What `ial bounce` says about a filter."""

import math
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from ial.bouncing.filters.bounce_filter import BounceFilter


def about(made: BounceFilter) -> dict[str, Any]:
    """Return what a filter is, as plain values that JSON can hold."""
    table, setting = made.table, made.setting
    first = [int(np.flatnonzero(table.colours == cycle + 2)[0]) for cycle in range(table.cycles)]
    return {
        "environments": list(setting.names),
        "cell_m": float(setting.cell),
        "bounce_deg": float(setting.headings.bounce_deg),
        "headings": setting.headings.count,
        "step_m": float(setting.headings.step * setting.cell),
        "offset_error_deg": setting.headings.offset_errors[0],
        "offset_error": setting.headings.offset_errors[1],
        "radius_m": float(setting.radius),
        "configurations": int(table.uncertainty[0]),
        "trapped": made.trapped,
        "states": len(table) - 1,
        "knowledge_cycles": [
            {
                "colour": cycle + 2,
                "states": int(np.count_nonzero(table.colours == cycle + 2)),
                "configurations": int(table.uncertainty[state]),
                "environments": [setting.names[number] for number in table.possible(state)],
            }
            for cycle, state in enumerate(first)
        ],
    }


def lines(record: Mapping[str, Any]) -> Iterator[str]:
    """Yield the lines to print."""
    cycles = record["knowledge_cycles"]
    sizes = sorted(each["configurations"] for each in cycles)
    yield (
        f"{', '.join(record['environments'])}: {record['configurations']} configurations, {record['headings']} headings, "
        f"cells of {record['cell_m']:g} m, bouncing angle {record['bounce_deg']:g}°"
    )
    yield f"{record['states']} states, {len(cycles)} knowledge cycle{'s' * (len(cycles) != 1)}"
    yield (
        f"a localized robot is in {sizes[0]} to {sizes[-1]} configurations"
        if sizes[0] < sizes[-1]
        else (f"a localized robot is in {sizes[0]} configuration{'s' * (sizes[0] != 1)}")
    )
    if aside := offsets_aside(record["offset_error_deg"], record["offset_error"]):
        yield f"steps of the cell map are not those of a robot: {aside}"
    if record["trapped"]:
        yield f"in {record['trapped']} configurations the robot is trapped: it can only turn on the spot"


def offsets_aside(angle_deg: float, length: float) -> str:
    """Return in words by how much steps of a cell map are beside real ones, rounded up; nothing if that is below 1° and 1 %."""
    if angle_deg < 1.0 and length < 0.01:
        return ""
    return f"up to {_up(angle_deg):g}° aside, lengths up to {_up(100.0 * length):g} % off"


def _up(value: float) -> float:
    """Return a number rounded up to tenths; what is a tenth but for its last bits stays one."""
    return math.ceil(round(10.0 * value, 6)) / 10.0
