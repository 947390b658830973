"""`LogRun`: the robots of a log, each followed through a filter, from a file, from standard input, or live."""

import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import BinaryIO

from ial.bouncing.bump_event import BumpEvent
from ial.bouncing.bump_log import bump_events
from ial.bouncing.bump_log_file import log_form
from ial.bouncing.bump_timing import BumpTiming
from ial.bouncing.filters.bump_tracker import BumpTracker, legs_of
from ial.bouncing.filters.filter_file import Filter
from ial.cli.bounce.log_outcome import live_line, record
from ial.cli.shell.ending import Ending
from ial.cli.shell.terminal import say, say_json_line
from ial.errors import StreamError


@dataclass
class LogRun:
    """One run through a log.

    Parameters
    ----------
    made
        The filter.
    timing
        How fast the robots drive, and how well their clocks tell.
    restart
        Whether to begin anew after a rejection.
    closed
        Whether a rejection is an error.
    until_localized
        Whether a robot is followed only until it is localized.
    robots
        What is known about each robot, by its name, in the order of their first events.
    """

    made: Filter
    timing: BumpTiming
    restart: bool = False
    closed: bool = False
    until_localized: bool = False
    robots: dict[str, BumpTracker] = field(default_factory=dict)

    def read(self, path: Path) -> None:
        """Take in a whole log.

        Raises
        ------
        IalError
            If it cannot be read or cannot be meant.
        """
        with log_events(path) as events:
            for _ in self._taken(events):
                pass

    def follow(self, path: Path, as_json: bool) -> None:
        """Take in a log that still grows, and print a line for each bump, until the process is asked to end or standard input does.

        Raises
        ------
        IalError
            If it cannot be read or cannot be meant.
        """
        with Ending() as ending, _opened(path) as file:
            lines = ending.lines(file) if _is_input(path) else ending.growing_lines(file, str(path))
            for event, rejected in self._taken(_events(lines, path)):
                if event.kind == "bump":
                    told = record(self.made, event.robot, self.robots[event.robot])
                    if as_json:
                        say_json_line(told)
                    else:
                        say(live_line(self.made, told, event, rejected))
                if self.until_localized and all(tracker.localized for tracker in self.robots.values()):
                    return

    def _taken(self, events: Iterable[BumpEvent]) -> Iterator[tuple[BumpEvent, bool]]:
        """Take in events; yield each, and whether it was rejected."""
        legs = legs_of(self.made, self.timing)
        for event in events:
            tracker = self.robots.setdefault(event.robot, BumpTracker(legs, self.restart))
            if self.until_localized and tracker.localized:
                continue
            rejected = tracker.take(event)
            if rejected and self.closed:
                raise StreamError(
                    f"{event.where}: bump {tracker.bumps} fits no place of the environment, but the world is closed; check the map, the "
                    "bouncing angle, the speed and the bounds of errors, or use the open world"
                )
            yield event, rejected


@contextmanager
def log_events(path: Path) -> Iterator[Iterator[BumpEvent]]:
    """Lend the events of a whole log: a file, or standard input if it is called ``-``.

    Raises
    ------
    StreamError
        If it cannot be read or cannot be meant.
    """
    with _opened(path) as file:
        yield _events(file, path)


def _is_input(path: Path) -> bool:
    return str(path) == "-"


def _opened(path: Path) -> BinaryIO:
    if _is_input(path):
        return sys.stdin.buffer
    try:
        return path.open("rb")
    except OSError as error:
        raise StreamError(f"{path}: the log cannot be read ({error.strerror or error}); check the path") from None


def _events(lines: Iterable[bytes], path: Path) -> Iterator[BumpEvent]:
    return bump_events(lines, "standard input", None) if _is_input(path) else bump_events(lines, str(path), log_form(path))
