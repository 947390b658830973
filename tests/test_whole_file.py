import os
from pathlib import Path

import pytest

from ial.errors import OutputError
from ial.whole_file import rewrite, unfinished, whole_files


def content(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def test_files_get_their_names_together_at_the_end(tmp_path: Path) -> None:
    (tmp_path / "a").write_bytes(b"old")
    with whole_files(tmp_path / "a", tmp_path / "b") as (a, b):
        a.write_bytes(b"new")
        b.write_bytes(b"beside")
        assert (tmp_path / "a").read_bytes() == b"old"
        assert not (tmp_path / "b").exists()
    assert content(tmp_path) == {"a": b"new", "b": b"beside"}


@pytest.mark.parametrize("error", [KeyboardInterrupt, ValueError])
def test_an_error_leaves_everything_as_it_was(tmp_path: Path, error: type[BaseException]) -> None:
    (tmp_path / "a").write_bytes(b"old")

    def write() -> None:
        with whole_files(tmp_path / "a", tmp_path / "b") as (a, _):
            a.write_bytes(b"half")
            raise error

    with pytest.raises(error):
        write()
    assert content(tmp_path) == {"a": b"old"}


def test_what_cannot_be_written_is_known_before_the_first_name_is_given(tmp_path: Path) -> None:
    (tmp_path / "a").write_bytes(b"old")
    (tmp_path / "b").mkdir()
    for beside in (tmp_path / "b", tmp_path / "nowhere" / "c"):
        with (
            pytest.raises(OutputError, match=f"{beside}: the pair cannot be written"),
            whole_files(tmp_path / "a", beside, what="the pair"),
        ):
            pytest.fail("the block is not entered")
    assert (tmp_path / "a").read_bytes() == b"old"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a", "b"]


def test_a_file_that_is_called_like_a_part_is_not_touched(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "urandom", bytes)  # zeros
    (tmp_path / ".a-00000000.part").write_bytes(b"mine")
    with pytest.raises(OutputError, match="File exists"), whole_files(tmp_path / "a"):
        pytest.fail("the block is not entered")
    assert content(tmp_path) == {".a-00000000.part": b"mine"}


def test_files_are_as_readable_as_the_user_wants_them(tmp_path: Path) -> None:
    before = os.umask(0o027)
    try:
        with whole_files(tmp_path / "a") as (a,):
            a.write_bytes(b"new")
    finally:
        os.umask(before)
    assert (tmp_path / "a").stat().st_mode & 0o777 == 0o640


def test_what_is_replaced_often_takes_up_what_a_killed_process_has_left(tmp_path: Path) -> None:
    path, mine = tmp_path / "state", tmp_path / "mine"
    mine.write_bytes(b"mine")
    unfinished(path).symlink_to(mine)
    for new in (b"first", memoryview(b"second")):
        rewrite(path, new, "the state")
        assert content(tmp_path) == {"state": bytes(new), "mine": b"mine"}
        unfinished(path).write_bytes(b"half")
    with pytest.raises(OutputError, match="the state cannot be written"):
        rewrite(tmp_path / "nowhere" / "state", b"", "the state")


def test_what_has_come_into_being_meanwhile_is_left_alone_and_so_is_the_result(tmp_path: Path) -> None:
    lending = whole_files(tmp_path / "a", tmp_path / "b")
    one, two = lending.__enter__()
    one.write_bytes(b"1")
    two.write_bytes(b"2")
    (tmp_path / "b").write_bytes(b"mine")
    with pytest.raises(OutputError, match="has come into being") as caught:
        lending.__exit__(None, None, None)
    assert (tmp_path / "b").read_bytes() == b"mine"
    assert not (tmp_path / "a").exists()
    assert (one.read_bytes(), two.read_bytes()) == (b"1", b"2")
    assert str(two) in str(caught.value)
