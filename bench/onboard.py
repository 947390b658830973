"""`ial stream` for a very long time on one core: memory and latency."""

import json
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
from report import Report, options

from ial.datasets.opening import open_recording
from ial.datasets.scan_stream import odometry_line, scan_line

ABOUT = """\
`ial stream` on one core and one thread, fed through a pipe as fast as it answers. The recording is played over and over; clock and scan
numbers go on, and at each turn the odometry jumps from the end to the beginning. *Latency*: from a scan in the pipe to its line. *Memory*:
resident, at the first hundredth and at the end, and the peak as the system counts it."""
LOG, MAP = "freiburg_079/freiburg-079-corrected.log.gz", "freiburg_079/map_even.yaml"
COMMAND = [sys.executable, "-c", "from ial.cli.entry import main; main()", "stream"]


def lines(count: int) -> Iterator[tuple[str, str]]:
    """Yield odometry and scan of a recording again and again."""
    readings = list(open_recording(Path(os.environ["IAL_DATA"]) / LOG).readings())
    period = readings[-1].stamp_ns - readings[0].stamp_ns + 200_000_000
    for number in range(count):
        turn, at = divmod(number, len(readings))
        reading = readings[at]
        stamp = reading.stamp_ns + turn * period
        scan = replace(reading.scan, stamp_ns=stamp)
        yield odometry_line(stamp, reading.odometry), scan_line(scan)


def start(*arguments: object) -> "subprocess.Popen[bytes]":
    """Start a stream on one core."""
    core = {max(os.sched_getaffinity(0))}
    return subprocess.Popen(
        [*COMMAND, "--map", str(Path(os.environ["IAL_DATA"]) / MAP), *map(str, arguments)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        preexec_fn=lambda: os.sched_setaffinity(0, core),
    )


def memory(process: int) -> dict[str, float]:
    """Return the resident memory of a process and its peak, in MB."""
    rows = dict(line.split(":", 1) for line in Path(f"/proc/{process}/status").read_text().splitlines())
    return {name: int(rows[name].split()[0]) / 1024.0 for name in ("VmRSS", "VmHWM")}


def endurance(updates: int, deadline: float, state: Path) -> Iterator[str]:
    """Yield the cells of one line."""
    running = start("--deadline", deadline, "--state", state)
    assert running.stdin is not None
    assert running.stdout is not None
    latencies, statuses, resident = [], [], []
    for number, (odometry, scan) in enumerate(lines(updates)):
        running.stdin.write(f"{odometry}\n{scan}\n".encode())
        begun = time.perf_counter()
        running.stdin.flush()
        answer = json.loads(running.stdout.readline())
        latencies.append(time.perf_counter() - begun)
        statuses.append(answer["status"])
        assert answer["index"] == number
        if number % max(1, updates // 100) == updates // 100 - 1:
            resident.append(memory(running.pid)["VmRSS"])
    peak = memory(running.pid)["VmHWM"]
    running.stdin.close()
    running.stdout.close()
    assert running.wait() == 0
    median, p99, most = (1e3 * np.quantile(latencies[1:], [0.5, 0.99, 1.0])).tolist()
    yield f"{updates:,}"
    yield f"{1e3 * deadline:.0f}"
    yield f"{resident[0]:.0f}, {resident[-1]:.0f}"
    yield f"{peak:.0f}"
    yield f"{median:.1f}, {p99:.1f}, {most:.1f}"
    yield f"{np.mean(np.array(latencies[1:]) > deadline):.5f}"
    yield f"{statuses.count('localized') / updates:.4f}"


def main() -> None:
    """Measure, print, and write."""
    parser = options(__doc__ or "")
    parser.add_argument("--updates", type=int, default=100_000)
    chosen = parser.parse_args()
    report = Report("Onboard", ABOUT)
    with tempfile.TemporaryDirectory() as folder:
        head = "updates|deadline, ms|memory, MB: first, last|peak|latency, ms: median, 99 %, most|share beyond the deadline|localized"
        report.table(head.split("|"), [endurance(chosen.updates, 0.1, Path(folder) / "state")])
    report.write(chosen.out)


if __name__ == "__main__":
    main()
