from collections.abc import Callable
from pathlib import Path
from typing import Any

import cv2
import pytest

Cli = Callable[..., Any]


@pytest.fixture
def hall() -> Path:
    path = Path("hall.wkt")
    path.write_text("POLYGON ((0 0, 5 0, 5 3, 3 3, 3 4, 0 4, 0 0))")
    return path


@pytest.fixture
def built(ial: Cli, hall: Path) -> Path:
    assert ial("bounce", "build", hall, "--out", "hall.npz").exit_code == 0
    return Path("hall.npz")


@pytest.mark.slow
@pytest.mark.parametrize("what", ["cycles", "basins", "automaton"])
def test_a_filter_with_its_environment_gives_the_picture_of_the_environment(ial: Cli, built: Path, hall: Path, what: str) -> None:
    result = ial("bounce", "show", built, hall, "--what", what, "--out", "one.png")
    assert result.exit_code == 0
    assert result.stdout == "picture in one.png\n"
    assert ial("bounce", "show", hall, "--angle", "90", "--what", what, "--out", "other.png").exit_code == 0
    assert cv2.imread("one.png") is not None
    assert Path("one.png").read_bytes() == Path("other.png").read_bytes()


@pytest.mark.slow
def test_a_filter_alone(ial: Cli, built: Path, refused: Callable[..., str]) -> None:
    assert ial("bounce", "show", built, "--out", "cycles.png").exit_code == 0
    assert ial("bounce", "show", built, "--what", "automaton", "--out", "automaton.png").exit_code == 0
    assert "a filter holds no basins; give the environments" in refused("bounce", "show", built, "--what", "basins", "--out", "b.png")


def test_what_cannot_be_shown(built: Path, hall: Path, refused: Callable[..., str]) -> None:
    assert "a filter comes first" in refused("bounce", "show", hall, built, "--out", "one.png")
    Path("room.wkt").write_text("POLYGON ((0 0, 5 0, 5 3, 0 3, 0 0))")
    assert "the filter is one of hall, not of room" in refused("bounce", "show", built, "room.wkt", "--out", "a.png")
    hall.write_text("POLYGON ((0 0, 4 0, 4 3, 3 3, 3 4, 0 4, 0 0))")
    assert "is not the one the filter was built from" in refused("bounce", "show", built, hall, "--out", "a.png")
    hall.write_text("POLYGON ((1 0, 6 0, 6 3, 4 3, 4 4, 1 4, 1 0))")
    assert "is not the one the filter was built from" in refused("bounce", "show", built, hall, "--out", "a.png")
    big = ("bounce", "show", "room.wkt", "--cell", "1/8", "--angle", "135", "--what", "automaton", "--out", "a.png")
    assert "use larger cells or fewer headings" in refused(*big)
    assert "cannot be written" in refused("bounce", "show", "room.wkt", "--out", "nowhere/a.png")
