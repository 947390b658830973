import io
import json
import re
import shlex
import shutil
import subprocess
from collections.abc import Callable
from fractions import Fraction
from itertools import islice
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from rich.console import Console
from rich.progress import Progress
from typer.testing import CliRunner

from ial.bouncing.exports.c_tables import CTables
from ial.bouncing.exports.exported_filter import ExportedFilter
from ial.bouncing.exports.piece_source import PieceTables
from ial.bouncing.filters.bounce_filter import BounceFilter
from ial.bouncing.filters.filter_file import read_filter
from ial.bouncing.filters.piece_filter import PieceFilter
from ial.bouncing.rays.real_robot import RealRobot
from ial.cli.bounce.piece_outcome import outcome
from ial.cli.main import app
from ial.cli.shell import terminal
from ial.datasets.sample import sample_map_path
from ial.maps.grids.map_file import write_map
from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, OccupancyGrid
from ial.maps.polygons.environment import load_environment
from ial.maps.polygons.simplification import simplified

Cli = Callable[..., Any]
WKT = "POLYGON ((0 0, 9 0, 9 4, 5 4, 5 7, 0 7, 0 0), (2 2, 2 4, 3 4, 3 2, 2 2))"


@pytest.fixture
def hall() -> Path:
    path = Path("hall.wkt")
    path.write_text(WKT)
    return path


@pytest.fixture
def built(ial: Cli, hall: Path) -> Path:
    assert ial("bounce", "build", hall, "--angle", "90", "--cell", 1, "--headings", 4, "--radius", 0, "--out", "hall.npz").exit_code == 0
    return Path("hall.npz")


def stream_of(path: Path, start: int = 3, count: int = 60) -> str:
    """Observations that never lead to the trap."""
    made = read_filter(path)
    assert isinstance(made, BounceFilter)
    table, state, letters = made.table, 0, ""
    for at in range(count):
        options = [letter for letter in (0, 1) if table.step(state, letter) != table.trap]
        letter = options[(at + start) % len(options)]
        letters, state = letters + str(letter), table.step(state, letter)
    return letters


def test_build_says_what_it_has_built(ial: Cli, hall: Path) -> None:
    result = ial("bounce", "build", hall, "--out", "f.npz")
    assert result.exit_code == 0
    assert "hall: 196 configurations, 4 headings, cells of 1 m, bouncing angle 90°" in result.stdout
    assert "177 states, 2 knowledge cycles" in result.stdout
    assert "a localized robot is in 1 to 2 configurations" in result.stdout
    record = json.loads(ial("bounce", "build", hall, "--out", "f.npz", "--angle", "45/2", "--cell", "1/2", "--json", "--overwrite").stdout)
    assert (record["headings"], record["bounce_deg"], record["cell_m"]) == (16, 22.5, 0.5)
    assert record["configurations"] == 16 * 4 * 49


def test_run_localizes(ial: Cli, built: Path) -> None:
    stream = stream_of(built)
    result = ial("bounce", "run", built, "--stream", stream)
    assert result.exit_code == 0
    assert "after 60 observations: localized (colour" in result.stdout
    assert "hall: x " in result.stdout
    Path("stream.txt").write_text(stream[:30] + "\n" + stream[30:] + "\n")
    record = json.loads(ial("bounce", "run", built, "--file", "stream.txt", "--json").stdout)
    assert record["localized"]
    assert record["configurations"] == sum(len(place["headings_deg"]) for place in record["places"])
    assert record["rejected_at"] == []
    assert ial("bounce", "run", built, "--file", "stream.txt", "--world", "closed").stdout == result.stdout


def test_run_reads_standard_input(ial: Cli, built: Path) -> None:
    stream = stream_of(built)
    result = CliRunner().invoke(app, ["bounce", "run", str(built), "--file", "-"], input=f"{stream[:9]}\n{stream[9:]}\n")
    assert result.exit_code == 0
    assert result.stdout == ial("bounce", "run", built, "--stream", stream).stdout


