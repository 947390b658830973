import sys

import llvmlite
import numba
import numpy as np
import pytest

from ial.contractors import kernel_compiler


def fresh() -> str:
    return kernel_compiler.compiler_hash.__wrapped__()


@pytest.mark.parametrize("changed", [(numba, "__version__"), (llvmlite, "__version__"), (np, "__version__"), (sys, "version")])
def test_a_version_changes_the_hash(monkeypatch: pytest.MonkeyPatch, changed: tuple[object, str]) -> None:
    before = fresh()
    monkeypatch.setattr(*changed, "1.2.3")
    assert fresh() != before


def test_the_processor_and_numbas_settings_change_the_hash(monkeypatch: pytest.MonkeyPatch) -> None:
    hashes = [fresh()]
    monkeypatch.setenv("NUMBA_OPT", "1")
    hashes.append(fresh())
    generator = kernel_compiler.cpu_target.target_context.codegen()
    system, name, features = generator.magic_tuple()
    for processor in ((system, "i486", features), (system, name, f"{features},-avx2")):
        monkeypatch.setattr(type(generator), "magic_tuple", lambda _, processor=processor: processor)
        hashes.append(fresh())
    assert len(set(hashes)) == 4


@pytest.mark.parametrize(
    ("features", "usable"),
    [
        ("", ["x86-64"]),
        ("-avx2", ["x86-64"]),
        (",".join(f"+{name}" for name in kernel_compiler.PORTABLE["x86-64-v3"]), ["x86-64-v3", "x86-64"]),
        (",".join(f"{'-' if name == 'fma' else '+'}{name}" for name in kernel_compiler.PORTABLE["x86-64-v3"]), ["x86-64"]),
    ],
)
def test_a_processor_stands_for_those_whose_features_it_has(monkeypatch: pytest.MonkeyPatch, features: str, usable: list[str]) -> None:
    monkeypatch.setattr(kernel_compiler, "_processor", lambda: ("a system", "a processor", features))
    assert kernel_compiler.usable_processors() == usable


def test_kernels_for_another_system_or_interpreter_have_another_hash(monkeypatch: pytest.MonkeyPatch) -> None:
    hashes = [kernel_compiler.portable_hash(name) for name in kernel_compiler.PORTABLE]
    monkeypatch.setattr(kernel_compiler, "_processor", lambda: ("another", "", ""))
    hashes.append(kernel_compiler.portable_hash("x86-64"))
    monkeypatch.setattr(sys.implementation, "cache_tag", "cpython-399")
    hashes.append(kernel_compiler.portable_hash("x86-64"))
    assert len(set(hashes)) == 4
