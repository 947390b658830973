"""The time of a piece of work, as every bench takes it."""

import time
from collections.abc import Callable
from typing import Any


def timed(work: Callable[..., Any], *arguments: Any, runs: int = 5, enough_s: float = 2.0) -> tuple[float, Any]:
    """Return the least time of several runs in seconds, and the result; there are fewer runs once they have taken long enough."""
    times: list[float] = []
    while len(times) < runs and sum(times) < enough_s:
        begun = time.perf_counter()
        result = work(*arguments)
        times.append(time.perf_counter() - begun)
    return min(times), result
