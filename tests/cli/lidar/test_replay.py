import json
from collections.abc import Callable
from typing import Any

import pytest

from ial.contractors import threads

Refused = Callable[..., str]


@pytest.fixture(autouse=True)
def _own_threads(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(threads, "_threads", None)  # the command sets their number for the whole process


@pytest.mark.slow
def test_the_embedded_recording_is_answered_scan_by_scan(ial: Callable[..., Any]) -> None:
    result = ial("replay", "--json", "--set", "precision.position_m=0.2")
    assert result.exit_code == 0
    content = json.loads(result.stdout)
    assert (content["scans"], content["late"], content["limited"]) == (37, 0, 0)
    assert 0.0 < content["latency"]["median_s"] <= content["latency"]["p99_s"] <= content["latency"]["max_s"]


def test_in_words(ial: Callable[..., Any]) -> None:
    result = ial("replay", "--realtime", "--speed", "1e6", "--set", "precision.position_m=0.2", "--set", "max_boxes=50")
    first, late, limited = result.stdout.splitlines()
    assert (result.exit_code, first.startswith("37 scans of ")) == (0, True)
    assert late.endswith(" answers came after the next scan was due")
    assert limited.endswith(" answers were made coarser by the deadline or by max_boxes")


def test_what_is_refused(refused: Refused) -> None:
    assert "--speed 0: give a number above 0" in refused("replay", "--speed", "0")
    assert "--deadline -1: give a number of seconds above 0" in refused("replay", "--deadline", "-1")
    assert "no map to localize here.bag in; give --map MAP" in refused("replay", "here.bag")
