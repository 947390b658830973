"""What `ial bounce run` says about a stream."""

from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from typing import Any

from ial.bouncing.filters.bounce_filter import BounceFilter
from ial.bouncing.filters.robust_filter import RobustFilter


def outcome(made: BounceFilter | RobustFilter, states: Sequence[int]) -> dict[str, Any]:
    """Return what the states after the observations of a stream tell, as plain values that JSON can hold; observations count from 1."""
    table = made.table
    path = [0, *states]
    rejected = [at for at, (before, now) in enumerate(pairwise(path), 1) if now == table.trap and before != table.trap]
    first = next((at for at, each in enumerate(path) if table.is_localized(each)), None)
    return told(made, path[-1], {"observations": len(states)}, rejected, first)


def told(
    made: BounceFilter | RobustFilter, state: int, count: Mapping[str, int], rejected: Sequence[int], first: int | None
) -> dict[str, Any]:
    """Return what a state tells, after so many observations or bumps, of which some were rejected and one was the first to localize."""
    table = made.table
    return {
        **count,
        "state": state,
        "colour": int(table.colours[state]),
        "rejected_at": list(rejected),
        "localized_at": first,
        "localized": table.is_localized(state),
        "room": made.room(state) if isinstance(made, RobustFilter) else None,
        "configurations": int(table.uncertainty[state]),
        "environments": [made.setting.names[number] for number in table.possible(state)],
        "places": [
            {
                "environment": place.environment,
                "x_m": float(place.x_m),
                "y_m": float(place.y_m),
                "headings_deg": [float(each) for each in place.headings_deg],
            }
            for place in made.where(state)
        ],
    }


def lines(record: Mapping[str, Any], most: int, unit: str = "observation") -> Iterator[str]:
    """Yield the lines to print, with so many places at most; the unit is what the record counts."""
    for at in record["rejected_at"]:
        yield f"rejected at {unit} {at}: no place in the environments fits; the robot is elsewhere, was carried, or erred"
    places = record["places"]
    if record["localized_at"] is not None and not record["localized"]:
        yield f"localized at {unit} {record['localized_at']}, and no longer"
    count = record[f"{unit}s"]
    yield f"after {count} {unit}{'s' * (count != 1)}: {knowledge(record)}"
    for place in places[:most]:
        yield f"  {place['environment']}: x {place['x_m']:g} m, y {place['y_m']:g} m, heading {_heading(place['headings_deg'])}"
    if len(places) > most:
        yield f"  and {len(places) - most} more; --json lists all"


def knowledge(record: Mapping[str, Any]) -> str:
    """Return in a few words what is known about the place."""
    count = record["configurations"]
    if not count:
        return "in none of the environments"
    known = f"localized in {record['room']}" if record["room"] else f"localized (colour {record['colour']})"
    if not record["localized"]:
        known = "not localized yet" if record["localized_at"] is None else "not localized"
    return f"{known}, {count} configuration{'s' * (count != 1)} in {', '.join(record['environments'])}"


def _heading(angles: Sequence[float]) -> str:
    """Return headings in words; several begin after the widest gap, since they may lie on both sides of 0°."""
    if len(angles) == 1:
        return f"{angles[0]:g}°"
    gaps = [(now - before) % 360.0 for before, now in zip([angles[-1], *angles], angles, strict=False)]
    first = gaps.index(max(gaps))
    return f"one of {len(angles)}, {angles[first]:g}° to {angles[first - 1]:g}°"