def test_a_robot_that_is_not_localized_or_elsewhere(ial: Cli, built: Path) -> None:
    result = ial("bounce", "run", built, "--stream", "0")
    assert result.exit_code == 3
    assert "not localized yet" in result.stdout
    elsewhere = ial("bounce", "run", built, "--stream", "0" * 12)
    assert elsewhere.exit_code == 3
    assert "rejected at observation 9" in elsewhere.stdout
    assert "in none of the environments" in elsewhere.stdout
    carried = ial("bounce", "run", built, "--restart", "--stream", "0" * 9 + stream_of(built))
    assert carried.exit_code == 0
    assert "rejected at observation 9" in carried.stdout
    assert "localized (colour" in carried.stdout


def test_several_environments(ial: Cli, hall: Path) -> None:
    Path("room.svg").write_text('<svg><polygon points="0,0 6,0 6,5 0,5"/></svg>')
    cells = np.zeros((5, 7), dtype=np.uint8)
    cells[2, 3] = 1
    write_map(OccupancyGrid(cells, 1.0), Path("office.yaml"))
    record = json.loads(ial("bounce", "build", hall, "room.svg", "office.yaml", "--out", "all.npz", "--json").stdout)
    assert record["environments"] == ["hall", "room", "office"]
    assert record["configurations"] == 4 * (49 + 30 + 34)
    result = ial("bounce", "run", "all.npz", "--stream", "00000000")
    assert "in hall" in result.stdout
    assert "room" not in result.stdout


def test_merged_headings_are_told(ial: Cli, hall: Path) -> None:
    ial("bounce", "build", hall, "--headings", 360, "--out", "f.npz")
    result = ial("bounce", "run", "f.npz", "--stream", stream_of(Path("f.npz"), count=200))
    assert "heading one of " in result.stdout
    assert "more; --json lists all" in result.stdout or result.stdout.count("hall: x") <= 12


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--angle", "50", "--headings", "8"], "bouncing angle 50° is not a multiple of 45°"),
        (["--angle", "360"], "multiple of 360°"),
        (["--angle", "right"], "--angle: 'right' is no number"),
        (["--angle", "45", "--step", "1/2"], "rounds to offset (0, 0)"),
        (["--radius", "9"], "no cell is free for a robot of radius 9 m"),
        (["--radius=-1"], "radius of the robot is -1"),
        (["--cell", "0"], "--cell is 0"),
        (["--cell", "1e-9"], "too small"),
        (["--max-states", "0"], None),
        (["--most-states", "5"], "more than 5 states"),
        (["--headings", "0"], "number of headings is 0"),
    ],
)
def test_bad_options_are_refused(refused: Callable[..., str], ial: Cli, hall: Path, options: list[str], message: str | None) -> None:
    if message is None:  # an option that does not exist is refused by the command line itself
        assert ial("bounce", "build", hall, "--out", "f.npz", *options).exit_code == 2
    else:
        assert message in refused("bounce", "build", hall, "--out", "f.npz", *options)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("POLYGON ((0 0, 4 4, 4 0, 0 3, 0 0))", "the outer ring crosses or touches itself"),
        ("POLYGON ((0 0, 4 0, 4 4))", "is open"),
        ("POLYGON ((0 0, 4 0, 4 4, 0 0), (7 7, 8 7, 8 8, 7 7))", "hole 1 does not lie inside"),
    ],
)
def test_bad_environments_are_refused(refused: Callable[..., str], text: str, message: str) -> None:
    Path("bad.wkt").write_text(text)
    assert message in refused("bounce", "build", "bad.wkt", "--out", "f.npz")


