import json
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.cli.bounce.hall import Cli


def test_a_robot_in_the_embedded_environment_is_localized(ial: Cli) -> None:
    result = ial("odometer", "run")
    assert result.exit_code == 0
    assert "  2  turn 180°, drive to a wall: came 6.38507 m (for candidates)\n" in result.stdout
    assert "localized with 5 commands:\n" in result.stdout
    assert "the simulated robot is at x " in result.stdout


def test_json_says_the_same(ial: Cli) -> None:
    record = json.loads(ial("odometer", "run", "--start", "7,5/2,100", "--json").stdout)
    assert record["status"] == "localized"
    (left,) = record["hypotheses"]
    assert abs(left["x_m"] - record["truth"]["x_m"]) <= left["width_m"]
    assert abs(left["y_m"] - record["truth"]["y_m"]) <= left["width_m"]
    assert record["commands"][0]["reason"] == "to a wall"
    assert record["candidates"] >= 1


@pytest.mark.slow
def test_errors_leave_a_wider_set_that_holds_the_truth(ial: Cli) -> None:
    result = ial("odometer", "run", "--distance-error", "1%", "--turn-error", "1/2", "--json")
    record = json.loads(result.stdout)
    assert record["status"] == "localized"
    (left,) = record["hypotheses"]
    assert abs(left["x_m"] - record["truth"]["x_m"]) <= left["width_m"] <= 1.0
    assert 0.0 < record["narrowest"]["width_m"] <= left["width_m"]


def test_symmetric_environments_are_said_to_be(ial: Cli) -> None:
    Path("square.wkt").write_text("POLYGON ((0 0, 3 0, 3 3, 0 3, 0 0))")
    result = ial("odometer", "run", "square.wkt", "--start", "1,1,20")
    assert result.exit_code == 0
    assert "no motion can tell these 4 apart" in result.stdout


def test_of_environments_in_parts_the_one_with_the_robot_is_found(ial: Cli) -> None:
    Path("parts.wkt").write_text("MULTIPOLYGON (((0 0, 4 0, 4 3, 0 2, 0 0)), ((6 0, 9 0, 9 1, 6 2, 6 0)))")
    record = json.loads(ial("odometer", "run", "parts.wkt", "--start", "7,1,20", "--json").stdout)
    assert [each["environment"] for each in record["hypotheses"]] == ["part 2"]


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--start", "20,1,70"], "lies outside of the environment"),
        (["--start", "4.5,3,70"], "lies outside of the environment"),
        (["--start", "2,1"], "give X,Y,DEGREES"),
        (["--start", "2,1,north"], "--start"),
        (["--distance-error", "90%"], "give a number from 0 to 0.5"),
        (["--turn-error", "-1"], "turn error"),
        (["nowhere.wkt"], "nowhere.wkt"),
        (["--resolution", "1"], "no picture is given"),
    ],
)
def test_what_is_wrong_is_said(refused: Callable[..., str], arguments: list[str], words: str) -> None:
    assert words in refused("odometer", "run", *arguments)
