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
