from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from ial.datasets.in_memory import InMemoryRecording
from ial.datasets.odometry import Odometry
from ial.datasets.recording import Reading
from ial.datasets.scan import LaserScan
from ial.lidar.configuration.config import LocalizerConfig
from ial.pose import Pose
from ial.study import replay as module
from ial.study.replay import replay

TAKES_S = [0.5, 1.7, 0.1, 0.1]  # for each scan; they are recorded a second apart


class Clock:
    """A machine whose time passes only where it works or sleeps."""

    def __init__(self) -> None:
        self.now, self.config, self.took = 100.0, LocalizerConfig(), list(TAKES_S)

    def monotonic(self) -> float:
        return self.now

    def sleep(self, seconds: float) -> None:
        assert seconds >= 0.0
        self.now += seconds

    def update(self, motion: object, scan: object) -> Any:
        self.now += self.took.pop(0)
        return SimpleNamespace(limited="" if len(self.took) else "time")


def recording() -> InMemoryRecording:
    scans = [LaserScan(10**9 * (7 + i), np.ones(5, dtype=np.float32), -1.0, 0.5, range_max=4.0) for i in range(len(TAKES_S))]
    return InMemoryRecording("four seconds", [Reading(i, scan.stamp_ns, Odometry.of(Pose()), scan) for i, scan in enumerate(scans)])


@pytest.mark.parametrize(
    ("speed", "waits_s", "late", "takes_s"),
    [
        (1.0, [0.5, 1.7, 0.8, 0.1], 1, 3.1),  # the third waits 0.7 s for the second
        (2.0, [0.5, 1.7, 1.3, 0.9], 2, 2.4),
        (0.5, TAKES_S, 0, 6.1),
        (None, TAKES_S, 0, sum(TAKES_S)),  # as fast as it can: nothing waits, nothing sleeps
    ],
)
def test_waiting_for_the_scans_before_counts(
    monkeypatch: pytest.MonkeyPatch, speed: float | None, waits_s: list[float], late: int, takes_s: float
) -> None:
    clock = Clock()
    monkeypatch.setattr(module, "time", clock)
    waits: list[float] = []
    monkeypatch.setattr(module.Latencies, "add", lambda self, seconds: waits.append(seconds))
    report = replay(recording(), clock, speed)  # type: ignore[arg-type]
    assert (report.scans, report.recorded_s, report.late, report.limited) == (4, 3.0, late, 1)
    assert waits == pytest.approx(waits_s)
    assert clock.now == pytest.approx(100.0 + takes_s)
