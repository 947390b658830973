from types import SimpleNamespace
from typing import Any

import pytest

from ial.cli.lidar.report import report


def record(vanishing: int = 0, **statuses: int) -> dict[str, Any]:
    processed = sum(statuses.values())
    none: dict[str, int] = {}
    scans = {"processed": processed, "by_status": statuses, "one_hypothesis": 3, "skipped": none, "repaired": none}
    scans |= {"uninformative": 0, "vanishing": vanishing, "limited": none, "lidars_without_scans": []}
    return {"scans": scans, "times": {"median_s": 0.001, "p99_s": 0.002, "wall_s": 1.0}, "measures": None}


@pytest.mark.parametrize(
    ("statuses", "doubtful"),
    [
        ({"localized": 90, "lost": 10}, False),
        ({"localized": 80, "lost": 12, "blind": 8}, True),
        ({"blind": 1}, True),
        ({"localized": 1}, False),
    ],
)
def test_a_run_that_was_contradicted_often_says_so(statuses: dict[str, int], doubtful: bool) -> None:
    summary: Any = SimpleNamespace(last=None, localized=True, first_localized=0)
    lines = [line for line in report(summary, record(**statuses)) if line.startswith("doubtful")]
    assert len(lines) == doubtful
    assert all("map of the place" in line for line in lines)


@pytest.mark.parametrize("vanishing", [0, 3])
def test_answers_that_are_about_to_vanish_are_counted(vanishing: int) -> None:
    summary: Any = SimpleNamespace(last=None, localized=True, first_localized=0)
    lines = [line for line in report(summary, record(vanishing, localized=9)) if line.startswith("vanishing")]
    assert [line.partition(" scans")[0] for line in lines] == (["vanishing: 3"] if vanishing else [])
