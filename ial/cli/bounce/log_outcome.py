"""What `ial bounce run --log` says about each robot of a log."""

from collections.abc import Iterator, Mapping
from typing import Any

from ial.bouncing.bump_event import BumpEvent
from ial.bouncing.filters.bump_tracker import BumpTracker
from ial.bouncing.filters.filter_file import Filter
from ial.bouncing.filters.piece_filter import PieceFilter
from ial.cli.bounce import outcome, piece_outcome


def record(made: Filter, robot: str, tracker: BumpTracker) -> dict[str, Any]:
    """Return what is known about a robot, as plain values that JSON can hold; bumps count from 1."""
    count = {"bumps": tracker.bumps}
    told = (
        piece_outcome.told(made, tracker.states, count, tracker.rejected_at, tracker.localized_at)
        if isinstance(made, PieceFilter)
        else outcome.told(made, tracker.states, count, tracker.rejected_at, tracker.localized_at)
    )
    times = {"time_s": tracker.last_s, "localized_at_s": tracker.localized_s}
    return {"robot": robot or None, **{name: None if each is None else float(each) for name, each in times.items()}, **told}


def lines(made: Filter, record: Mapping[str, Any], most: int) -> Iterator[str]:
    """Yield the lines to print at the end, with so many places at most."""
    said = piece_outcome.lines(record, "bump") if isinstance(made, PieceFilter) else outcome.lines(record, most, "bump")
    for line in said:
        yield _named(record, line)
    if record["localized_at_s"] is not None:
        yield _named(record, f"first localized at bump {record['localized_at']}, at {record['localized_at_s']:.3f} s")


def live_line(made: Filter, record: Mapping[str, Any], event: BumpEvent, rejected: bool) -> str:
    """Return the line to print when a bump has come."""
    known = piece_outcome.knowledge(record) if isinstance(made, PieceFilter) else outcome.knowledge(record)
    fault = "rejected; " * rejected
    return _named(record, f"{float(event.time_s):.3f} s, bump {record['bumps']}: {fault}{known}")


def _named(record: Mapping[str, Any], line: str) -> str:
    return line if record["robot"] is None else f"{record['robot']}: {line}"
