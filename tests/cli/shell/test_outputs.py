"""The one rule about what commands write: nothing that exists is replaced unasked, and nothing that is read ever is."""

import inspect
import json
import os
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
import typer

from ial.cli.active.job import FILES as EXPLORE_FILES
from ial.cli.lidar import stream
from ial.cli.lidar.bounds import _FILES as BOUNDS_FILES
from ial.cli.main import app
from ial.datasets.sample import sample_map_path, sample_recording_path
from ial.results.lidar.run_results import FILES

Cli = Callable[..., Any]
Refused = Callable[..., str]

MINE = b"what nobody may lose\n"
SAMPLE, MAP = sample_recording_path(), sample_map_path()

WRITERS: dict[str, tuple[list[object], list[str]]] = {  # a command, and what it writes
    "convert": (["convert", SAMPLE, "new.mcap"], ["new.mcap"]),
    "convert --jsonl": (["convert", "--jsonl", "new.jsonl"], ["new.jsonl"]),
    "kidnap": (["kidnap", SAMPLE, "new.bag", "--at", "2:30"], ["new.bag"]),
    "kidnap --truth": (["kidnap", SAMPLE, "new.mcap", "--at", "2:30", "--truth", "old.tum"], ["new.mcap", "new.tum"]),
    "simulate": (["simulate", "--map", "room.yaml", "--out", "new.mcap", "--scans", 2, "--beams", 3], ["new.mcap", "new.tum"]),
    "where": (["where", "--map", MAP, "--to", 1, "--out", "new.jsonl"], ["new.jsonl"]),
    "stream": (["stream", SAMPLE, "--map", MAP, "--out", "new.jsonl"], ["new.jsonl"]),
    "stream --state": (["stream", SAMPLE, "--map", MAP, "--out", "new.jsonl", "--state", "state"], ["new.jsonl"]),
    "bounce build": (["bounce", "build", "hall.wkt", "--out", "new.npz"], ["new.npz"]),
    "bounce export": (["bounce", "export", "hall.npz", "--out", "new.v"], ["new.v", "new.hex"]),
    "bounce show": (["bounce", "show", "hall.npz", "--out", "new.png"], ["new.png"]),
    "bounce simulate": (["bounce", "simulate", "hall.wkt", "--out", "new.txt", "--truth", "new.csv"], ["new.txt", "new.csv"]),
    "compass plan": (["compass", "plan", "hall.wkt", "--out", "new.json"], ["new.json"]),
    "compass show": (["compass", "show", "hall.json", "--out", "new.png"], ["new.png"]),
    "odometer show": (["odometer", "show", "hall.wkt", "--start", "1,1,30", "--out", "new.png"], ["new.png"]),
    "explore": (["explore", "--map", "room.yaml", "--drives", 0, "--out", "run"], [f"run/{name}" for name in EXPLORE_FILES]),
    "explore --animate": (["explore", "--map", "room.yaml", "--drives", 0, "--out", "run", "--animate", "new.gif"], ["new.gif"]),
    "localize": (["localize", "--to", 1, "--out", "run"], [f"run/{name}" for name in FILES]),
    "bounds": (["bounds", "--to", 3, "--out", "run"], [f"run/{name}" for name in BOUNDS_FILES]),
}


@pytest.fixture
def inputs(ial: Cli, room: Path) -> None:
    """What the commands read."""
    assert room.exists()
    Path("old.tum").write_text("1137772793.094853 0 0 0 0 0 0 1\n")
    Path("hall.wkt").write_text("POLYGON ((0 0, 3 0, 3 2, 0 2, 0 0))")
    assert ial("bounce", "build", "hall.wkt", "--out", "hall.npz").exit_code == 0
    assert ial("compass", "plan", "hall.wkt", "--out", "hall.json").exit_code == 0