def test_bad_filters_and_streams_are_refused(refused: Callable[..., str], built: Path, hall: Path) -> None:
    assert "symbol 3 of the stream is '2'" in refused("bounce", "run", built, "--stream", "012")
    assert "one of --stream BITS, --file FILE and --log FILE" in refused("bounce", "run", built)
    assert "one of --stream BITS, --file FILE and --log FILE" in refused("bounce", "run", built, "--stream", "0", "--file", "x")
    assert "cannot be read" in refused("bounce", "run", built, "--file", "nowhere.txt")
    assert "fits no place of the environment" in refused("bounce", "run", built, "--world", "closed", "--stream", "0" * 12)
    assert "two environments have the same name" in refused("bounce", "build", hall, hall, "--out", "f.npz")
    Path("cut.npz").write_bytes(built.read_bytes()[:500])
    assert "truncated" in refused("bounce", "run", "cut.npz", "--stream", "0")
    Path("bad.txt").write_bytes(b"\xff")
    assert "no text" in refused("bounce", "run", built, "--file", "bad.txt")


def blocks(kind: str, name: str = "bouncing.md") -> list[str]:
    """The blocks of a page about the bouncing robot that are marked so."""
    page = (Path(__file__).resolve().parents[2] / "docs" / name).read_text(encoding="utf-8")
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


def test_simulate_writes_a_stream_that_run_reads(ial: Cli, hall: Path, built: Path) -> None:
    command = ("bounce", "simulate", hall, "--angle", 90, "--step", 1, "--seed", 4, "--steps", 30, "--out", "stream.txt")
    result = ial(*command, "--truth", "truth.csv")
    assert result.exit_code == 0
    assert re.fullmatch(r"30 observations, \d+ of them bumps, in stream.txt\nthe poses after them in truth.csv\n", result.stdout)
    lines = Path("truth.csv").read_text().splitlines()
    assert lines[0] == "observation,x_m,y_m,heading_deg"
    stream = Path("stream.txt").read_text()
    assert stream.strip() == "".join(line[0] for line in lines[1:])
    assert "after 30 observations" in ial("bounce", "run", built, "--file", "stream.txt").stdout
    assert ial(*command, "--overwrite").exit_code == 0
    assert Path("stream.txt").read_text() == stream


REAL = ("--angle", 100, "--turn-error", 2, "--step-error", "0.02", "--count-error", 1)
ROOMS = ("--room", "left=-1,-1,5,8", "--room", "right=5,-1,10,5")


@pytest.fixture
def sets(ial: Cli, hall: Path) -> Path:
    result = ial("bounce", "build", hall, *REAL, *ROOMS, "--out", "sets.npz")
    assert result.exit_code == 0
    assert "hall: 10944 pieces (152 parts of walls, 72 headings), 42182 arcs" in result.stdout
    assert "turns of 100° ± 2°, steps of 0.25 m ± 2 %, counts ± 1" in result.stdout
    assert "localized is a robot whose last bump was in left or right" in result.stdout
    assert re.search(r"as a C header: 1\d\d,\d\d\d bytes of flash, 2,740 of RAM", result.stdout)
    return Path("sets.npz")


@pytest.mark.slow
@pytest.mark.parametrize("radius", ["0", "1/5"])
def test_a_robot_with_errors_is_localized_in_a_room_from_two_commands(ial: Cli, hall: Path, sets: Path, radius: str) -> None:
    built = ial("bounce", "build", hall, *REAL, *ROOMS, "--radius", radius, "--out", sets, "--overwrite")
    assert ("a disk of radius 0.2 m" if radius != "0" else "a point") + " with real geometry" in built.stdout
    noise = ("--turn-error", 2, "--step-error", "0.02", "--count-error", 1, "--step", "1/4", "--angle", 100)
    told = set()
    for seed in range(6):
        more = ("--radius", radius, "--seed", seed, "--steps", 300, "--out", "s.txt", "--truth", "t.csv", "--overwrite")
        assert ial("bounce", "simulate", hall, *noise, *more).exit_code == 0
        record = json.loads(ial("bounce", "run", sets, "--file", "s.txt", "--json").stdout)
        assert record["rejected_at"] == []
        assert record["observations"] == 300
        poses = [line.split(",") for line in Path("t.csv").read_text().splitlines()[1:]]
        x, y = next((float(pose[1]), float(pose[2])) for pose in reversed(poses) if pose[0] == "1")
        box = record["last_bump_m"]
        assert box["x0"] <= x <= box["x1"]
        assert box["y0"] <= y <= box["y1"]
        if record["localized"]:
            assert (x <= 5) if record["room"] == "left" else (x >= 5)
            told.add(record["room"])
            words = ial("bounce", "run", sets, "--file", "s.txt").stdout
            assert f"after 300 observations: localized in {record['room']}, {record['pieces']} pieces of walls in hall" in words
            assert "the last bump was at x " in words
    assert told == {"left", "right"}


