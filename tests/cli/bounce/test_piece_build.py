from collections.abc import Callable
from pathlib import Path

import pytest

from tests.cli.bounce.hall import Cli


@pytest.mark.parametrize(
    ("more", "message"),
    [
        (("--rays", "--radius", "5"), "a robot of radius 5 m fits nowhere"),
        (("--rays", "--radius", "-1/2"), "radius of the robot is -0.5 m"),
        (("--rays", "--room", "attic=20,20,30,30"), "the room 'attic' lies outside of the environment"),
        (("--rays", "--headings", 0), "0 intervals of headings are too wide"),
        (("--rays", "--step", ""), "--step: '' is no number"),
        (("--count-error", 10**11), "at most 1048576"),
        (("--turn-error", "1e999"), "is too large"),
        (("--cell", 1, "--radius", "1e15"), "no cell is free"),
        (("--cell", 1, "--step", "1e15"), "give a length greater than 0, and at most 1073741824"),
        (("--cell", 1, "--step", "5000"), "a step leads over 5000 cells, at most 4096 are supported"),
        (("--turn-error", 1, "--cell", 1), "leave them out with --rays or an error"),
        (("--rays", "--rule", "inside"), "leave them out with --rays or an error"),
        (("--rays", "--corner", "endpoint"), "leave them out with --rays or an error"),
        (("--count-error", 1, "--most-states", 9), "leave them out with --rays or an error"),
        (("--part", "1/2"), "--room, --within and --part are for robots with real geometry"),
        (("--rays", "--room", "kitchen"), "NAME=X0,Y0,X1,Y1"),
        (("--rays", "--room", "a=0,0,1,x"), "--room"),
        (("--rays", "--room", "a=0,0,1,1", "--within", 1), "either of the two"),
        (("--rays", "--within", 0), "within 0 m"),
        (("--within", 1), "--room, --within and --part are for robots with real geometry"),
        (("--turn-error", -1), "error of a turn is -1°"),
        (("--rays", "--headings", 8), "8 intervals of headings are too wide"),
        (("--rays", "--part", 0), "0 m wide"),
    ],
)
def test_a_set_filter_that_cannot_be_meant_is_refused(ial: Cli, hall: Path, more: tuple[object, ...], message: str) -> None:
    result = ial("bounce", "build", hall, *more, "--out", "x.npz")
    assert result.exit_code == 2
    assert message in " ".join(result.stderr.split())
    assert not Path("x.npz").exists()


def test_any_angle_that_is_built_can_be_run(ial: Cli, hall: Path, refused: Callable[..., str]) -> None:
    assert (
        ial("bounce", "build", hall, "--rays", "--angle", "360000000000100", "--part", 1, "--headings", 36, "--out", "x.npz").exit_code == 0
    )
    assert "after 5 observations" in ial("bounce", "run", "x.npz", "--stream", "00011").stdout
    assert "a leg would take more than" in refused("bounce", "simulate", hall, "--step", "1e-9", "--out", "s.txt")
