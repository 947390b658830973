import json
from collections.abc import Callable
from decimal import Decimal
from fractions import Fraction
from pathlib import Path

import pytest

from ial.bouncing.calibration import LeastBound
from ial.cli.bounce.calibrate import _suggested
from tests.cli.bounce.hall import WKT, Cli

CLOCK = ("--speed", "0.3", "--turn-time", "1.5", "--clock-error", "0.01")


@pytest.fixture
def known(ial: Cli) -> Path:
    """A log of four runs from known starts, with turns ± 1° and a speed ± 2 %."""
    Path("hall.wkt").write_text(WKT)
    lines = ["robot,time,event,x,y,heading"]
    for seed in range(1, 5):
        errors = ("--angle", 100, "--step", "1/4", "--turn-error", 1, "--step-error", "0.02", "--seed", seed, "--start", 1, seed, 20)
        ial("bounce", "simulate", "hall.wkt", *errors, "--steps", 150, *CLOCK, "--log", "one.csv", "--overwrite")
        lines += [f"r{seed},{line}" for line in Path("one.csv").read_text().splitlines()[1:]]
    Path("known.csv").write_text("\n".join(lines) + "\n")
    return Path("known.csv")


@pytest.mark.slow
def test_bounds_are_told_and_the_command_that_uses_them_works(ial: Cli, known: Path) -> None:
    command = ("bounce", "calibrate", known, "hall.wkt", "--angle", 100, *CLOCK)
    record = json.loads(ial(*command, "--json").stdout)
    assert record["runs"] == 4
    speed, turn = record["speed_error"], record["turn_error_deg"]
    assert speed["refuted"] < speed["explained"] < 1.25 * speed["explained"] <= speed["suggested"]
    assert 0.01 < speed["refuted"] < 0.02
    assert 0.5 < turn["refuted"] < 1
    assert turn["refuted"] < turn["explained"] < 1.25 * turn["explained"] <= turn["suggested"]
    said = ial(*command).stdout
    assert f"{record['runs']} runs from known starts, {record['bumps']} bumps" in said
    assert f"suggested {turn['suggested']:g}°" in said
    build = said.splitlines()[3].removeprefix("build with: ")
    assert build == record["build"]
    assert ial(*build.split()[1:]).exit_code == 0
    run = ("--log", "one.csv", *CLOCK, "--speed-error", str(speed["suggested"]))
    assert "not in the environment" not in ial("bounce", "run", "filter.npz", *run).stdout


@pytest.mark.parametrize(
    ("explained", "suggested"), [("0", "0.00031"), ("0.019", "0.024"), ("0.8", "1"), ("0.801", "1.1"), ("12345", "16000")]
)
def test_a_suggestion_has_a_margin_and_is_rounded_up(explained: str, suggested: str) -> None:
    assert _suggested(LeastBound(None, Fraction(explained)), Fraction(1, 4096)) == Fraction(Decimal(suggested))


@pytest.mark.parametrize(
    ("text", "more", "message"),
    [
        ("1,start,,,\n5,bump,,,\n", (), "k.csv, line 2: a start at no known place"),
        ("1,start,1,1,0\n90,bump,,,\n", (), "k.csv, line 2: no error of the speed up to 50% explains its first leg"),
        ("1,start,1,1,0\n", (), "no start of the log has a bump after it"),
        ("1,start,1,1,0\n9,bump,,,\n", ("--step", 0), "the step is 0 m"),
        ("1,start,1,1,0\n9,bump,,,\n", ("--start-error=-1",), "an error of a start is negative"),
        ("1,start,1,1,0\n9,bump,,,\n", ("--angle", "360"), "multiple of 360°"),
    ],
)
def test_what_cannot_be_meant_is_refused(refused: Callable[..., str], text: str, more: tuple[object, ...], message: str) -> None:
    Path("hall.wkt").write_text(WKT)
    Path("k.csv").write_text("time,event,x,y,heading\n" + text)
    assert message in refused("bounce", "calibrate", "k.csv", "hall.wkt", "--speed", 1, *more)
