import json
import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ial.lidar.hypothesis import Hypothesis
from ial.results.lidar.enclosures import Enclosure, EnclosuresFile, read_enclosures

NUMBER = st.floats(allow_nan=False, allow_infinity=False)
PAIR = st.tuples(NUMBER, NUMBER)


def written(path: Path, run: list[Any]) -> Path:
    with EnclosuresFile(path) as file:
        for step, estimate in run:
            file.add(step, estimate)
    return path


def test_a_run_reads_back_to_the_last_bit(sample_run: list[Any], tmp_path: Path) -> None:
    path = written(tmp_path / "enclosures.jsonl", sample_run)
    assert list(read_enclosures(path)) == [Enclosure.of(step, estimate) for step, estimate in sample_run]


@given(
    x=PAIR,
    y=PAIR,
    theta=PAIR,
    volume=NUMBER,
    boxes=st.integers(0, 2**40),
    prediction=st.booleans(),
    stamp=st.integers(-(2**62), 2**62),
    spare=st.none() | st.integers(0, 1000),
    vanishing=st.booleans(),
)
def test_any_numbers_read_back_to_the_last_bit(
    sample_run: list[Any],
    tmp_path_factory: pytest.TempPathFactory,
    x: Any,
    y: Any,
    theta: Any,
    volume: float,
    boxes: int,
    prediction: bool,
    stamp: int,
    spare: int | None,
    vanishing: bool,
) -> None:
    step, estimate = sample_run[-1]
    step, estimate = (
        replace(step, stamp_ns=stamp),
        replace(estimate, hypotheses=(Hypothesis(x, y, theta, boxes, volume, prediction, spare),), vanishing=vanishing),
    )
    path = written(tmp_path_factory.mktemp("lines") / "enclosures.jsonl", [(step, estimate)])
    assert list(read_enclosures(path)) == [Enclosure.of(step, estimate)]


def test_a_line_holds_what_the_format_promises(estimate_of: Callable[..., Any], tmp_path: Path) -> None:
    box = [(1.0, 2.0), (3.0, 3.5), (0.1, 0.2)]
    run = [
        estimate_of(4, box),
        estimate_of(6, box, status="blind", unconfirmed=True, limited="time", uninformative=True),
        estimate_of(7, box, status="localized", vanishing=True),
    ]
    first, second, third = map(json.loads, written(tmp_path / "enclosures.jsonl", run).read_text().splitlines())
    keys = ["stamp", "index", "status", "hypotheses", "pose", "beams", "outliers_allowed", "limited", "radius_m", "elapsed_s"]
    assert list(first) == keys
    assert (first["index"], first["status"], first["pose"], first["limited"]) == (4, "ambiguous", None, None)
    assert list(first["hypotheses"][0]) == ["x", "y", "theta", "boxes", "volume", "spare_beams"]
    assert (second["limited"], second["uninformative"], second["hypotheses"][0]["prediction"]) == ("time", True, True)
    assert (third["vanishing"], "vanishing" in first, "vanishing" in second) == (True, False, False)
    assert third["pose"] == vars(run[2][1].pose)
    assert math.isclose(third["hypotheses"][0]["volume"], 0.05)


def test_a_stamp_keeps_every_nanosecond(estimate_of: Callable[..., Any], tmp_path: Path) -> None:
    path = written(tmp_path / "enclosures.jsonl", [estimate_of(1, [(1.0, 2.0), (3.0, 3.5), (0.1, 0.2)])])
    assert path.read_text().startswith('{"stamp": 1000000000.123456789, "index": 1, ')


def test_a_scan_without_any_pose_is_a_line_too(estimate_of: Callable[..., Any], tmp_path: Path) -> None:
    run = [estimate_of(3, status="blind")]
    assert [each.hypotheses for each in read_enclosures(written(tmp_path / "enclosures.jsonl", run))] == [()]
