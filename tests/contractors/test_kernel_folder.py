import errno
import os
import pwd
import random
from collections.abc import Callable
from pathlib import Path

import pytest

from ial.contractors import kernel_folder as module
from ial.contractors.kernel_folder import KernelFolder
from ial.contractors.private_folder import make_private

Find = Callable[[], Path | None]


@pytest.fixture
def folder(tmp_path: Path) -> KernelFolder:
    return KernelFolder(tmp_path)


@pytest.fixture
def find(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Find:
    """A function that looks for the folder anew, for a user whose home is in `tmp_path` and whose code is somebody else's."""
    for name in ("IAL_CACHE_DIR", "XDG_CACHE_HOME"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    monkeypatch.setattr(module, "is_own", lambda _: False)
    return lambda: module.kernel_folder.__wrapped__().path


def name() -> str:
    return f"kernels-{module.compiler_hash()}"


def test_what_was_written_is_read(folder: KernelFolder, tmp_path: Path) -> None:
    assert folder.read("one") is None
    folder.write("one", b"first")
    folder.write("one", b"second")
    folder.write("two", b"")
    assert (folder.read("one"), folder.read("two")) == (b"second", b"")
    assert {(path.name, path.stat().st_mode & 0o777) for path in tmp_path.iterdir()} == {("one", 0o600), ("two", 0o600)}


def test_a_torn_file_is_noticed_wherever_it_is_torn(folder: KernelFolder, tmp_path: Path) -> None:
    folder.write("one", os.urandom(1000))
    whole = (tmp_path / "one").read_bytes()
    generator = random.Random(17)
    torn = [whole[:length] for length in (0, 1, 31, 32, 33, 500, len(whole) - 1)]
    torn += [b"\0" * len(whole), whole[:512] + b"\0" * (len(whole) - 512), whole + b"\0", whole[1:]]
    for _ in range(20):
        at = generator.randrange(len(whole))
        torn.append(whole[:at] + bytes([whole[at] ^ 1 << generator.randrange(8)]) + whole[at + 1 :])
    for content in torn:
        (tmp_path / "one").write_bytes(content)
        with pytest.raises(ValueError, match=r"damaged: .*one"):
            folder.read("one")


def test_a_full_disk_is_said_once_and_leaves_nothing(
    folder: KernelFolder, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    folder.write("kept", b"content")

    def full(*_: object) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(Path, "replace", full)
    for content in (b"one", b"two"):
        folder.write("new", content)
    monkeypatch.undo()
    folder.write("new", b"three")
    assert [record.getMessage() for record in caplog.records] == [
        f"compiled kernels are no longer kept in {tmp_path}: No space left on device; IAL_CACHE_DIR may name another folder"
    ]
    assert [path.name for path in tmp_path.iterdir()] == ["kept"]
    assert (folder.keeps, folder.read("kept")) == (False, b"content")


def test_no_folder_keeps_nothing_and_holds_nothing() -> None:
    folder = KernelFolder(None)
    folder.write("one", b"content")
    assert (folder.keeps, folder.read("one")) == (False, None)


def test_a_folder_to_be_read_stays_as_it_is(folder: KernelFolder, tmp_path: Path) -> None:
    folder.write("one", b"content")
    os.utime(tmp_path / "one", (1, 1))
    reading = KernelFolder(tmp_path, read_only=True)
    reading.write("two", b"")
    assert (reading.read("one"), reading.read("two"), (tmp_path / "one").stat().st_mtime) == (b"content", None, 1)


def test_the_folder_is_in_the_users_cache_where_the_code_is_not_the_users(find: Find, tmp_path: Path) -> None:
    assert find() == tmp_path / "home" / ".cache" / "ial" / name()
    assert {path.stat().st_mode & 0o777 for path in (tmp_path / "home").rglob("*")} == {0o700}


def test_it_is_beside_code_of_the_users_own(find: Find, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.undo()
    monkeypatch.delenv("IAL_CACHE_DIR", raising=False)
    monkeypatch.setattr(module, "__file__", str(tmp_path / "code" / "kernel_folder.py"))
    (tmp_path / "code").mkdir(0o755)
    assert find() == tmp_path / "code" / "__pycache__" / name()


@pytest.mark.parametrize("mode", [0o775, 0o757, 0o777])
def test_it_is_not_beside_code_that_others_can_write_to(
    find: Find, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, mode: int, caplog: pytest.LogCaptureFixture
) -> None:
    monkeypatch.undo()
    monkeypatch.delenv("IAL_CACHE_DIR", raising=False)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setattr(module, "__file__", str(tmp_path / "code" / "kernel_folder.py"))
    (tmp_path / "code").mkdir()
    (tmp_path / "code").chmod(mode)
    assert find() == tmp_path / "cache" / "ial" / name()
    assert caplog.records == []


@pytest.mark.parametrize("given", ["{}/chosen", "chosen", "./deep/chosen", "{}/a link"])
def test_it_is_where_the_variable_says(find: Find, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, given: str) -> None:
    (tmp_path / "linked to").mkdir(0o700)
    (tmp_path / "a link").symlink_to("linked to")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("IAL_CACHE_DIR", given.format(tmp_path))
    folder = find()
    assert folder == Path(os.path.realpath(given.format(tmp_path)), name())
    assert folder is not None
    assert folder.is_dir()


def test_neither_a_home_nor_an_entry_of_the_user_is_needed(find: Find, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def unknown(number: int) -> None:
        raise KeyError(number)

    monkeypatch.delenv("HOME")
    monkeypatch.setattr(pwd, "getpwuid", unknown)
    with pytest.raises(RuntimeError):
        Path.home()
    assert find() is None
    monkeypatch.setenv("IAL_CACHE_DIR", str(tmp_path / "chosen"))
    assert find() == tmp_path / "chosen" / name()


@pytest.mark.parametrize("fault", ["a file", "in a file", "open", "in an open folder", "kernels open", "kernels a link"])
def test_a_place_that_cannot_be_used_is_named_in_one_line_and_the_next_is_taken(
    find: Find, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture, fault: str
) -> None:
    (tmp_path / "a file").touch()
    (tmp_path / "open" / name()).mkdir(parents=True)
    (tmp_path / "open").chmod(0o777)
    (tmp_path / "kernels open").mkdir(0o700)
    (tmp_path / "kernels open" / name()).mkdir()
    (tmp_path / "kernels open" / name()).chmod(0o770)
    (tmp_path / "kernels a link").mkdir(0o700)
    (tmp_path / "kernels a link" / name()).symlink_to(tmp_path / "kernels open")
    place = {"in a file": "a file/inner", "in an open folder": "open/inner"}.get(fault, fault)
    monkeypatch.setenv("IAL_CACHE_DIR", str(tmp_path / place))
    assert find() == tmp_path / "home" / ".cache" / "ial" / name()
    (line,) = (record.getMessage() for record in caplog.records)
    assert line.startswith(f"compiled kernels are not kept in {tmp_path / place}: ")
    assert ("can be written to by others" in line) == ("open" in fault)
    assert line.endswith("IAL_CACHE_DIR may name a folder of your own")


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can give files away")
def test_a_usual_place_of_another_user_is_named_too(find: Find, tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    place = tmp_path / "home" / ".cache" / "ial"
    make_private(place)
    os.chown(place, 65534, 65534)
    assert find() is None
    (line,) = (record.getMessage() for record in caplog.records)
    assert f"{place} belongs to another user" in line


def test_only_the_oldest_folders_of_this_user_are_removed(find: Find, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("IAL_CACHE_DIR", str(tmp_path))
    others = ["kernels-linux", "kernels-0123456789abcdef0", "something"]
    old = [f"kernels-{index:016x}" for index in range(12)]
    for index, folder in enumerate([*others, *old]):
        (tmp_path / folder).mkdir()
        os.utime(tmp_path / folder, (index, index))
    (tmp_path / "kernels-ffffffffffffffff").touch()
    (tmp_path / "kernels-eeeeeeeeeeeeeeee").symlink_to("something")
    find()
    left = {path.name for path in tmp_path.iterdir()}
    assert left == {*others, *old[4:], "kernels-ffffffffffffffff", "kernels-eeeeeeeeeeeeeeee", name()}


def test_only_the_files_that_were_not_used_for_longest_are_removed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "_KEPT_FILES", 4)
    for index, file in enumerate(("used", "old", "older", "tmp0left", "new", "last")):
        KernelFolder(tmp_path).write(file, b"content")
        os.utime(tmp_path / file, (index, index))
    assert {path.name for path in tmp_path.iterdir()} == {"older", "tmp0left", "new", "last"}
    os.utime(tmp_path / "older", (1, 1))
    folder = KernelFolder(tmp_path)
    assert folder.read("older") == b"content"
    folder.write("one", b"")
    folder.write("two", b"")  # a process tidies up once: looking at all files for each would cost more than it saves
    assert {path.name for path in tmp_path.iterdir()} == {"older", "new", "last", "one", "two"}


def test_a_folder_that_can_only_be_read_is_used(find: Find, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("IAL_CACHE_DIR", str(tmp_path / "chosen"))
    folder = find()

    def read_only(*_: object, **__: object) -> None:
        raise OSError(errno.EROFS, os.strerror(errno.EROFS))

    assert folder is not None
    KernelFolder(folder).write("one", b"content")
    monkeypatch.setattr(Path, "touch", read_only)
    monkeypatch.setattr(Path, "mkdir", read_only)
    monkeypatch.setattr(os, "utime", read_only)
    assert (find(), KernelFolder(folder).read("one")) == (folder, b"content")
