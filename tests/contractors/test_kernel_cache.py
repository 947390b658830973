import ctypes
import os
import random
import types as types_module
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest
from numba import typeof, types

from ial.contractors import kernel_cache
from ial.contractors.kernel_cache import KernelCache
from ial.contractors.kernel_folder import KernelFolder
from ial.contractors.kernel_sources import kernel_sources
from ial.contractors.kernels import callback, kernel
from tests.contractors.pickle_bomb import plant

POINTER = types.CPointer(types.float64)
LARGE = np.ones(200_000)


def square(x):  # type: ignore[no-untyped-def]
    return x * x


def write_square(x, result):  # type: ignore[no-untyped-def]
    result[0] = x * x


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> KernelFolder:
    """A folder of the test's own, and this module as if it were a part of ial."""
    folder = KernelFolder(tmp_path)
    monkeypatch.setattr(kernel_cache, "kernel_folder", lambda: folder)
    monkeypatch.setitem(kernel_sources().files, __name__, Path(__file__))
    monkeypatch.setattr(kernel_sources(), "hash", lambda modules: " ".join(sorted(modules)))
    monkeypatch.setattr(kernel_sources(), "have_changed", lambda: False)
    monkeypatch.setattr(kernel_cache, "_announced", False)
    return folder


@pytest.fixture
def start(monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture) -> Callable[[], tuple[float, float, int, list[str]]]:
    """A function that does as a new process does: declares a kernel and a callback, calls them, and says what was kept and logged."""

    def start() -> tuple[float, float, int, list[str]]:
        caplog.clear()
        monkeypatch.setattr(kernel_cache, "_announced", False)
        compiled, loop = kernel(square), callback(write_square, types.float64, POINTER)
        result = ctypes.c_double()
        loop.ctypes(3.0, ctypes.byref(result))
        value = compiled(3.0)
        hits = sum(compiled.stats.cache_hits.values()) + loop.cache_hits
        return value, result.value, hits, [record.getMessage() for record in caplog.records]

    return start


def test_code_is_compiled_once(start: Callable[[], Any], tmp_path: Path) -> None:
    assert start() == (9.0, 9.0, 0, [f"compiling kernels, once, that were not used before (to be kept in {tmp_path})"])
    assert start() == (9.0, 9.0, 2, [])
    assert len(list(tmp_path.iterdir())) == 2


@pytest.mark.slow
def test_torn_files_are_compiled_again_with_one_line(start: Callable[[], Any], tmp_path: Path) -> None:
    start()
    whole = {file: file.read_bytes() for file in tmp_path.iterdir()}
    generator = random.Random(17)
    for attempt in range(24):
        for file, content in whole.items():
            at = generator.randrange(len(content))
            garbled = content[:at] + bytes(byte ^ 0xA5 for byte in content[at : at + attempt]) + content[at + attempt :]
            file.write_bytes(content[:at] if attempt % 2 == 0 else garbled)
        value, written, hits, lines = start()
        assert (value, written, hits) == (9.0, 9.0, 0)
        (line,) = lines
        assert line.startswith("compiling kernels again, for what was kept cannot be used: damaged: ")
    assert start() == (9.0, 9.0, 2, [])


def lay_open(file: Path) -> None:
    file.chmod(0o660)


def give_away(file: Path) -> None:
    if os.geteuid() != 0:
        pytest.skip("only root can give files away")
    os.chown(file, 65534, 65534)


def link(file: Path) -> None:
    file.rename(file.with_suffix(".elsewhere"))
    file.symlink_to(file.with_suffix(".elsewhere"))


@pytest.mark.parametrize("spoil", [lay_open, give_away, link])
def test_what_others_could_have_written_is_not_run(start: Callable[[], Any], tmp_path: Path, spoil: Callable[[Path], None]) -> None:
    start()
    mark = tmp_path / "run"
    files = plant(tmp_path, mark)
    for file in files:
        spoil(file)
    value, written, hits, lines = start()
    assert (value, written, hits, len(lines), mark.exists()) == (9.0, 9.0, 0, 1, False)
    assert start() == (9.0, 9.0, 2, [])  # what was there is replaced
    assert not any(file.is_symlink() for file in files)


def test_the_users_own_file_would_be_run_so_the_bomb_works(start: Callable[[], Any], tmp_path: Path) -> None:
    start()
    mark = tmp_path / "run"
    plant(tmp_path, mark)
    assert (start()[:3], mark.exists()) == ((9.0, 9.0, 0), True)


def test_without_a_folder_all_is_compiled_and_one_line_says_so(start: Callable[[], Any], monkeypatch: pytest.MonkeyPatch) -> None:
    nowhere = KernelFolder(None)
    monkeypatch.setattr(kernel_cache, "kernel_folder", lambda: nowhere)
    line = "compiling kernels, at every start: no folder can keep them, IAL_CACHE_DIR may name one"
    assert start() == start() == (9.0, 9.0, 0, [line])


