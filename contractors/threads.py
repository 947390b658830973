"""Sharing the rows of a batch among threads.

A kernel that works on rows ``start … stop`` runs without Python's lock, so plain threads use all cores. Compared with Numba's own parallel
loops this needs no threading layer, may be called from several Python threads at once, survives a fork, and compiles each kernel once.
Rows are independent and each is written by one thread, so the result never depends on the number of threads.
"""

import itertools
import os
from collections import deque
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

from ial.contractors.rounding import check_rounding
from ial.errors import ConfigError

_MINIMUM_ROWS = 256  # below this a second thread costs more than it brings
_CHUNKS_PER_THREAD = 8  # rows differ in cost: small chunks even that out

_threads: int | None = None
_pool: ThreadPoolExecutor | None = None


def available_threads() -> int:
    """Return the number of cores this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def get_threads() -> int:
    """Return the number of threads that kernels use: what `set_threads` said, else ``$IAL_THREADS``, else all cores."""
    if _threads is not None:
        return _threads
    text = os.environ.get("IAL_THREADS")
    if text is None:
        return available_threads()
    if not text.isdigit() or int(text) < 1:
        raise ConfigError(f"IAL_THREADS is {text!r}; give a whole number of at least 1, or unset it")
    return int(text)


def set_threads(count: int | None) -> None:
    """Use `count` threads from now on, in the whole process; None returns to the default."""
    global _threads
    if count is not None and count < 1:
        raise ConfigError(f"the number of threads is {count}; give at least 1")
    _threads = count


def _executor(threads: int) -> ThreadPoolExecutor:
    global _pool
    if _pool is None or _pool._max_workers < threads:
        _pool = ThreadPoolExecutor(threads, thread_name_prefix="ial")
    return _pool


def _forget_pool() -> None:
    global _pool
    _pool = None  # the threads of a forked process's parent do not exist in the child


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_forget_pool)


def run(kernel: Callable[..., Any], rows: int, *arguments: Any, minimum: int = _MINIMUM_ROWS) -> None:
    """Call ``kernel(start, stop, *arguments)`` so that all rows ``0 … rows`` are covered exactly once.

    Parameters
    ----------
    kernel
        A compiled kernel that reads and writes only the rows it is given.
    rows
        The number of rows.
    minimum
        The smallest number of rows worth a thread of its own.

    Raises
    ------
    RoundingModeError
        If a thread that runs the kernel does not round to nearest.
    """
    threads = min(get_threads(), max(1, rows // minimum))
    if threads == 1:
        check_rounding()
        kernel(0, rows, *arguments)
        return
    chunks = min(threads * _CHUNKS_PER_THREAD, rows // minimum)
    waiting = deque(itertools.pairwise(rows * i // chunks for i in range(chunks + 1)))

    def share() -> None:
        """Take chunks, one after the other, until none waits: waking a thread for each would cost more than a chunk."""
        check_rounding()
        while waiting:
            try:
                start, stop = waiting.popleft()
            except IndexError:  # another thread has taken the last one
                return
            kernel(start, stop, *arguments)

    others = [_executor(threads).submit(share) for _ in range(threads - 1)]
    try:
        share()
    finally:
        waiting.clear()
        for other in others:
            other.result()