@pytest.mark.slow
@pytest.mark.usefixtures("inputs")
@pytest.mark.parametrize("writer", WRITERS)
def test_what_exists_is_replaced_only_on_request(ial: Cli, refused: Refused, writer: str) -> None:
    command, written = WRITERS[writer]
    for name in written:
        path = Path(name)
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(MINE)
        assert "--overwrite" in refused(*command)
        assert path.read_bytes() == MINE
        path.unlink()
        path.symlink_to("nowhere")
        assert "--overwrite" in refused(*command)
        assert path.is_symlink()
        path.unlink()
    for name in written:
        Path(name).write_bytes(MINE)
    result = ial(*command, "--overwrite")
    assert result.exit_code in (0, 3), result.stderr
    assert all(Path(name).read_bytes() != MINE for name in written)
    assert all(not path.name.endswith(".part") and not path.name.startswith(".unfinished") for path in Path().rglob("*"))


@pytest.mark.usefixtures("inputs")
@pytest.mark.parametrize("writer", WRITERS)
def test_what_is_no_file_is_never_replaced(refused: Refused, writer: str) -> None:
    command, written = WRITERS[writer]
    for name in written:
        path = Path(name)
        path.parent.mkdir(exist_ok=True)
        for make, remove, message in ((path.mkdir, path.rmdir, "is a folder"), (lambda path=path: os.mkfifo(path), path.unlink, "a pipe")):
            make()
            assert message in refused(*command, "--overwrite")
            remove()


def commands(group: typer.Typer, above: str = "") -> Iterator[tuple[str, set[str]]]:
    """Yield each command with the names of its parameters."""
    for command in group.registered_commands:
        assert command.callback is not None
        yield f"{above}{command.name}", set(inspect.signature(command.callback).parameters)
    for inner in group.registered_groups:
        assert inner.typer_instance is not None
        yield from commands(inner.typer_instance, f"{above}{inner.name} ")


def test_every_command_that_writes_is_tried_above() -> None:
    parameters = dict(commands(app))
    writing = {name for name, given in parameters.items() if given & {"out", "target", "lines", "overwrite"}}
    assert {name for name in writing if "overwrite" not in parameters[name]} == set()
    assert "--overwrite" in stream._parser().format_help()
    assert writing | {"stream"} == {name.partition(" --")[0] for name in WRITERS}


@pytest.mark.parametrize("kind", ["itself", "link", "hard link", "around", "link to the folder"])
@pytest.mark.parametrize(
    ("read", "command"),
    [
        ("sample.mcap", ["convert", "sample.mcap"]),
        ("sample.mcap", ["convert", "sample.mcap", "--jsonl"]),
        ("sample.mcap", ["kidnap", "sample.mcap", "--at", "10:25"]),
        ("room.yaml", ["simulate", "--map", "room.yaml", "--out"]),
        ("room.pgm", ["simulate", "--map", "room.yaml", "--out"]),
        ("config.yaml", ["simulate", "--map", "room.yaml", "--config", "config.yaml", "--out"]),
        ("room.pgm", ["where", "sample.mcap", "--map", "room.yaml", "--out"]),
        ("bag/part.mcap", ["where", "bag", "--map", "room.yaml", "--out"]),
        ("room.pgm", ["bounce", "build", "room.yaml", "--out"]),
        ("sample.mcap", ["stream", "sample.mcap", "--map", "room.yaml", "--out"]),
        ("bag/part.mcap", ["stream", "bag", "--map", "room.yaml", "--out"]),
        ("room.yaml", ["stream", "sample.mcap", "--map", "room.yaml", "--out"]),
        ("room.pgm", ["stream", "sample.mcap", "--map", "room.yaml", "--out"]),
        ("config.yaml", ["stream", "sample.mcap", "--map", "room.yaml", "--config", "config.yaml", "--out"]),
        ("sample.mcap", ["stream", "sample.mcap", "--map", "room.yaml", "--state"]),
        ("room.pgm", ["stream", "sample.mcap", "--map", "room.yaml", "--state"]),
    ],
)
def test_what_is_read_is_never_replaced(refused: Refused, room: Path, read: str, command: list[str], kind: str) -> None:
    Path("sample.mcap").write_bytes(SAMPLE.read_bytes())
    Path("config.yaml").write_text("max_beams: 9\n")
    Path("bag").mkdir()
    Path("bag/metadata.yaml").write_text("")
    Path("bag/part.mcap").write_bytes(MINE)
    given, held = Path(read), Path(read).read_bytes()
    out = Path(f"other{given.suffix}")
    if kind == "itself":
        out = given
    elif kind == "link":
        out.symlink_to(given)
    elif kind == "hard link":
        out.hardlink_to(given)
    elif kind == "around":
        out = Path("bag") / ".." / "bag" / ".." / given
    else:
        Path("here").symlink_to(room.parent)
        out = "here" / given
    assert "an input of the command" in refused(*command, out, "--overwrite")
    assert given.read_bytes() == out.read_bytes() == held


