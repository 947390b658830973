import re
import shlex
import shutil
import subprocess
from pathlib import Path

import pytest

from tests.cli.bounce.hall import Cli


def blocks(kind: str, name: str = "bouncing.md") -> list[str]:
    """The blocks of a page about the bouncing robot that are marked so."""
    page = (Path(__file__).resolve().parents[3] / "docs" / name).read_text(encoding="utf-8")
    return re.findall(rf"```{kind}\n(.*?)```", page, re.DOTALL)


@pytest.mark.slow
def test_the_page_shows_what_is_printed(ial: Cli, capsys: pytest.CaptureFixture[str]) -> None:
    polygon, *printed = blocks("text")
    Path("hall.wkt").write_text(polygon)
    Path("store.json").write_text(blocks("json")[0])
    Path("robot.c").write_text(blocks("c")[0])
    for entry in "".join(blocks("console")).split("$ ")[1:]:
        command, _, output = entry.partition("\n")
        if command.startswith("ial "):
            assert ial(*shlex.split(command)[1:]).stdout == output
        elif shutil.which("gcc"):
            assert subprocess.run(command, shell=True, check=True, capture_output=True, text=True).stdout == output
    capsys.readouterr()
    for code, output in zip(blocks("python"), printed, strict=True):
        exec(code, {})
        assert capsys.readouterr().out == output


@pytest.mark.slow
def test_the_way_from_a_floor_plan_to_the_kitchen_is_as_its_page_shows(ial: Cli) -> None:
    exec(blocks("python", "floor-plan.md")[0], {})
    commands = "".join(blocks("console", "floor-plan.md")).split("$ ")[1:]
    assert len(commands) == 5
    for entry in commands:
        command, _, output = entry.partition("\n")
        assert ial(*shlex.split(command)[1:]).stdout == output
    assert "localized in kitchen" in commands[2]
    x, y = next(map(float, line.split(",")[1:3]) for line in reversed(Path("where.csv").read_text().splitlines()) if line[0] == "1")
    assert 4.1 <= x <= 8.2
    assert 3.4 <= y <= 6.2
