"""`ial bounce run --log`, with logs that `ial bounce simulate --log` has written."""

import json
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from typer.testing import CliRunner

from ial.cli.main import app
from tests.cli.bounce.hall import ROOMS, WKT, Cli

CLOCK = ("--speed", "0.3", "--turn-time", "1.5", "--clock-error", "0.1")
ERRORS = ("--angle", 100, "--turn-error", 2, "--step-error", "0.02")
NO_TIME = ("--turn-time", 0, "--clock-error", 0)


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with an environment, a filter of pieces for robots with errors, and an exact one."""
    folder = tmp_path_factory.mktemp("made")
    (folder / "hall.wkt").write_text(WKT)
    build = ("bounce", "build", folder / "hall.wkt")
    for more in ((*ERRORS, "--count-error", 1, *ROOMS, "--out", folder / "sets.npz"), ("--radius", "1/2", "--out", folder / "exact.npz")):
        assert CliRunner().invoke(app, [*map(str, build), *map(str, more)]).exit_code == 0
    return folder


def simulated(ial: Cli, made: Path, seed: int, log: str, *more: object) -> None:
    result = ial("bounce", "simulate", made / "hall.wkt", *ERRORS, "--step", "1/4", "--seed", seed, "--log", log, *CLOCK, *more)
    assert result.exit_code == 0
    assert "a start and " in result.stdout


@pytest.mark.slow
def test_a_simulated_log_is_followed_and_the_truth_is_in_the_set(ial: Cli, made: Path) -> None:
    told = set()
    for seed in range(8):
        log = f"s{seed}.{'csv' if seed % 2 else 'jsonl'}"
        simulated(ial, made, seed, log, "--steps", 250, "--truth", "t.csv", "--overwrite")
        record = json.loads(ial("bounce", "run", made / "sets.npz", "--log", log, *CLOCK, "--speed-error", "0.02", "--json").stdout)
        (robot,) = record["robots"]
        bumps = [line.split(",") for line in Path("t.csv").read_text().splitlines()[1:] if line[0] == "1"]
        assert (robot["robot"], robot["bumps"], robot["rejected_at"]) == (None, len(bumps), [])
        x, y, box = float(bumps[-1][1]), float(bumps[-1][2]), robot["last_bump_m"]
        assert box["x0"] <= x <= box["x1"]
        assert box["y0"] <= y <= box["y1"]
        if robot["localized"]:
            assert (x <= 5) if robot["room"] == "left" else (x >= 5)
            told.add(robot["room"])
    assert told == {"left", "right"}


@pytest.fixture
def log(ial: Cli, made: Path) -> Path:
    """The log of a robot that is localized at its tenth bump of eighteen."""
    simulated(ial, made, 4, "bumps.csv", "--steps", 300)
    return Path("bumps.csv")


def test_text_tells_when_it_was_first_localized(ial: Cli, made: Path, log: Path) -> None:
    result = ial("bounce", "run", made / "sets.npz", "--log", log, *CLOCK)
    assert result.exit_code == 0
    assert result.stdout.startswith("after 18 bumps: localized in right, ")
    assert "\nfirst localized at bump 10, at 150.760 s\n" in result.stdout
    short = ial("bounce", "run", made / "sets.npz", "--log", log, *CLOCK, "--until-localized")
    assert short.stdout.startswith("after 10 bumps: localized in right, ")


def test_a_log_that_was_never_enough_has_status_3(ial: Cli, made: Path, log: Path) -> None:
    lines = log.read_text().splitlines(keepends=True)
    Path("few.csv").write_text("".join(lines[:4]))
    result = ial("bounce", "run", made / "sets.npz", "--log", "few.csv", *CLOCK)
    assert (result.exit_code, result.stdout.split(",")[0]) == (3, "after 2 bumps: not localized")
    Path("none.csv").write_text("".join(lines[:2]))
    result = ial("bounce", "run", made / "sets.npz", "--log", "none.csv", *CLOCK)
    assert (result.exit_code, result.stdout) == (3, "after 0 bumps: no bump yet\n")


def test_without_a_start_the_first_leg_is_not_timed(ial: Cli, made: Path, log: Path) -> None:
    lines = log.read_text().splitlines(keepends=True)
    Path("cut.csv").write_text("".join(lines[:1] + lines[2:]))
    assert "after 18 bumps: localized in right" in ial("bounce", "run", made / "sets.npz", "--log", "cut.csv", *CLOCK).stdout


def test_several_robots_have_an_outcome_each(ial: Cli, made: Path, log: Path) -> None:
    rows = [line.split(",") for line in log.read_text().splitlines()[1:]]
    both = [f"{time},{event},{name}\n" for time, event in rows for name in ("ann", "bob") if name == "ann" or float(time) < 60]
    Path("both.csv").write_text("time,event,robot\n" + "".join(both))
    result = ial("bounce", "run", made / "sets.npz", "--log", "both.csv", *CLOCK)
    assert result.exit_code == 3, "bob was never localized"
    assert "ann: after 18 bumps: localized in right" in result.stdout
    assert "bob: after 6 bumps: not localized" in result.stdout
    robots = json.loads(ial("bounce", "run", made / "sets.npz", "--log", "both.csv", *CLOCK, "--json").stdout)["robots"]
    assert [(each["robot"], each["bumps"], each["localized_at"]) for each in robots] == [("ann", 18, 10), ("bob", 6, None)]


def test_an_exact_filter_follows_a_disk_that_keeps_to_its_cells(ial: Cli, made: Path) -> None:
    disk = ("--angle", 90, "--radius", "1/2", "--start", "1/2", "13/2", 0, "--steps", 120)
    clock = ("--turn-time", 0, "--speed", "1/2", "--clock-error", "0.2")
    assert ial("bounce", "simulate", made / "hall.wkt", *disk, *clock, "--log", "d.csv", "--out", "d.txt").exit_code == 0
    assert Path("d.csv").read_text().splitlines()[1].endswith("start,0.5,6.5,0")
    stream = json.loads(ial("bounce", "run", made / "exact.npz", "--file", "d.txt", "--json").stdout)
    Path("cut.txt").write_text(Path("d.txt").read_text().replace("\n", "").rstrip("0"))
    stream = json.loads(ial("bounce", "run", made / "exact.npz", "--file", "cut.txt", "--json").stdout)
    (robot,) = json.loads(ial("bounce", "run", made / "exact.npz", "--log", "d.csv", *clock, "--json").stdout)["robots"]
    assert robot["localized"]
    assert {name: robot[name] for name in ("state", "places", "configurations")} == {
        name: stream[name] for name in ("state", "places", "configurations")
    }


def test_a_robot_that_is_elsewhere_is_rejected(ial: Cli, refused: Callable[..., str], made: Path) -> None:
    Path("away.csv").write_text("time,event\n0,start\n10,bump\n90,bump\n100,bump\n")
    run = ("bounce", "run", made / "sets.npz", "--log", "away.csv", *CLOCK)
    result = ial(*run)
    assert result.exit_code == 3
    assert "rejected at bump 2: no place in the environment fits" in result.stdout
    assert "after 3 bumps: not in the environment" in result.stdout
    assert "after 3 bumps: not localized" in ial(*run, "--restart").stdout
    assert "away.csv, line 4: bump 2 fits no place of the environment, but the world is closed" in refused(*run, "--world", "closed")


@pytest.mark.parametrize(
    ("more", "message"),
    [
        (("--log", "b.csv", "--speed", 1), "say with --turn-time how many seconds"),
        (("--log", "b.csv", "--speed", 1, "--turn-time", 0), "and with --clock-error by how many"),
        (("--log", "b.csv"), "give --speed, in metres per second"),
        (("--log", "b.csv", "--stream", "01", "--speed", 1, *NO_TIME), "one of --stream BITS, --file FILE and --log FILE"),
        (("--stream", "01", "--follow"), "are for a --log with times"),
        (("--stream", "01", "--speed", 1, *NO_TIME), "are for a --log with times"),
        (("--log", "nowhere.csv", "--speed", 1, *NO_TIME), "nowhere.csv: the log cannot be read"),
        (("--log", ".", "--speed", 1, *NO_TIME), "the log cannot be read"),
        (("--log", "b.txt", "--speed", 1, *NO_TIME), "b.txt: a log is named .csv"),
        (("--log", "b.csv", "--speed", 0, *NO_TIME), "the speed is 0 m/s"),
        (("--log", "b.csv", "--speed", "fast", *NO_TIME), "--speed: 'fast' is no number"),
        (("--log", "b.csv", "--speed", 1, "--turn-time", 0, "--clock-error", 1), "build one with --count-error 4"),
        (("--log", "b.csv", "--speed", 1, *NO_TIME, "--speed-error", "0.1"), "build one with --step-error 1/10"),
        (
            ("--log", "b.csv", "--speed", 1, "--turn-time", 2, "--clock-error", 0),
            "b.csv, line 4: the bump comes 1 s after the bump before it, too soon",
        ),
        (("--log", "twice.csv", "--speed", 1, *NO_TIME), "twice.csv, line 3: the robot starts a second time"),
        (("--log", "empty.csv", "--speed", 1, *NO_TIME), "empty.csv: the log holds no event"),
    ],
)
def test_what_cannot_be_meant_is_refused(refused: Callable[..., str], made: Path, more: tuple[object, ...], message: str) -> None:
    for name in ("b.csv", "b.txt"):
        Path(name).write_text("time,event\n0,start\n1,bump\n2,bump\n")
    Path("twice.csv").write_text("time,event\n0,start\n1,start\n")
    Path("empty.csv").write_text("")
    assert message in refused("bounce", "run", made / "sets.npz", *more)


def test_a_log_for_cells_begins_with_a_start(refused: Callable[..., str], made: Path) -> None:
    Path("b.csv").write_text("time,event\n1,bump\n")
    message = refused("bounce", "run", made / "exact.npz", "--log", "b.csv", "--speed", 1, *NO_TIME)
    assert "b.csv, line 2: a bump with no start before it" in message


@pytest.mark.parametrize(
    ("more", "message"),
    [
        ((), "give --out STREAM, --log FILE, or both"),
        (("--log", "b.csv"), "give --speed in metres per second, and --clock-error"),
        (("--log", "b.csv", "--speed", 1), "give --speed in metres per second, and --clock-error"),
        (("--log", "b.csv", "--speed", 1, "--clock-error", 0), "give --clock-error 1e-9 or more"),
        (("--log", "b.txt", "--speed", 1, "--turn-time", 0, "--clock-error", 1), "a log is named .csv"),
        (("--out", "s.txt", "--speed", 1), "are for a --log with times"),
        (("--log", "b.csv", "--speed", 1, "--clock-error", 1, "--truth", "b.csv"), "written twice"),
    ],
)
def test_simulations_that_cannot_be_meant_are_refused(
    refused: Callable[..., str], made: Path, more: tuple[object, ...], message: str
) -> None:
    assert message in refused("bounce", "simulate", made / "hall.wkt", *more)


Follower = Callable[..., subprocess.Popen[str]]


@pytest.fixture
def follower(made: Path) -> Iterator[Follower]:
    """Return a function that follows a log in a process, which does not outlive the test."""
    running: list[subprocess.Popen[str]] = []

    def start(log: object, *more: object) -> subprocess.Popen[str]:
        command = [sys.executable, "-c", "from ial.cli.entry import main; main()", "bounce", "run", made / "sets.npz", "--follow"]
        words = [*map(str, command), "--log", str(log), *CLOCK, *map(str, more)]
        pipe = subprocess.PIPE
        running.append(subprocess.Popen(words, stdin=pipe, stdout=pipe, stderr=pipe, text=True))
        return running[-1]

    yield start
    for each in running:
        each.kill()
        each.communicate()


@pytest.mark.slow
def test_a_log_that_grows_is_followed_until_it_is_interrupted(follower: Follower, ial: Cli, made: Path, log: Path) -> None:
    lines = log.read_text().splitlines(keepends=True)
    grows = Path("grows.csv")
    grows.write_text("".join(lines[:2]))
    running = follower(grows)
    assert running.stdout is not None
    with grows.open("a") as file:
        for number, line in enumerate(lines[2:14], 1):
            file.write(line[:4])
            file.flush()
            file.write(line[4:])
            file.flush()
            assert f" s, bump {number}: " in running.stdout.readline()
    running.send_signal(signal.SIGINT)
    said, faults = running.communicate(timeout=60)
    assert (running.returncode, faults) == (0, "")
    assert said == ial("bounce", "run", made / "sets.npz", "--log", grows, *CLOCK).stdout


@pytest.mark.slow
def test_standard_input_is_followed_until_it_ends(follower: Follower, log: Path) -> None:
    running = follower("-", "--json")
    said, _ = running.communicate("".join(log.read_text().splitlines(keepends=True)[:5]), timeout=60)
    records = [json.loads(line) for line in said.splitlines()]
    assert [each["bumps"] for each in records[:-1]] == [1, 2, 3]
    assert records[-1] == {"robots": [records[-2]]}
    assert running.returncode == 3


@pytest.mark.slow
def test_following_ends_when_all_robots_are_localized(follower: Follower, log: Path) -> None:
    running = follower(log, "--until-localized")
    said, _ = running.communicate(timeout=60)
    assert said.splitlines()[9].startswith("150.760 s, bump 10: localized in right")
    assert said.splitlines()[10].startswith("after 10 bumps: localized in right")
    assert running.returncode == 0


@pytest.mark.slow
def test_a_bad_line_ends_it_with_its_number(follower: Follower, log: Path) -> None:
    running = follower("-")
    said, faults = running.communicate("time,event\n0,start\n9,bump\n10,crash\n", timeout=60)
    assert "9.000 s, bump 1: not localized" in said
    assert "standard input, line 4: the event 'crash' is not known" in faults
    assert running.returncode == 2
