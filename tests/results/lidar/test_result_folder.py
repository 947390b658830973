import hashlib
import json
import os
from pathlib import Path
from typing import Any

import pytest

from ial.errors import OutputError
from ial.results.lidar.enclosures import EnclosuresFile
from ial.results.lidar.result_folder import ResultFolder, written_by_a_run
from ial.results.lidar.trajectory import TrajectoryFile


class Faulty:
    """A sink that fails."""

    def __init__(self, when: str) -> None:
        self.when = when

    def __enter__(self) -> "Faulty":
        return self

    def add(self, step: Any, estimate: Any) -> None:
        if self.when == "add":
            raise OSError(28, "No space left on device")

    def __exit__(self, *fault: object) -> None:
        if self.when == "exit":
            raise OSError(28, "No space left on device")


def test_files_appear_at_the_end(sample_run: list[Any], tmp_path: Path) -> None:
    out = tmp_path / "new" / "run"
    with ResultFolder(out) as folder:
        folder.attach(TrajectoryFile(folder.place("trajectory.tum")), EnclosuresFile(folder.place("enclosures.jsonl")))
        for step, estimate in sample_run:
            folder.add(step, estimate)
        folder.write("note.txt", "done")
        folder.close()
        assert [file for file in out.iterdir() if not file.name.startswith(".")] == []
    assert sorted(file.name for file in out.iterdir()) == ["enclosures.jsonl", "note.txt", "trajectory.tum"]


@pytest.mark.parametrize("interruption", [KeyboardInterrupt, ValueError])
def test_an_interrupted_run_leaves_nothing(sample_run: list[Any], tmp_path: Path, interruption: type[BaseException]) -> None:
    out = tmp_path / "new" / "run"

    def run() -> None:
        with ResultFolder(out) as folder:
            folder.attach(TrajectoryFile(folder.place("trajectory.tum")), EnclosuresFile(folder.place("enclosures.jsonl")))
            folder.add(*sample_run[-1])
            raise interruption

    with pytest.raises(interruption):
        run()
    assert list(tmp_path.iterdir()) == []


def test_an_interrupted_run_leaves_an_earlier_one_alone(tmp_path: Path) -> None:
    (tmp_path / "summary.json").write_text("earlier")

    def run() -> None:
        with ResultFolder(tmp_path) as folder:
            folder.write("summary.json", "half")
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run()
    assert [(file.name, file.read_text()) for file in tmp_path.iterdir()] == [("summary.json", "earlier")]


def conclude(path: Path, note: str) -> None:
    with ResultFolder(path) as folder:
        folder.write("a.txt", note)
        folder.write("z.txt", note)
        folder.conclude("record.json", {"note": note})


def test_a_run_knows_its_files_again_until_they_are_changed(tmp_path: Path) -> None:
    names = ["record.json", "a.txt", "z.txt"]
    assert written_by_a_run(tmp_path, names) == set()
    conclude(tmp_path, "first")
    record = json.loads((tmp_path / "record.json").read_text())
    assert record == {"note": "first", "files": {name: hashlib.sha256(b"first").hexdigest() for name in names[1:]}}
    assert written_by_a_run(tmp_path, names) == set(names)
    assert written_by_a_run(tmp_path, [*names, "b.txt"]) == set(), "a record of something else"
    (tmp_path / "a.txt").write_text("Qirst")
    assert written_by_a_run(tmp_path, names) == {"record.json", "z.txt"}
    (tmp_path / "a.txt").unlink()
    assert written_by_a_run(tmp_path, names) == {"record.json", "z.txt"}
    (tmp_path / "record.json").unlink()
    assert written_by_a_run(tmp_path, names) == set()


def test_no_record_stands_beside_files_of_two_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    conclude(tmp_path, "first")
    replace = Path.replace

    def torn(self: Path, target: Path) -> Path:
        if target.name == "z.txt":
            raise OSError(28, "No space left on device")
        return replace(self, target)

    monkeypatch.setattr(Path, "replace", torn)
    with pytest.raises(OutputError, match="No space left"):
        conclude(tmp_path, "second")
    assert {file.name: file.read_text() for file in tmp_path.iterdir()} == {"a.txt": "second", "z.txt": "first"}


@pytest.mark.parametrize("when", ["add", "exit"])
def test_a_full_disk_is_said_and_leaves_nothing(sample_run: list[Any], tmp_path: Path, when: str) -> None:
    out = tmp_path / "run"

    def run() -> None:
        with ResultFolder(out) as folder:
            folder.write("first.txt", "complete")
            folder.attach(Faulty(when))
            folder.add(*sample_run[0])

    with pytest.raises(OutputError, match=r"run: the results cannot be written \(No space left on device\)"):
        run()
    assert list(tmp_path.iterdir()) == []


def test_a_file_in_the_place_of_the_folder(tmp_path: Path) -> None:
    (tmp_path / "run").write_text("a file")
    with pytest.raises(OutputError, match=r"run: results cannot be written there .*--out"):
        ResultFolder(tmp_path / "run")
    with pytest.raises(OutputError, match=r"deeper: results cannot be written there .*--out"):
        ResultFolder(tmp_path / "run" / "deeper")
    assert (tmp_path / "run").read_text() == "a file"


@pytest.mark.skipif(os.geteuid() == 0, reason="nothing is forbidden to root")
def test_a_folder_without_permission(tmp_path: Path) -> None:
    tmp_path.chmod(0o500)
    with pytest.raises(OutputError, match="Permission denied"):
        ResultFolder(tmp_path / "run")


def test_a_file_that_has_come_into_being_meanwhile_is_not_replaced(tmp_path: Path) -> None:
    (tmp_path / "old.txt").write_text("of an earlier run")
    folder = ResultFolder(tmp_path)
    folder.write("old.txt", "new")
    folder.write("new.txt", "of this run")
    (tmp_path / "new.txt").write_text("mine")
    with pytest.raises(OutputError, match="has come into being") as caught:
        folder.__exit__(None, None, None)
    assert (tmp_path / "new.txt").read_text() == "mine"
    assert (tmp_path / "old.txt").read_text() == "of an earlier run"
    assert folder.place("new.txt").read_text() == "of this run"
    assert str(folder.place("new.txt")) in str(caught.value)