@pytest.mark.slow
def test_a_robot_may_be_localized_by_a_step_without_a_bump(ial: Cli, hall: Path) -> None:
    """What is told of the first time agrees with what every shorter stream tells."""
    assert ial("bounce", "build", hall, *REAL, "--headings", 36, "--part", "1/2", "--within", 4, "--out", "f.npz").exit_code == 0
    made = read_filter(Path("f.npz"))
    assert isinstance(made, PieceFilter)
    by_steps = 0
    for seed in range(12):
        robot = RealRobot(load_environment(hall), Fraction(100), Fraction(1, 4), bounds=made.bounds, seed=seed)
        stream = [pose.observation for pose in islice(robot.run(), 250)]
        first = outcome(made, stream, False)["localized_at"]
        told = next((at for at in range(1, len(stream) + 1) if outcome(made, stream[:at], False)["localized"]), None)
        assert first == told
        by_steps += first is not None and not stream[first - 1]
    assert by_steps > 0


def test_run_with_a_set_filter_says_what_it_does_not_know(ial: Cli, sets: Path) -> None:
    result = ial("bounce", "run", sets, "--stream", "000")
    assert (result.exit_code, result.stdout) == (3, "after 3 observations: no bump yet\n")
    result = ial("bounce", "run", sets, "--stream", "0001")
    assert result.exit_code == 3
    assert "after 4 observations: not localized, 10944 pieces of walls in hall" in result.stdout
    result = ial("bounce", "run", sets, "--stream", "0" * 60)
    assert result.exit_code == 3
    assert "rejected at observation 48: no place in the environment fits" in result.stdout
    assert "after 60 observations: not in the environment" in result.stdout
    assert "no bump yet" in ial("bounce", "run", sets, "--stream", "0" * 60, "--restart").stdout
    result = ial("bounce", "run", sets, "--stream", "0" * 60, "--world", "closed")
    assert result.exit_code == 2
    assert "observation 48 of the stream fits no place" in result.stderr


def test_a_set_filter_is_exported_as_c_alone(ial: Cli, sets: Path) -> None:
    result = ial("bounce", "export", sets, "--prefix", "hall", "--out", "sets.h")
    assert result.exit_code == 0
    assert "10944 pieces of walls in sets.h" in result.stdout
    assert "static inline int hall_update(hall_filter *filter, int bump)" in Path("sets.h").read_text()
    for more in (("--out", "sets.v"), ("--out", "b.h", "--restart"), ("--out", "b.h", "--minimize", "colours")):
        result = ial("bounce", "export", sets, *more)
        assert result.exit_code == 2
        assert "give --format c or npz, without --minimize and --restart" in result.stderr
    result = ial("bounce", "show", sets, "--out", "a.png")
    assert result.exit_code == 2
    assert "no cycles and no basins" in result.stderr


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


def test_simulate_starts_where_it_is_told(ial: Cli, hall: Path) -> None:
    ial("bounce", "simulate", hall, "--start", "1/2", "0.5", "0", "--steps", 9, "--out", "s.txt", "--truth", "t.csv", "--radius", "1/4")
    assert Path("s.txt").read_text() == "000000001\n"
    assert Path("t.csv").read_text().splitlines()[-1] == "1,8.75,0.5,90.0"


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--turn-error", "190"], "error of a turn is 190°"),
        (["--step-error", "2"], "error of a step is 2 of its length"),
        (["--count-error", "-1"], "error of a count is -1"),
        (["--start", "2.5", "3", "0"], "cannot start at (2.5, 3)"),
        (["--step", "0"], "step is 0 m"),
        (["--angle", "0"], "multiple of 360°"),
        (["--angle", "x"], "--angle: 'x' is no number"),
        (["--radius", "5"], "no free place was found"),
    ],
)
def test_bad_simulations_are_refused(refused: Callable[..., str], hall: Path, options: list[str], message: str) -> None:
    assert message in refused("bounce", "simulate", hall, "--out", "s.txt", *options)


