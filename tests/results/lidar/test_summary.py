import json
from collections.abc import Callable
from typing import Any

import pytest

from ial.datasets.in_memory import InMemoryRecording
from ial.datasets.odometry import Odometry
from ial.datasets.recording import Reading
from ial.lidar.configuration.config import LocalizerConfig
from ial.maps.grids.occupancy_grid import OccupancyGrid
from ial.results.lidar.summary import Summary

BOX = [(1.0, 1.2), (3.0, 3.2), (0.1, 0.2)]
FAR = [(4.0, 4.2), (3.0, 3.2), (0.1, 0.2)]


@pytest.fixture
def summary(estimate_of: Callable[..., Any], grid: OccupancyGrid) -> Summary:
    run = [
        estimate_of(1, BOX, FAR, elapsed_s=0.4),
        estimate_of(3, BOX, status="localized", elapsed_s=0.1, vanishing=True),
        estimate_of(5, BOX, FAR, status="lost", limited="boxes", elapsed_s=0.2),
        estimate_of(7, BOX, uninformative=True, elapsed_s=0.1),
    ]
    recording = InMemoryRecording("made up", [Reading(step.index, step.stamp_ns, Odometry(0.0, 0.0), step.scan) for step, _ in run])
    recording.skipped["no odometry"] = 3
    content = Summary(recording, grid, LocalizerConfig(), {"every": 2})
    for step, estimate in run:
        content.add(step, estimate)
    return content


def test_counts(summary: Summary) -> None:
    assert summary.as_dict()["scans"] == {
        "processed": 4,
        "by_status": {"ambiguous": 2, "localized": 1, "lost": 1},
        "one_hypothesis": 2,
        "uninformative": 1,
        "vanishing": 1,
        "limited": {"boxes": 1},
        "lidars_without_scans": [],
        "skipped": {"no odometry": 3},
        "repaired": {},
    }


def test_where_it_was_localized_and_where_it_ended(summary: Summary) -> None:
    record = summary.as_dict()
    assert (record["localized"], record["first_localized_scan"], summary.localized) == (True, 3, True)
    assert (record["last"]["index"], record["last"]["status"], record["last"]["pose"]) == (7, "ambiguous", None)


def test_times(summary: Summary) -> None:
    times = summary.as_dict()["times"]
    assert (times["median_s"], times["max_s"]) == (pytest.approx(0.15), 0.4)
    assert (times["total_s"], times["scans_per_s"]) == (pytest.approx(0.8), pytest.approx(5.0))
    assert times["wall_s"] > 0.0


def test_everything_is_plain_json(summary: Summary) -> None:
    record = summary.as_dict({"contained": None})
    assert json.loads(json.dumps(record, allow_nan=False)) == record
    assert record["measures"] == {"contained": None}
    assert record["config"]["max_beams"] == LocalizerConfig().max_beams
    assert record["options"] == {"every": 2}
    assert record["map"]["columns"] == 80
    assert record["recording"]["beams"] == [3]
    assert record["recording"]["lidars"]["laser"]["upside_down"] is True
    assert record["versions"]["numba"]


def test_a_run_without_a_scan(grid: OccupancyGrid, summary: Summary) -> None:
    empty = Summary(summary._recording, grid, LocalizerConfig(), {})
    record = json.loads(json.dumps(empty.as_dict(), allow_nan=False))
    assert (record["localized"], record["last"], record["times"]["median_s"]) == (False, None, None)