def test_what_is_compiled_after_a_change_of_the_sources_is_not_kept(
    start: Callable[[], Any], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(kernel_sources(), "have_changed", lambda: True)
    _, line = start()[3]
    assert line == f"compiled kernels are no longer kept in {tmp_path}: the source of ial has changed since this program was started"
    assert list(tmp_path.iterdir()) == []


def test_each_types_have_code_of_their_own(tmp_path: Path) -> None:
    for _ in range(2):
        compiled = kernel(square)
        assert [compiled(value) for value in (3.0, 3, np.float32(0.5))] == [9.0, 9, 0.25]
    assert sum(compiled.stats.cache_hits.values()) == 3
    assert len(list(tmp_path.iterdir())) == 3


def test_a_file_under_the_name_of_other_types_is_not_taken(start: Callable[[], Any], tmp_path: Path) -> None:
    kernel(square)(3)
    (of_integers,) = tmp_path.iterdir()
    kernel(square)(3.0)
    (of_numbers,) = set(tmp_path.iterdir()) - {of_integers}
    of_integers.replace(of_numbers)
    compiled = kernel(square)
    assert (compiled(1.5), sum(compiled.stats.cache_hits.values())) == (2.25, 0)


def applied(operation: Any) -> Callable[..., None]:
    def write(x, result):  # type: ignore[no-untyped-def]
        result[0] = operation(x)

    return write


def increased(step: Any) -> Any:
    @kernel
    def increase(x):  # type: ignore[no-untyped-def]
        return step(x) + 1.0

    return increase


@kernel
def negative(x):  # type: ignore[no-untyped-def]
    return -x


@kernel
def half(x):  # type: ignore[no-untyped-def]
    return 0.5 * x


def test_functions_are_told_apart_by_the_kernels_that_they_close_over_however_deep() -> None:
    for hits in (0, 1):
        for operation, expected in ((negative, -4.0), (half, 2.0), (increased(negative), -3.0), (increased(half), 3.0)):
            loop = callback(applied(operation), types.float64, POINTER)
            result = ctypes.c_double()
            loop.ctypes(4.0, ctypes.byref(result))
            assert (result.value, loop.cache_hits) == (expected, hits)


def test_code_of_a_function_that_is_not_of_ial_is_not_kept(
    start: Callable[[], Any], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.delitem(kernel_sources().files, __name__)
    assert start() == start() == (9.0, 9.0, 0, [])
    assert list(tmp_path.iterdir()) == []


def test_code_that_closes_over_what_is_not_of_ial_is_not_kept(tmp_path: Path) -> None:
    foreign = types_module.FunctionType(square.__code__, {"__name__": "somebody.elses"}, "square")
    loop = callback(applied(kernel(foreign)), types.float64, POINTER)
    result = ctypes.c_double()
    loop.ctypes(4.0, ctypes.byref(result))
    assert (result.value, list(tmp_path.iterdir())) == (16.0, [])


class Sides(NamedTuple):
    low: float
    high: float


@kernel
def low(sides):  # type: ignore[no-untyped-def]
    return sides.low


def test_code_follows_from_the_source_of_a_named_tuple(monkeypatch: pytest.MonkeyPatch) -> None:
    asked = []
    monkeypatch.setattr(kernel_sources(), "hash", lambda modules: asked.append(modules) or "")
    monkeypatch.setitem(kernel_sources().files, "ial.of_sides", Path())
    monkeypatch.setattr(Sides, "__module__", "ial.of_sides")
    cache = KernelCache(low.py_func)
    cache._name((typeof((1, (2.0, Sides(1.0, 2.0)))),))
    assert asked == [{__name__, "ial.of_sides"}]


@pytest.mark.parametrize("argument", [Sides(1.0, 2.0), low])
def test_arguments_whose_source_nothing_watches_are_an_error(monkeypatch: pytest.MonkeyPatch, argument: Any) -> None:
    monkeypatch.setattr(Sides, "__module__", "somebody.elses")
    with pytest.raises(TypeError, match="nothing watches the source of"):
        KernelCache(low.py_func)._name((typeof(argument),))


def test_addresses_of_this_process_are_not_kept() -> None:
    @kernel
    def first(i):  # type: ignore[no-untyped-def]
        return LARGE[i]

    with pytest.raises(TypeError, match="give it large arrays as arguments"):
        first(0)


def test_compiling_anew_reads_nothing() -> None:
    kernel(square)(3.0)
    compiled = kernel(square)
    compiled(3.0)
    compiled.recompile()
    assert sum(compiled.stats.cache_misses.values()) == 1