def test_nothing_that_is_read_is_overwritten_and_no_output_is_lost(refused: Callable[..., str], hall: Path, built: Path) -> None:
    read, filtered = hall.read_bytes(), built.read_bytes()
    assert "an input of the command" in refused("bounce", "build", hall, "--out", hall)
    assert "an input of the command" in refused("bounce", "show", built, hall, "--out", hall)
    assert "an input of the command" in refused("bounce", "show", built, "--out", built)
    assert "an input of the command" in refused("bounce", "simulate", hall, "--out", "s.txt", "--truth", hall)
    assert "written twice" in refused("bounce", "simulate", hall, "--out", "s.txt", "--truth", "s.txt")
    assert "no folder nowhere" in refused("bounce", "simulate", hall, "--out", "s.txt", "--truth", "nowhere/t.csv")
    for out in (".", "", "/"):
        assert "is a folder" in refused("bounce", "build", hall, "--out", out)
    assert (hall.read_bytes(), built.read_bytes()) == (read, filtered)
    assert not Path("s.txt").exists()


def test_a_filter_with_a_space_in_its_name_is_quoted(ial: Cli, hall: Path) -> None:
    assert "ial bounce run 'my filter.npz' --stream" in ial("bounce", "build", hall, "--out", "my filter.npz").stdout


@pytest.fixture
def plan() -> Path:
    """A picture of the hall, a pixel for each half a metre, dark where the wall is, in the frame of the polygons."""
    pixels = np.zeros((14, 18), dtype=np.uint8)
    pixels[:, :10] = pixels[6:, :] = 255
    pixels[6:10, 4:6] = 0  # rows count from the top
    path = Path("plan.png")
    assert cv2.imwrite(str(path), pixels)
    return path


def test_a_picture_is_the_environment_that_it_shows(ial: Cli, hall: Path, plan: Path) -> None:
    options = ("--angle", 90, "--cell", 1, "--json")
    drawn = json.loads(ial("bounce", "build", plan, "--resolution", "1/2", *options, "--out", "plan.npz").stdout)
    written = json.loads(ial("bounce", "build", hall, *options, "--out", "hall.npz").stdout)
    assert {**drawn, "environments": []}["states"] == written["states"]
    assert drawn["configurations"] == written["configurations"]
    both = json.loads(ial("bounce", "build", plan, hall, "--resolution", "1/2", *options, "--out", "both.npz").stdout)
    assert both["environments"] == ["plan", "hall"]
    assert (
        ial("bounce", "build", plan, "--resolution", 0.5, "--out", "small.npz")
        .stdout.splitlines()[0]
        .endswith("cells of 0.5 m, bouncing angle 90°")
    )
    assert (
        "note: cells are 0.5 m wide, as those of the map; ial bounce advise"
        in ial("bounce", "build", plan, "--resolution", 0.5, "--out", "small.npz", "--overwrite").stderr
    )
    assert ial("bounce", "simulate", plan, "--resolution", "1/2", "--steps", 5, "--out", "stream.txt").exit_code == 0
    assert ial("bounce", "search-angle", plan, "--resolution", "1/2", "--headings", 4).exit_code == 0
    assert ial("bounce", "show", plan, "--resolution", "1/2", "--cell", 1, "--out", "a.png").exit_code == 0
    assert ial("bounce", "show", "small.npz", plan, "--resolution", "1/2", "--what", "basins", "--out", "b.png").exit_code == 0
    assert ial("bounce", "advise", plan, "--resolution", "1/2", "--radius", "1/2", "--most-states", 500).exit_code == 0


