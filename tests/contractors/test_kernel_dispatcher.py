from pathlib import Path

import numpy as np
import pytest

from ial.contractors import kernel_cache
from ial.contractors.kernel_folder import KernelFolder
from ial.contractors.kernel_sources import kernel_sources
from ial.contractors.kernels import kernel

pytestmark = pytest.mark.compiled


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A folder of the test's own, and this module as if it were a part of ial."""
    monkeypatch.setattr(kernel_cache, "kernel_folder", lambda: KernelFolder(tmp_path))
    monkeypatch.setitem(kernel_sources().files, __name__, Path(__file__))
    monkeypatch.setattr(kernel_sources(), "hash", lambda modules: " ".join(sorted(modules)))
    monkeypatch.setattr(kernel_sources(), "have_changed", lambda: False)
    monkeypatch.setattr(kernel_cache, "_announced", True)


def third(x):  # type: ignore[no-untyped-def]
    return x / 3.0


@kernel
def product(n):  # type: ignore[no-untyped-def]
    if n < 2:
        return 1
    return n * product(n - 1)


def test_a_kernel_inside_kernels_is_not_made_ready_for_python() -> None:
    inner = kernel(third)

    @kernel
    def outer(x):  # type: ignore[no-untyped-def]
        return inner(x) + inner(2.0 * x)

    assert outer(1.0) == 1.0 / 3.0 + 2.0 / 3.0
    assert (len(inner.overloads), len(inner.inlined.overloads)) == (0, 1)
    assert (len(outer.overloads), len(outer.inlined.overloads)) == (1, 0)
    (result,) = inner.inlined.overloads.values()
    assert not result.library.codegen._engine.is_symbol_defined(result.fndesc.llvm_func_name)
    assert inner(1.0) == 1.0 / 3.0  # unless Python calls it as well
    assert len(inner.overloads) == 1


def test_the_code_inside_is_kept_and_read_for_another_caller(tmp_path: Path) -> None:
    def by_another() -> tuple[float, int, int]:
        inner = kernel(third)

        @kernel
        def outer(x):  # type: ignore[no-untyped-def]
            return inner(x) + 1.0

        value = outer(1.0)
        return value, sum(inner.inlined.stats.cache_hits.values()), len(list(tmp_path.iterdir()))

    assert by_another() == (1.0 / 3.0 + 1.0, 0, 2)
    (inlined,) = tmp_path.glob("third-*")
    for outer in tmp_path.glob("outer-*"):
        outer.unlink()
    assert by_another() == (1.0 / 3.0 + 1.0, 1, 2)
    assert inlined.exists()


def test_an_error_inside_reaches_python() -> None:
    @kernel
    def inner(n):  # type: ignore[no-untyped-def]
        return np.empty(n)

    @kernel
    def outer(n):  # type: ignore[no-untyped-def]
        return len(inner(n))

    assert outer(3) == 3
    with pytest.raises(ValueError, match="negative"):
        outer(-3)


def test_a_kernel_may_call_itself() -> None:
    @kernel
    def outer(n):  # type: ignore[no-untyped-def]
        return product(n) + product(n + 1)

    assert outer(5) == 120 + 720
    assert product(5) == 120
