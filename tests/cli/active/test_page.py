import contextlib
import io
import math
import runpy
import shlex
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest

from ial.results.active.leg import Leg
from tests.cli.pages import DOCS, blocks, commands

PAGE = "exploring.md"
OWN_ROBOT = Path(__file__).resolve().parents[2] / "active" / "own_robot.py"
FIGURES = runpy.run_path(str(DOCS / "explorations.py"))


def said(legs: list[Leg]) -> str:
    """How the page says how long a run is."""
    way = sum(math.dist((one.truth.x, one.truth.y), (other.truth.x, other.truth.y)) for one, other in pairwise(legs))
    return f"{len(legs) - 1} drives and {way:.1f} m"


def stages(legs: list[Leg]) -> set[str]:
    return {leg.taken.decision.stage for leg in legs if leg.taken.decision is not None}


@pytest.mark.slow
def test_the_page_shows_what_is_printed(ial: Callable[..., Any]) -> None:
    for command, printed in commands(PAGE):
        assert ial(*shlex.split(command)[1:]).stdout == printed, command
    assert Path("explored.gif").exists()
    assert Path("explored/tree.png").exists()
    example, _ = blocks(PAGE, "python")
    with contextlib.redirect_stdout(io.StringIO()) as output:
        exec(example, {})
    assert [output.getvalue()] == blocks(PAGE, "text")


def test_the_robot_of_ones_own_is_the_one_that_is_tested() -> None:
    _, shown = blocks(PAGE, "python")
    _, _, code = OWN_ROBOT.read_text(encoding="utf-8").partition('"""\n\n')
    assert shown == code


@pytest.mark.slow
@pytest.mark.parametrize("figure", ["DIRECTION", "DETACHED"])
def test_stage_1_is_enough_where_the_page_says_so_and_entropy_takes_longer(figure: str) -> None:
    page = " ".join((DOCS / PAGE).read_text(encoding="utf-8").split())
    plan, start = FIGURES[figure]
    assert f"--map plan:{plan} --start {' '.join(f'{each:g}' for each in start)}`" in page
    two_stages, entropy = (FIGURES["Exploration"](plan, start, planner).legs() for planner in ("direction", "entropy"))
    assert stages(two_stages) == {"direction"}
    assert two_stages[-1].estimate.status == "localized"
    assert entropy[-1].estimate.status == ("localized" if figure == "DIRECTION" else "ambiguous")
    assert said(two_stages) in page
    assert said(entropy) in page
    assert len(entropy) > 3 * len(two_stages)


@pytest.mark.slow
def test_stage_1_has_no_part_on_the_curved_map_of_the_page() -> None:
    page = " ".join((DOCS / PAGE).read_text(encoding="utf-8").split())
    plan, start = FIGURES["CURVED"]
    assert f"--map plan:{plan} --start {' '.join(f'{each:g}' for each in start)}`" in page
    legs = FIGURES["Exploration"](plan, start).legs()
    assert stages(legs) == {"frontier", "backtrack"}
    assert legs[-1].estimate.status == "localized"
    assert said(legs) in page


def test_every_picture_of_the_page_is_made() -> None:
    text = (DOCS / PAGE).read_text(encoding="utf-8")
    shown = {part.partition(")")[0] for part in text.split("](_build/pictures/")[1:]}
    figures = {name for name in shown if f'"{Path(name).stem}' in (DOCS / "explorations.py").read_text(encoding="utf-8")}
    assert figures == {"direction.png", "detached.png", "frontiers.png"}
    assert shown - figures == {"explored.gif", "explored/tree.png"}