@pytest.mark.parametrize("command", ["build", "simulate", "search-angle", "show", "advise"])
def test_a_resolution_is_asked_for_where_it_is_needed_and_nowhere_else(
    refused: Callable[..., str], hall: Path, plan: Path, command: str
) -> None:
    out = () if command in ("search-angle", "advise") else ("--out", "out.xyz")
    assert "plan.png: a picture does not say how large it is; give its resolution" in refused("bounce", command, plan, *out)
    assert "no environment is a picture; leave it out" in refused("bounce", command, hall, "--resolution", "0.1", *out)
    assert "--resolution: 'wide' is no number" in refused("bounce", command, plan, "--resolution", "wide", *out)
    assert "tolerance of a simplification is -1 m" in refused("bounce", command, hall, "--simplify=-1", *out)
    assert "hall: every part of the free space is narrower than 9 m" in refused("bounce", command, hall, "--simplify", "9", *out)


def test_the_embedded_map_has_a_name(ial: Cli, refused: Callable[..., str]) -> None:
    record = json.loads(ial("bounce", "build", "sample", "--cell", "1/2", "--radius", "1/4", "--out", "f.npz", "--json").stdout)
    assert record["environments"] == ["sample"]
    written = json.loads(ial("bounce", "build", sample_map_path(), "--cell", "1/2", "--radius", "1/4", "--out", "g.npz", "--json").stdout)
    assert {**written, "environments": ["sample"]} == {**record, "knowledge_cycles": written["knowledge_cycles"]}
    Path("sample").mkdir()
    assert "sample is the name of the embedded map, and a file or folder here has it, too" in refused("bounce", "advise", "sample")


def test_fewer_walls_are_told_and_a_filter_is_drawn_on_them(ial: Cli, refused: Callable[..., str]) -> None:
    y, x = np.mgrid[:60, :80]
    cells = np.where((x + 2 * y > 30) & (x > 2) & (x < 78) & (y > 2) & (y < 58), FREE, OCCUPIED).astype(np.uint8)
    cells[30, 40] = OCCUPIED
    cells[0, 0] = FREE
    write_map(OccupancyGrid(cells, 0.1), Path("slope.yaml"))
    command = ("bounce", "build", "slope.yaml", "--cell", "1/2", "--radius", "1/4", "--simplify", "0.2")
    first, second = ial(*command, "--out", "f.npz").stdout.splitlines()[:2]
    record = json.loads(ial(*command, "--out", "g.npz", "--json").stdout)["simplified"]["slope"]
    expected = simplified(load_environment("slope.yaml"), Fraction(1, 5))
    assert (record["walls_before"], record["walls"]) == expected.walls
    assert record["moved_m"] == float(expected.moved_m)
    before, left = expected.walls
    assert first == f"slope: simplified by 0.2 m, {left} of {before} walls are left, moved by up to {float(expected.moved_m):.9g} m"
    assert second == "slope: left out 1 narrow part of the free space (0.01 m²) and 1 small obstacle (0.01 m²)"
    assert ial("bounce", "show", "f.npz", "slope.yaml", "--simplify", "0.2", "--what", "basins", "--out", "a.png").exit_code == 0
    message = refused("bounce", "show", "f.npz", "slope.yaml", "--what", "basins", "--out", "b.png")
    assert "the environment is not the one the filter was built from" in message
    # A disk does not fit into a part that is wider than the tolerance, and a point does.
    cells[20:24, :2] = FREE
    write_map(OccupancyGrid(cells, 0.1), Path("slot.yaml"))
    for radius, parts in (("0", 1), ("1/4", 2)):
        made = ial(
            "bounce", "build", "slot.yaml", "--cell", "1/2", "--radius", radius, "--simplify", "0.1", "--out", f"{parts}.npz", "--json"
        )
        assert json.loads(made.stdout)["simplified"]["slot"]["left_out_parts"] == parts


