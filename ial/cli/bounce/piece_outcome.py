"""What `ial bounce run` says about a stream of a robot with real geometry."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from ial.bouncing.filters.piece_filter import PieceFilter
from ial.bouncing.rays.piece_model import PieceSet


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
    return told(made, states, {"observations": count}, rejected, first)


def told(made: PieceFilter, states: PieceSet, count: Mapping[str, int], rejected: Sequence[int], first: int | None) -> dict[str, Any]:
    """Return what a set tells, after so many observations or bumps, of which some were rejected and one was the first to localize."""
    box = made.box(states)
    return {
        **count,
        "rejected_at": list(rejected),
        "localized_at": first,
        "localized": made.is_localized(states),
        "room": made.room(states),
        "environment": made.name if len(states) else None,
        "pieces": len(states) if box else None,
        "last_bump_m": None if box is None else dict(zip(("x0", "y0", "x1", "y1"), box, strict=True)),
    }


def lines(record: Mapping[str, Any], unit: str = "observation") -> Iterator[str]:
    """Yield the lines to print; the unit is what the record counts."""
    for at in record["rejected_at"]:
        yield f"rejected at {unit} {at}: no place in the environment fits; the robot is elsewhere, was carried, or erred more"
    if record["localized_at"] is not None and not record["localized"]:
        yield f"localized at {unit} {record['localized_at']}, and no longer"
    count, box = record[f"{unit}s"], record["last_bump_m"]
    yield f"after {count} {unit}{'s' * (count != 1)}: {knowledge(record)}"
    if box is not None:
        yield f"  the last bump was at x {box['x0']:.3f} to {box['x1']:.3f} m, y {box['y0']:.3f} to {box['y1']:.3f} m"


def knowledge(record: Mapping[str, Any]) -> str:
    """Return in a few words what is known about the place."""
    if record["environment"] is None:
        return "not in the environment"
    if record["last_bump_m"] is None:
        return "no bump yet"
    known = f"localized in {record['room']}" if record["room"] else "localized" if record["localized"] else "not localized"
    return f"{known}, {record['pieces']} pieces of walls in {record['environment']}"
