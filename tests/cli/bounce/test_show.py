import json
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path

import cv2
import pytest

from ial.bouncing.bump_timing import BumpTiming
from ial.bouncing.filters.filter_file import read_filter
from ial.bouncing.filters.piece_filter import PieceFilter
from ial.cli.bounce.show import sets_of_log
from tests.cli.bounce.hall import Cli


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


@pytest.fixture
def sets(ial: Cli, hall: Path) -> Path:
    errors = ("--turn-error", 2, "--step-error", "0.02", "--count-error", 1)
    assert ial("bounce", "build", hall, "--angle", 100, *errors, "--headings", 36, "--part", "1/2", "--out", "sets.npz").exit_code == 0
    more = ("--seed", 3, "--steps", 80, "--out", "s.txt", "--truth", "t.csv")
    assert ial("bounce", "simulate", hall, "--angle", 100, "--step", "1/4", *errors, *more).exit_code == 0
    return Path("sets.npz")


@pytest.mark.slow
def test_what_a_stream_leaves_is_drawn_and_the_truth_if_it_is_given(ial: Cli, hall: Path, sets: Path) -> None:
    command = ("bounce", "show", sets, hall, "--what", "sets")
    result = ial(*command, "--file", "s.txt", "--out", "file.png")
    assert (result.exit_code, result.stdout) == (0, "picture in file.png\n")
    assert cv2.imread("file.png") is not None
    assert ial(*command, "--stream", Path("s.txt").read_text(), "--out", "stream.png").exit_code == 0
    assert Path("file.png").read_bytes() == Path("stream.png").read_bytes()
    assert ial(*command, "--file", "s.txt", "--truth", "t.csv", "--out", "truth.png").exit_code == 0
    assert Path("truth.png").read_bytes() != Path("file.png").read_bytes()


@pytest.mark.slow
def test_what_a_log_leaves_is_drawn_and_is_what_its_run_tells(ial: Cli, hall: Path, sets: Path, refused: Callable[..., str]) -> None:
    built = ("bounce", "build", hall, "--angle", 100, "--turn-error", 2, "--count-error", 1, "--out", "log.npz")
    assert ial(*built).exit_code == 0
    clock = ("--speed", "0.3", "--turn-time", 1, "--clock-error", "0.05")
    drive = ("bounce", "simulate", hall, "--angle", 100, "--turn-error", 2, "--step", "1/4", "--steps", 200, "--truth", "where.csv")
    assert ial(*drive, *clock, "--log", "log.csv", "--out", "stream.txt").exit_code == 0
    told = json.loads(ial("bounce", "run", "log.npz", "--log", "log.csv", *clock, "--json").stdout)["robots"][0]
    shown = ("bounce", "show", "log.npz", hall, "--what", "sets", "--log", "log.csv")
    assert ial(*shown, *clock, "--truth", "where.csv", "--out", "log.png").exit_code == 0
    times = BumpTiming(Fraction(3, 10), Fraction(1), Fraction(1, 20))
    made = read_filter(Path("log.npz"))
    assert isinstance(made, PieceFilter)
    left = sets_of_log(made, Path("log.csv"), times)
    assert (len(left), len(left[-1])) == (told["bumps"], told["pieces"])
    assert "give --speed" in refused(*shown, "--out", "a.png")
    assert "are for a --log with times" in refused(*shown[:-2], "--file", "stream.txt", *clock, "--out", "a.png")
    lines = Path("log.csv").read_text().splitlines()
    Path("two.csv").write_text("".join(f"{line},{('robot', 'a', 'b')[min(at, 2)]}\n" for at, line in enumerate(lines)))
    assert "the log is of several robots, a and b" in refused(*shown[:-1], "two.csv", *clock, "--out", "a.png")


def test_sets_that_cannot_be_shown(ial: Cli, hall: Path, sets: Path, built: Path, refused: Callable[..., str]) -> None:
    out = ("--what", "sets", "--out", "a.png")
    assert "one of --stream BITS, --file FILE and --log FILE" in refused("bounce", "show", sets, hall, *out)
    assert "one of --stream BITS, --file FILE and --log FILE" in refused(
        "bounce", "show", sets, hall, *out, "--stream", "1", "--file", "s.txt"
    )
    assert "--what sets needs a filter" in refused("bounce", "show", hall, *out, "--stream", "1")
    assert "a filter of cells has no pieces of walls" in refused("bounce", "show", built, hall, *out, "--stream", "1")
    assert "give the one environment it was built from" in refused("bounce", "show", sets, *out, "--stream", "1")
    assert "has not bumped yet" in refused("bounce", "show", sets, hall, *out, "--stream", "000")
    assert "those of other observations" in refused("bounce", "show", sets, hall, *out, "--stream", "01", "--truth", "t.csv")
    assert "an input of the command" in refused("bounce", "show", sets, hall, "--file", "s.txt", "--what", "sets", "--out", "s.txt")
    assert "are for --what sets" in refused("bounce", "show", built, hall, "--stream", "1", "--out", "a.png")
    assert "or --what sets" in refused("bounce", "show", sets, hall, "--out", "a.png")
    hall.write_text("POLYGON ((0 0, 5 0, 5 3, 3 3, 3 5, 0 5, 0 0))")
    assert "is not the one the filter was built from" in refused("bounce", "show", sets, hall, *out, "--stream", "1")
    assert not Path("a.png").exists()


def test_a_picture_is_called_one(built: Path, refused: Callable[..., str]) -> None:
    assert "a.h: the picture is a PNG; give a name that ends in .png" in refused("bounce", "show", built, "--out", "a.h")
