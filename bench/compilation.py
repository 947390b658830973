"""What compilation costs: which kernels a job compiles, and how long each takes without those that it calls.

``python bench/compilation.py`` prints a table for each of the jobs, each in a process of its own with no compiled kernel kept.
"""

import contextlib
import os
import subprocess
import sys
import tempfile
import time
from collections import defaultdict
from pathlib import Path
from typing import Any

from numba.core.event import Event, Listener, register

JOBS = {
    "localize": "from ial.cli.entry import main; import sys; sys.argv = ['ial', 'localize', '--out', 'out']; main()",
    "contract": (
        "from ial.contractors import Boxes, Interval, variables\n"
        "x, y = variables('x y')\n"
        "print((x**2 + y**2 == Interval(1, 2)).contract(Boxes.of([(-3, 3), (-3, 3)])))"
    ),
    "power": "from ial.contractors import Interval; print(Interval(1.0, 2.0) ** 3)",
    "clusters": "from ial.contractors import Boxes, cluster; print(len(cluster(Boxes.of([(0, 1), (0, 1), (0, 1)]), circular=[2])))",
}
SHOWN = 25


class Stopwatch(Listener):
    """The time that each function takes to compile, without what it calls; Numba compiles a callee while it works on the caller."""

    def __init__(self) -> None:
        self.seconds: dict[str, float] = defaultdict(float)
        self.counts: dict[str, int] = defaultdict(int)
        self.kinds: dict[str, set[str]] = defaultdict(set)
        self._begun: list[list[Any]] = []

    def on_start(self, event: Event) -> None:
        """Begin with a function."""
        self._begun.append([time.process_time(), 0.0])

    def on_end(self, event: Event) -> None:
        """End it, and take its time from that of its caller."""
        begun, inner = self._begun.pop()
        spent = time.process_time() - begun
        if self._begun:
            self._begun[-1][1] += spent
        function = event.data["dispatcher"].py_func
        name = f"{function.__module__}.{function.__qualname__}"
        self.seconds[name] += spent - inner
        self.counts[name] += 1
        self.kinds[name].add(str(event.data["args"]))


def measure(job: str) -> None:
    """Run a job in this process and print what it compiled."""
    stopwatch = Stopwatch()
    register("numba:compile", stopwatch)
    wall = time.perf_counter()
    with contextlib.suppress(SystemExit):
        exec(JOBS[job])
    wall = time.perf_counter() - wall
    total = time.process_time()
    compiling = sum(stopwatch.seconds.values())
    count = sum(stopwatch.counts.values())
    print(f"{job}: {total:.1f} s of CPU, {wall:.1f} s; {count} compilations of {len(stopwatch.counts)} functions took {compiling:.1f} s")
    for name in sorted(stopwatch.seconds, key=stopwatch.seconds.__getitem__, reverse=True)[:SHOWN]:
        print(f"  {stopwatch.seconds[name]:6.2f} s  {stopwatch.counts[name]:2d} x  {name}")


def main() -> None:
    """Measure every job, or those named."""
    if os.environ.get("MEASURED_JOB"):
        measure(os.environ["MEASURED_JOB"])
        return
    for job in sys.argv[1:] or JOBS:
        with tempfile.TemporaryDirectory() as folder:
            environment = {**os.environ, "MEASURED_JOB": job, "IAL_CACHE_DIR": folder}
            subprocess.run([sys.executable, Path(__file__).resolve()], env=environment, cwd=folder, check=True)


if __name__ == "__main__":
    main()
