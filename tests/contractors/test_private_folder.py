import os
from collections.abc import Iterator
from pathlib import Path

import pytest

from ial.contractors.private_folder import NotPrivateError, is_own, make_private, read_private

STRANGER = 65534
needs_root = pytest.mark.skipif(os.geteuid() != 0, reason="only root can give files away")


@pytest.fixture(autouse=True)
def _generous_umask() -> Iterator[None]:
    before = os.umask(0)
    yield
    os.umask(before)


def folder_of_mode(path: Path, mode: int) -> Path:
    path.mkdir(exist_ok=True)
    path.chmod(mode)
    return path


def mode(path: Path) -> int:
    return path.stat().st_mode & 0o7777


def test_what_is_missing_is_made_for_this_user_alone(tmp_path: Path) -> None:
    folder = tmp_path / "a" / "b"
    make_private(folder)
    assert [mode(path) for path in (folder, folder.parent)] == [0o700, 0o700]
    make_private(folder)
    assert is_own(folder)


@pytest.mark.parametrize("writable", [0o770, 0o777, 0o707, 0o720, 0o702, 0o1777])
def test_a_folder_that_others_can_write_to_is_refused(tmp_path: Path, writable: int) -> None:
    folder = folder_of_mode(tmp_path / "open", writable)
    with pytest.raises(NotPrivateError, match=rf"open can be written to by others \(mode {writable:04o}; `chmod go-w` ends that\)"):
        make_private(folder)
    assert not is_own(folder)


@pytest.mark.parametrize("writable", [0o770, 0o777, 0o720, 0o702])
def test_so_is_a_folder_anywhere_in_one_that_others_can_write_to(tmp_path: Path, writable: int) -> None:
    parent = tmp_path / "open"
    make_private(parent / "a" / "b")
    parent.chmod(writable)
    for inner in (parent / "a", parent / "a" / "b", parent / "new", parent / "a" / "new"):
        with pytest.raises(NotPrivateError, match="open can be written to by others"):
            make_private(inner)
        assert not is_own(inner)
        assert inner.name != "new" or not inner.exists()


def test_a_sticky_folder_around_it_is_allowed(tmp_path: Path) -> None:
    folder = folder_of_mode(tmp_path / "sticky", 0o1777) / "inner"
    make_private(folder)
    assert is_own(folder)


@needs_root
def test_another_users_folder_is_refused_and_so_is_one_in_it(tmp_path: Path) -> None:
    parent = folder_of_mode(tmp_path / "theirs", 0o755)
    inner = folder_of_mode(parent / "inner", 0o755)
    os.chown(parent, STRANGER, STRANGER)
    for folder in (parent, inner, parent / "new"):
        with pytest.raises(NotPrivateError, match=f"theirs belongs to another user \\(number {STRANGER}\\)"):
            make_private(folder)
    assert not (parent / "new").exists()


@needs_root
def test_a_folder_of_root_is_trusted_and_no_own_one(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = folder_of_mode(tmp_path / "of root", 0o755)
    for path in (folder, *folder.parents):
        assert path.stat().st_uid == 0
    monkeypatch.setattr(os, "geteuid", lambda: STRANGER)
    make_private(folder)
    assert not is_own(folder)


def test_a_link_or_a_file_is_no_folder(tmp_path: Path) -> None:
    (tmp_path / "link").symlink_to(folder_of_mode(tmp_path / "folder", 0o700))
    (tmp_path / "file").touch()
    for name in ("link", "file", "link/new", "file/new"):
        with pytest.raises(NotADirectoryError, match="not a folder"):
            make_private(tmp_path / name)


def file_of_mode(path: Path, mode: int) -> Path:
    path.write_bytes(b"content")
    path.chmod(mode)
    return path


@pytest.mark.parametrize("harmless", [0o600, 0o400, 0o644])
def test_a_private_file_is_read(tmp_path: Path, harmless: int) -> None:
    assert read_private(file_of_mode(tmp_path / "file", harmless)) == b"content"


@pytest.mark.parametrize("writable", [0o660, 0o606, 0o666, 0o777])
def test_a_file_that_others_can_write_to_is_refused(tmp_path: Path, writable: int) -> None:
    with pytest.raises(NotPrivateError, match="can be written to by others"):
        read_private(file_of_mode(tmp_path / "file", writable))


@needs_root
def test_another_users_file_is_refused(tmp_path: Path) -> None:
    file = file_of_mode(tmp_path / "file", 0o644)
    os.chown(file, STRANGER, STRANGER)
    with pytest.raises(NotPrivateError, match="belongs to another user"):
        read_private(file)


def test_what_is_no_file_is_refused_at_once(tmp_path: Path) -> None:
    (tmp_path / "link").symlink_to(file_of_mode(tmp_path / "file", 0o600))
    os.mkfifo(tmp_path / "pipe", 0o600)
    (tmp_path / "folder").mkdir(0o700)
    for name in ("link", "pipe", "folder", "missing"):
        with pytest.raises(OSError, match=name):
            read_private(tmp_path / name)
