import shlex
import shutil
import subprocess
from pathlib import Path

import pytest

from tests.cli.bounce.hall import Cli
from tests.cli.pages import blocks, commands

PAGE = "bouncing.md"


@pytest.mark.slow
def test_the_page_shows_what_is_printed(ial: Cli, capsys: pytest.CaptureFixture[str]) -> None:
    polygon, *printed = blocks(PAGE, "text")
    Path("hall.wkt").write_text(polygon)
    Path("store.json").write_text(blocks(PAGE, "json")[0])
    Path("robot.c").write_text(blocks(PAGE, "c")[0])
    for command, output in commands(PAGE):
        if command.startswith("ial "):
            assert ial(*shlex.split(command)[1:]).stdout == output
        elif shutil.which("gcc"):
            assert subprocess.run(command, shell=True, check=True, capture_output=True, text=True).stdout == output
    capsys.readouterr()
    for code, output in zip(blocks(PAGE, "python"), printed, strict=True):
        exec(code, {})
        assert capsys.readouterr().out == output


@pytest.mark.slow
def test_the_way_from_a_floor_plan_to_the_kitchen_is_as_its_page_shows(ial: Cli) -> None:
    exec(blocks("floor-plan.md", "python")[0], {})
    five = list(commands("floor-plan.md"))
    assert len(five) == 5
    for command, output in five:
        assert ial(*shlex.split(command)[1:]).stdout == output
    assert "localized in kitchen" in five[2][1]
    x, y = next(map(float, line.split(",")[1:3]) for line in reversed(Path("where.csv").read_text().splitlines()) if line[0] == "1")
    assert 4.1 <= x <= 8.2
    assert 3.4 <= y <= 6.2