def test_steps_beside_those_of_a_robot_are_told(ial: Cli, hall: Path) -> None:
    said = "steps of the cell map are not those of a robot: "
    assert said not in ial("bounce", "build", hall, "--angle", 90, "--out", "a.npz").stdout
    result = ial("bounce", "build", hall, "--angle", 22.5, "--out", "b.npz")
    assert said + "up to 22.5° aside, lengths up to 41.5 % off\n" in result.stdout
    record = json.loads(ial("bounce", "build", hall, "--angle", 22.5, "--out", "c.npz", "--json").stdout)
    assert record["offset_error_deg"] == 22.5
    assert record["offset_error"] == pytest.approx(2**0.5 - 1)
    finer = ial("bounce", "build", hall, "--angle", 22.5, "--cell", "1/16", "--step", 1, "--out", "d.npz").stdout
    # 16 cells at 22.5° are (14.78, 6.12), rounded (15, 6), 21.8°; at 45° (11.3, 11.3), rounded (11, 11), 15.56 cells.
    assert said + "up to 0.7° aside, lengths up to 2.8 % off\n" in finer


@pytest.mark.parametrize(
    "options", [("--radius", "1/2"), ("--angle", 100, "--turn-error", 2, "--step-error", "0.02", "--count-error", 1), ("--step", "1/2")]
)
def test_what_is_advised_can_be_built_and_is_what_was_said(ial: Cli, hall: Path, options: tuple[object, ...]) -> None:
    record = json.loads(ial("bounce", "advise", hall, *options, "--json").stdout)
    (row,) = [each for each in (*record["cells"], *record["rays"]) if each["advised"]]
    printed = ial("bounce", "advise", hall, *options).stdout.splitlines()
    assert printed[-1] == record["command"]
    assert printed[-2] == f"take the row marked *: {record['reason']}"
    (marked,) = [line for line in printed if line.startswith("* ")]
    assert f"{row['flash_bytes']:,}" in marked.split()
    assert ial(*shlex.split(record["command"])[1:]).exit_code == 0
    made = read_filter(Path("hall.npz"))
    if isinstance(made, PieceFilter):
        tables = PieceTables.of(made.map, "bounce")
        assert (row["pieces"], row["flash_bytes"], row["ram_bytes"]) == (len(made.map), tables.flash_bytes, tables.ram_bytes)
    else:
        assert isinstance(made, BounceFilter)
        assert row["states"] == len(made.table) - 1
        assert row["flash_bytes"] == CTables.of(ExportedFilter.of(made), "bounce").flash_bytes


def test_advice_that_cannot_be_given_says_so(ial: Cli, hall: Path, refused: Callable[..., str]) -> None:
    result = ial("bounce", "advise", hall, "--radius", "9", "--turn-error", 1)
    assert result.exit_code == 0
    assert "take none of these: there is no exact filter here; a robot of radius 9 m fits nowhere" in result.stdout
    record = json.loads(ial("bounce", "advise", hall, "--radius", "1/2", "--turn-error", 1, "--most-states", 9, "--json").stdout)
    assert "--radius 1/2" in record["command"]
    assert {each["more_than_states"] for each in record["cells"]} == {9}
    assert ial("bounce", "advise", hall, "--radius", "1/2", "--turn-error", 1, "--most-states", 9).stdout.count("> 9 ") == 8
    assert "multiple of 360°" in refused("bounce", "advise", hall, "--angle", "360")
    assert "radius of the robot is -1" in refused("bounce", "advise", hall, "--radius=-1")


