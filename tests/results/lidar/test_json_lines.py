import json
from decimal import Decimal
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from ial.results.lidar.json_lines import JsonLines, json_line, read_lines

STEP: Any = SimpleNamespace(index=3, stamp_ns=1_700_000_000_123_456_789)


def test_stamps_and_numbers_keep_every_digit(tmp_path: Path) -> None:
    path = tmp_path / "a.jsonl"
    with JsonLines(path) as file:
        file.write(STEP, x=0.1, name="Málaga")
        file.write(STEP, x=5e-324)
    first, second = read_lines(path)
    assert first == {"stamp": Decimal("1700000000.123456789"), "index": 3, "x": Decimal("0.1"), "name": "Málaga"}
    assert float(second["x"]) == 5e-324


def test_a_line_is_one_object() -> None:
    line = json_line(STEP, text="a\nb")
    assert (line.count("\n"), json.loads(line)["text"]) == (1, "a\nb")


def test_what_json_cannot_say_is_no_line() -> None:
    with pytest.raises(ValueError, match="not JSON compliant"):
        json_line(STEP, x=float("inf"))
