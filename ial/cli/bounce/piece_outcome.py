"""What `ial bounce run` says about a stream of a robot with real geometry."""

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from ial.bouncing.filters.piece_filter import PieceFilter


def outcome(made: PieceFilter, observations: Iterable[int], restart: bool) -> dict[str, Any]:
    """Return what a stream tells, as plain values that JSON can hold; observations count from 1."""
    model = made.model
    states = model.universe()
    rejected, first, count = [], None, 0
    for count, observation in enumerate(observations, 1):
        if model.empty(states):
            continue
        states = model.step(states, None, observation)
        if model.empty(states):
            rejected.append(count)
            model = made.anywhere if restart else model
            states = model.universe() if restart else states
        if first is None and made.is_localized(states):
            first = count
    box = made.box(states)
    return {
        "observations": count,
        "rejected_at": rejected,
        "localized_at": first,
        "localized": made.is_localized(states),
        "room": made.room(states),
        "environment": None if model.empty(states) else made.name,
        "pieces": len(states) if box else None,
        "last_bump_m": None if box is None else dict(zip(("x0", "y0", "x1", "y1"), box, strict=True)),
    }


def lines(record: Mapping[str, Any]) -> Iterator[str]:
    """Yield the lines to print."""
    for at in record["rejected_at"]:
        yield f"rejected at observation {at}: no place in the environment fits; the robot is elsewhere, was carried, or erred more"
    if record["localized_at"] is not None and not record["localized"]:
        yield f"localized at observation {record['localized_at']}, and no longer"
    told, box = f"after {record['observations']} observations:", record["last_bump_m"]
    if record["environment"] is None:
        yield f"{told} not in the environment"
    elif box is None:
        yield f"{told} no bump yet"
    else:
        known = f"localized in {record['room']}" if record["room"] else "localized" if record["localized"] else "not localized"
        place = f"x {box['x0']:.3f} to {box['x1']:.3f} m, y {box['y0']:.3f} to {box['y1']:.3f} m"
        yield f"{told} {known}, {record['pieces']} pieces of walls in {record['environment']}"
        yield f"  the last bump was at {place}"
