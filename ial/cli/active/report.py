"""What `ial explore` prints: decisions, and the end."""

from collections.abc import Iterator, Mapping
from typing import Any

from ial.cli.lidar.report import measured
from ial.results.active.leg import Leg
from ial.results.lidar.wording import pose_text

_MOST_PLACES = 12


def line_of(leg: Leg) -> str | None:
    """Return the line of a decision; None if it goes on with the one before and has changed nothing."""
    if leg.number and not leg.drives:
        return f"{leg.number:>4}  {leg.words}"
    decision, collided = leg.taken.decision, ", collided" * leg.taken.collided
    if decision is not None and decision.goes_on and leg.hypotheses == leg.before and not collided:
        return None
    return f"{leg.number:>4}  {leg.words}: {places(leg.hypotheses)}, {leg.estimate.status}{collided}"


def report(last: Leg, record: Mapping[str, Any]) -> Iterator[str]:
    """Yield the lines to print after a run.

    Parameters
    ----------
    last
        The last leg.
    record
        What ``summary.json`` holds.
    """
    ended = record["exploration"]
    after = f"after {ended['drives']} drive{'s' * (ended['drives'] != 1)}, {ended['way_m']:.2f} m"
    found, estimate = last.estimate.hypotheses, last.estimate
    decision = last.taken.decision
    if ended["ended_by"] == "localized" and estimate.pose is not None:
        yield f"localized {after}: {pose_text(estimate.pose, found[0])}"
        found = ()
    elif ended["ended_by"] == "symmetric":
        yield f"localized up to symmetry {after}: {places(len(found))}, which the map turned upon itself does not tell apart"
    elif decision is not None and ended["ended_by"] == "exhausted":
        yield f"{estimate.status} {after}, {places(len(found))}: {decision.reason}"
    else:
        yield f"gave up {after}: {estimate.status}, {places(len(found))}"
    for each in found[:_MOST_PLACES]:
        yield f"      {pose_text(each.centre, each)}"
    if len(found) > _MOST_PLACES:
        yield f"      and {len(found) - _MOST_PLACES} more"
    if ended["collisions"]:
        yield f"collided: {ended['collisions']} drive{'s' * (ended['collisions'] != 1)} ended early, where the robot touched something"
    scans = record["scans"]
    contradicted = sum(scans["by_status"].get(status, 0) for status in ("lost", "blind"))
    if contradicted:
        yield (
            f"doubtful: {contradicted} of {scans['processed']} scans contradict what was known before, so the map or a bound is wrong, and "
            "so may be all that is said above"
        )
    yield from measured(record["measures"])


def places(count: int) -> str:
    """Return how many places there are, in words."""
    return f"{count} place{'s' * (count != 1)}"
