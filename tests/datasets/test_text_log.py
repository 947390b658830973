import gzip
from pathlib import Path

import pytest

from ial.datasets.text_log import lines, open_text
from ial.errors import RecordingError

TEXT = b"O 0 0 0 0.1\r\nL 1 2\nthe last has no end"


@pytest.mark.parametrize("name", ["a.log", "a.log.gz", "a.txt"])
@pytest.mark.parametrize("compressed", [False, True])
def test_lines_keep_their_ends_and_the_name_decides_nothing(name: str, compressed: bool, tmp_path: Path) -> None:
    (tmp_path / name).write_bytes(gzip.compress(TEXT) if compressed else TEXT)
    assert list(lines(tmp_path / name)) == [b"O 0 0 0 0.1\r\n", b"L 1 2\n", b"the last has no end"]
    with open_text(tmp_path / name) as file:
        assert file.read() == TEXT


def test_an_empty_file_has_no_lines(tmp_path: Path) -> None:
    (tmp_path / "a.log").write_bytes(b"")
    assert list(lines(tmp_path / "a.log")) == []


@pytest.mark.parametrize("cut", [6, 20, -1])
def test_compressed_data_that_end_too_early_are_said_to(cut: int, tmp_path: Path) -> None:
    (tmp_path / "a.gz").write_bytes(gzip.compress(TEXT)[:cut])
    with pytest.raises(RecordingError, match=r"a\.gz: its gzip data are truncated or damaged .*gzip -dc"):
        list(lines(tmp_path / "a.gz"))


def test_what_cannot_be_read_is_named(tmp_path: Path) -> None:
    with pytest.raises(RecordingError, match=r"nowhere\.log: cannot be read \(No such file or directory\)"):
        list(lines(tmp_path / "nowhere.log"))
