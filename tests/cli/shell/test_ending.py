import os
import signal
from pathlib import Path

import pytest

from ial.cli.shell.ending import Ending
from ial.errors import StreamError


def test_lines_of_a_file_end_with_it(tmp_path: Path) -> None:
    path = tmp_path / "a.txt"
    path.write_bytes(b"1\n2\n3")
    with Ending() as ending, path.open("rb") as file:
        assert list(ending.lines(file)) == [b"1\n", b"2\n", b"3"]


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
def test_work_at_hand_is_done_before_the_end(tmp_path: Path, number: int) -> None:
    path, done, before = tmp_path / "a.txt", [], signal.getsignal(number)
    path.write_bytes(b"1\n2\n")
    with Ending() as ending, path.open("rb") as file:
        for line in ending.growing_lines(file, "a.txt"):
            os.kill(os.getpid(), number)
            done.append(line)
    assert done == [b"1\n"]
    assert ending.wanted
    assert signal.getsignal(number) == before


def test_a_line_that_grows_is_given_when_it_is_complete(tmp_path: Path) -> None:
    path, given = tmp_path / "a.txt", []
    path.write_bytes(b"1\n2")
    with Ending() as ending, path.open("rb") as file:
        for line in ending.growing_lines(file, "a.txt"):
            given.append(line)
            with path.open("ab") as more:
                more.write(b"3\n4")
            if len(given) == 3:
                break
    assert given == [b"1\n", b"23\n", b"43\n"]


def test_a_file_that_becomes_shorter_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "a.txt"
    path.write_bytes(b"1\n2\n")
    with Ending() as ending, path.open("rb") as file:
        lines = ending.growing_lines(file, "a.txt")
        assert [next(lines), next(lines)] == [b"1\n", b"2\n"]
        path.write_bytes(b"")
        with pytest.raises(StreamError, match=r"a\.txt: the file has become shorter"):
            next(lines)
