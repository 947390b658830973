"""`KnownRun`: what a robot reported after it had started at a known place."""

from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction

from ial.bouncing.bump_event import BumpEvent
from ial.bouncing.bump_timing import BumpTiming
from ial.errors import StreamError


@dataclass(frozen=True)
class KnownRun:
    """A run from a known start.

    Parameters
    ----------
    place
        Where it started: x and y in metres, and the heading in degrees.
    drives_s
        How long it drove before each bump, by its clock, in seconds.
    where
        The file and the line of the start, for messages.
    """

    place: tuple[Fraction, Fraction, Fraction]
    drives_s: tuple[Fraction, ...]
    where: str = "the log"


def known_runs(events: Iterable[BumpEvent], timing: BumpTiming) -> list[KnownRun]:
    """Return the runs of a log, of all its robots; a start ends what its robot did before it.

    Raises
    ------
    StreamError
        If a run begins at no known place, a bump has no time to turn before it, or no run has a bump.
    """
    runs: list[tuple[BumpEvent, list[Fraction]]] = []
    now: dict[str, tuple[BumpEvent, list[Fraction]]] = {}
    for event in events:
        if event.kind == "start":
            now[event.robot] = event, []
            runs.append(now[event.robot])
            if event.place is None:
                raise StreamError(f"{event.where}: a start at no known place; give x and y in metres and the heading in degrees")
        elif event.robot not in now:
            raise StreamError(
                f"{event.where}: a bump with no start before it; begin each run with a start whose x, y and heading are known"
            )
        else:
            before, drives = now[event.robot]
            drives.append(timing.drive_s(before, event))
            now[event.robot] = event, drives
    known = [KnownRun(start.place, tuple(drives), start.where) for start, drives in runs if start.place is not None and drives]
    if not known:
        raise StreamError("no start of the log has a bump after it; let the robot drive to a wall at least once")
    return known
