import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from ial.results.lidar.events import EventsFile

BOX = [(1.0, 1.2), (3.0, 3.2), (0.1, 0.2)]


def events(path: Path, run: list[Any]) -> list[dict[str, Any]]:
    with EventsFile(path) as file:
        for step, estimate in run:
            file.add(step, estimate)
    return [json.loads(line) for line in path.read_text().splitlines()]


def test_rejections_and_recovery(estimate_of: Callable[..., Any], tmp_path: Path) -> None:
    statuses = ["ambiguous", "localized", "localized", "blind", "lost", "ambiguous", "localized", "localized", "lost", "localized"]
    written = events(tmp_path / "events.jsonl", [estimate_of(index, BOX, status=status) for index, status in enumerate(statuses)])
    assert [(event["index"], event["event"], event.get("found"), event.get("rejected_at")) for event in written] == [
        (1, "localized", None, None),
        (3, "rejection", False, None),
        (4, "rejection", True, None),
        (6, "recovered", None, 3),
        (8, "rejection", True, None),
        (9, "recovered", None, 8),
    ]
    assert all(list(event)[:3] == ["stamp", "index", "event"] for event in written)


def test_limits_and_scans_that_say_nothing(estimate_of: Callable[..., Any], tmp_path: Path) -> None:
    run = [estimate_of(0, BOX, limited="boxes"), estimate_of(1, BOX, uninformative=True, beams=0), estimate_of(2, BOX, limited="time")]
    written = events(tmp_path / "events.jsonl", run)
    assert [(event["index"], event["event"], event.get("by"), event.get("beams")) for event in written] == [
        (0, "limit", "boxes", None),
        (1, "uninformative", None, 0),
        (2, "limit", "time", None),
    ]


def test_an_answer_that_is_about_to_vanish(estimate_of: Callable[..., Any], tmp_path: Path) -> None:
    written = events(tmp_path / "events.jsonl", [estimate_of(3, BOX), estimate_of(5, BOX, vanishing=True)])
    assert [(event["index"], event["event"]) for event in written] == [(5, "vanishing")]
    assert written[0]["volume"] == pytest.approx(0.004)


def test_nothing_happened(estimate_of: Callable[..., Any], tmp_path: Path) -> None:
    assert events(tmp_path / "events.jsonl", [estimate_of(0, BOX)]) == []
