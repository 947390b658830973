import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from ial.compass.sequence_file import read_sequence
from ial.compass.verifier import verify
from ial.maps.polygons.polygon_json import polygon_json
from tests.maps.polygons.known_polygons import HOLED

Cli = Callable[..., Any]


@pytest.mark.slow
def test_without_an_environment_it_takes_the_embedded_one(ial: Cli) -> None:
    result = ial("compass", "plan", "--out", "s.json")
    assert result.exit_code == 0
    sequence = read_sequence("s.json")
    verify(sequence)
    assert f"environment of 44 corners: {len(sequence)} motions" in result.stdout
    assert "from everywhere they lead to one place: x " in result.stdout
    assert "sequence in s.json" in result.stdout


def test_json_and_both_orders(ial: Cli, room_l: Path) -> None:
    for order in ("greedy", "paper"):
        record = json.loads(ial("compass", "plan", room_l, "--out", f"{order}.json", "--order", order, "--json").stdout)
        sequence = read_sequence(f"{order}.json")
        verify(sequence)
        assert record["motions"] == len(sequence)
        assert record["order"] == order
        assert record["end"] == [str(each) for each in sequence.end]
        assert record["direction_bits"] == sequence.bits <= 64
        assert 0 < record["motions_along_walls"] <= len(sequence)


def test_holes_are_said(ial: Cli) -> None:
    Path("holed.json").write_text(polygon_json([HOLED]))
    result = ial("compass", "plan", "holed.json", "--out", "s.json")
    assert "environment of 10 corners and 1 hole:" in result.stdout


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("POLYGON ((0 0, 4 0, 4 4))", "open"),
        ("POLYGON ((0 0, 4 4, 4 0, 0 4, 0 0))", "crosses"),
        ("POLYGON ((0 0, 4 0, 8 0, 0 0))", "no area"),
        ("POLYGON ((0 0, 4 0, 4 0, 4 4, 0 0))", "a corner twice"),
        ("MULTIPOLYGON (((0 0, 4 0, 4 4, 0 0)), ((10 0, 14 0, 14 4, 10 0)))", "2 polygons that are apart"),
    ],
)
def test_what_is_no_polygon_is_refused(refused: Callable[..., str], text: str, said: str) -> None:
    Path("bad.wkt").write_text(text)
    line = refused("compass", "plan", "bad.wkt", "--out", "s.json")
    assert "bad.wkt" in line
    assert said in line or (said == "open" and "close" in line)


def test_a_clockwise_ring_is_turned(ial: Cli) -> None:
    Path("turned.wkt").write_text("POLYGON ((0 0, 0 4, 4 4, 4 0, 0 0))")
    assert ial("compass", "plan", "turned.wkt", "--out", "s.json").exit_code == 0
    assert read_sequence("s.json").polygon.outer[1] == (4, 0)


def test_wrong_usage_is_refused(refused: Callable[..., str], room_l: Path) -> None:
    assert "the environment cannot be read" in refused("compass", "plan", "nowhere.wkt", "--out", "s.json")
    assert "an input of the command" in refused("compass", "plan", room_l, "--out", room_l)
    Path("s.json").write_text("")
    assert "exists already" in refused("compass", "plan", room_l, "--out", "s.json")
    assert "no picture is given" in refused("compass", "plan", "--out", "new.json", "--resolution", "0.1")
    assert "give a resolution for a picture" in refused("compass", "plan", room_l, "--out", "new.json", "--resolution", "0.1")