def test_progress_is_shown_on_a_terminal_alone(ial: Cli, hall: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert "states" not in ial("bounce", "build", hall, "--out", "a.npz").stderr
    seen: list[tuple[float, float | None]] = []
    update = Progress.update

    def watched(bar: Progress, task: Any, **how: Any) -> None:
        seen.append((how["completed"], how["total"]))
        update(bar, task, **how)

    monkeypatch.setattr(Progress, "update", watched)
    monkeypatch.setattr(terminal, "err", Console(file=io.StringIO(), force_terminal=True))
    record = json.loads(ial("bounce", "build", hall, "--out", "b.npz", "--json").stdout)
    assert seen == [(record["states"], None)]
    seen.clear()
    ial("bounce", "build", hall, "--rays", "--out", "c.npz")
    assert len(seen) > 1
    assert seen == [(done, len(seen)) for done in range(1, len(seen) + 1)]


def test_a_start_of_which_something_is_known_is_used(ial: Cli, hall: Path, refused: Callable[..., str]) -> None:
    known = ("--region", "7,1,8,2", "--heading", "80,100")
    cells = ("--angle", 90, "--cell", 1, "--out", "c.npz")
    anywhere = ial("bounce", "build", hall, *cells).stdout
    assert ial("bounce", "build", hall, *cells, *known, "--overwrite").exit_code == 0
    record = json.loads(ial("bounce", "build", hall, *cells, *known, "--overwrite", "--json").stdout)
    assert record["configurations"] == 1
    assert "196 configurations" in anywhere
    assert "the filter knows where the robot started" in refused("bounce", "run", "c.npz", "--stream", "0001", "--restart")
    assert "the filter knows where the robot started" in refused("bounce", "export", "c.npz", "--restart", "--out", "c.h")
    assert ial("bounce", "export", "c.npz", "--out", "c.h").exit_code == 0
    assert "something is known" in Path("c.h").read_text()

    assert ial("bounce", "build", hall, *REAL, *ROOMS, *known, "--out", "p.npz").exit_code == 0
    told = json.loads(ial("bounce", "run", "p.npz", "--stream", "0" * 9 + "1", "--json").stdout)
    assert (told["room"], told["localized_at"]) == ("right", 10)
    gone = ial("bounce", "run", "p.npz", "--stream", "0" * 20)
    assert "rejected at observation" in gone.stdout
    carried = json.loads(ial("bounce", "run", "p.npz", "--stream", "0" * 20 + "1", "--restart", "--json").stdout)
    assert carried["pieces"] == 10944, "it may be anywhere then"
    assert ial("bounce", "export", "p.npz", "--out", "p.h").exit_code == 0
    assert "is where it was said to start" in Path("p.h").read_text()
    assert "can start in no configuration" in refused("bounce", "build", hall, "--cell", 1, "--region", "20,1,21,2", "--out", "n.npz")
    assert "can have started nowhere" in refused("bounce", "build", hall, "--rays", "--region", "20,1,21,2", "--out", "n.npz")
    assert "X0,Y0,X1,Y1" in refused("bounce", "build", hall, "--region", "20,1", "--out", "n.npz")
    assert "FROM,TO" in refused("bounce", "build", hall, "--heading", "20", "--out", "n.npz")
    assert "ends before it begins" in refused("bounce", "build", hall, "--heading", "20,10", "--out", "n.npz")


def test_a_set_filter_is_exported_as_plain_arrays(ial: Cli, sets: Path) -> None:
    assert "10944 pieces of walls in a.npz" in ial("bounce", "export", sets, "--out", "a.npz").stdout
    with np.load("a.npz") as arrays:
        assert arrays["arc_start"].shape == (10945,)
        assert arrays["box_m"].shape == (152, 4)
        assert len(arrays["arc_part"]) == len(arrays["arc_least"]) == len(arrays["arc_most"]) == 42182
        assert len(arrays["first"]) == 0
        assert arrays["turn"].tolist() == [19, 21]


def test_any_angle_that_is_built_can_be_run(ial: Cli, hall: Path, refused: Callable[..., str]) -> None:
    assert (
        ial("bounce", "build", hall, "--rays", "--angle", "360000000000100", "--part", 1, "--headings", 36, "--out", "x.npz").exit_code == 0
    )
    assert "after 5 observations" in ial("bounce", "run", "x.npz", "--stream", "00011").stdout
    assert "a leg would take more than" in refused("bounce", "simulate", hall, "--step", "1e-9", "--out", "s.txt")
