"""What stops a search early."""

import time
from typing import Literal

Limit = Literal["", "boxes", "time", "memory"]


class Deadline:
    """A limit on time, and portions of work that keep to it.

    Parameters
    ----------
    seconds
        How long from now; None for ever.
    first
        How many rows the first portion has, while it is not known how long one takes.
    """

    def __init__(self, seconds: float | None, first: int = 256) -> None:
        self._first = first
        self._begun = self._last = time.monotonic()
        self._end = None if seconds is None else self._begun + seconds
        self._per_row = 0.0

    @property
    def elapsed_s(self) -> float:
        """Seconds since the beginning."""
        return time.monotonic() - self._begun

    @property
    def left_s(self) -> float | None:
        """Seconds until the end, 0 after it; None for ever."""
        return None if self._end is None else max(0.0, self._end - time.monotonic())

    def part(self, share: float) -> "Deadline":
        """Return a deadline that leaves a share of the time that is left."""
        left = self.left_s
        return Deadline(None if left is None else share * left, self._first)

    def portion(self, rows: int) -> int:
        """Return how many of some rows to work on next; 0 if the time is up.

        A portion is meant to take at most half of the time that is left, so the last ones are small.
        """
        if self._end is None:
            return rows
        self._last = time.monotonic()
        left = self._end - self._last
        if left <= 0.0:
            return 0
        wanted = 0.5 * left / self._per_row if self._per_row else self._first
        return max(1, int(min(wanted, rows)))

    def worked(self, rows: int) -> None:
        """Learn from a portion that has been worked on since `portion` was asked."""
        if self._end is not None:
            self._per_row = (time.monotonic() - self._last) / rows