@pytest.mark.slow
@pytest.mark.parametrize(("command", "files"), [("localize", FILES), ("bounds", BOUNDS_FILES)])
def test_the_results_of_a_run_are_replaced_together_and_that_is_said(
    ial: Cli, refused: Refused, command: str, files: tuple[str, ...]
) -> None:
    run = Path("run")
    first = ial(command, "--to", 3, "--out", run)
    assert "earlier run" not in first.stderr
    (run / "notes.txt").write_bytes(MINE)
    before = {name: (run / name).stat().st_ino for name in files}
    again = ial(command, "--to", 4, "--out", run)
    said = again.stderr.splitlines()[0]
    assert (again.exit_code, said) == (first.exit_code, "note: run: these results are in the place of those of an earlier run")
    assert {name for name in files if (run / name).stat().st_ino == before[name]} == set()
    assert sorted(path.name for path in run.iterdir()) == sorted((*files, "notes.txt"))
    assert (run / "notes.txt").read_bytes() == MINE
    for name in files[1:]:  # what somebody has changed is no result any more
        kept = (run / name).read_bytes()
        (run / name).write_bytes(kept + b"\n")
        assert f"run: {name} there is not, or not any more," in refused(command, "--to", 3, "--out", run)
        assert (run / name).read_bytes() == kept + b"\n"
        (run / name).write_bytes(kept)
    assert "an input of the command" in refused(command, "--to", 3, "--config", "run/config.yaml", "--out", run, "--overwrite")


@pytest.mark.slow
def test_a_folder_of_another_command_or_program_is_not_taken_for_a_result(ial: Cli, refused: Refused) -> None:
    assert ial("bounds", "--to", 3, "--out", "found").exit_code == 0
    assert "found: config.yaml, picture.png there are not" in refused("localize", "--to", 1, "--out", "found")
    Path("found/bounds.json").unlink()
    assert "config.yaml, failures.npz, picture.png there are not" in refused("bounds", "--to", 3, "--out", "found")
    for record in ("{", "[]", '{"files": 3}', '{"files": {}}', json.dumps({"files": dict.fromkeys(FILES[1:], "0" * 64)})):
        Path("run").mkdir(exist_ok=True)
        Path("run/summary.json").write_text(record)
        Path("run/picture.png").write_bytes(MINE)
        assert "picture.png there " in refused("localize", "--to", 1, "--out", "run")
        assert (Path("run/summary.json").read_text(), Path("run/picture.png").read_bytes()) == (record, MINE)


def test_a_folder_in_which_nothing_may_be_written_is_found_out_before_any_work(refused: Refused, tmp_path: Path) -> None:
    assert "cannot be written" in refused("convert", "missing.bag", tmp_path / ("long" * 99) / "a.mcap")
    if os.geteuid():
        Path("closed").mkdir(mode=0o500)
        assert "nothing may be written in its folder" in refused("convert", "missing.bag", "closed/a.mcap")


@pytest.mark.slow
def test_only_a_link_of_ones_own_is_turned_to_the_latest_run(ial: Cli, tmp_path: Path) -> None:
    Path("out").mkdir()
    Path("out/latest").symlink_to(tmp_path)
    ial("localize", "--to", 1)
    assert Path("out/latest").readlink() == tmp_path
