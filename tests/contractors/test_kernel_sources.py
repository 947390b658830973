import ast
import functools
import os
import random
import shutil
import sys
from collections.abc import Iterator
from pathlib import Path

import llvmlite
import numba
import numpy as np
import pytest

import ial
from ial.contractors import kernel_sources
from ial.contractors.kernel_sources import KernelSources

PACKAGE = Path(ial.__path__[0])
COMPILERS = ("numba", "llvmlite", "ial.contractors.kernels")


@functools.cache
def modules() -> dict[str, ast.Module]:
    found = {}
    for folder, _, names in os.walk(PACKAGE, followlinks=True):
        for file in (Path(folder, name) for name in names if name.endswith(".py")):
            parts = file.relative_to(PACKAGE.parent).with_suffix("").parts
            found[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = ast.parse(file.read_bytes())
    return found


def imports(module: str) -> Iterator[str]:
    """Yield all that a module imports, also within functions."""
    for node in ast.walk(modules()[module]):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{module}: a relative import, which the hash does not follow"
            deeper = [f"{node.module}.{alias.name}" for alias in node.names]
            yield from (name if name in modules() else str(node.module) for name in deeper)


def compiles(module: str) -> bool:
    return any(name == compiler or name.startswith(f"{compiler}.") for name in imports(module) for compiler in COMPILERS)


@pytest.fixture(scope="module")
def sources() -> KernelSources:
    return KernelSources(PACKAGE)


def test_whatever_imports_a_compiler_is_covered(sources: KernelSources) -> None:
    found = {module for module in modules() if compiles(module)}
    assert {
        "ial.lidar.search.rectangle_indices",
        "ial.lidar.search.empty_rectangles",
        "ial.contractors.rounding",
        "ial.contractors.kernel_cache",
    } <= found
    assert found <= set(sources.files)


@pytest.mark.slow
def test_so_is_all_that_this_imports(sources: KernelSources) -> None:
    reached, todo = set(), [module for module in modules() if compiles(module)]
    while todo:
        module = todo.pop()
        if module not in reached:
            reached.add(module)
            todo += set(imports(module)) & modules().keys()
    assert reached <= set(sources.files)
    assert {
        "ial.lidar.evidence.beams",
        "ial.maps.grids.occupancy_grid",
        "ial.contractors.intervals.double",
    } <= reached  # they define no kernel
    assert {"ial.cli.main", "ial.results.lidar.picture", "ial.bouncing.automata.table"}.isdisjoint(sources.files)


def test_nothing_that_is_covered_imports_in_another_way(sources: KernelSources) -> None:
    for module in sources.files:
        assert "ial" not in set(imports(module)), f"{module}: import what is used, not all of ial"
        texts = {node.value for node in ast.walk(modules()[module]) if isinstance(node, ast.Constant) and isinstance(node.value, str)}
        assert {text for text in texts if text in modules()} - {"ial"} <= set(sources.files), (
            f"{module}: names a module that is not covered"
        )


@pytest.fixture(scope="module")
def copy(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("copy") / "ial"
    shutil.copytree(PACKAGE, folder, ignore=lambda _, names: [name for name in names if "." in name and not name.endswith(".py")])
    return folder


def test_a_copy_without_links_has_the_same_hash(copy: Path, sources: KernelSources) -> None:
    assert KernelSources(copy).hash == sources.hash


@pytest.mark.slow
def test_one_byte_in_any_covered_file_changes_the_hash(copy: Path, sources: KernelSources) -> None:
    generator = random.Random(12)
    for module, original in sources.files.items():
        file = copy / original.relative_to(PACKAGE)
        text = file.read_bytes()
        at = generator.randrange(len(text))
        file.write_bytes(text[:at] + bytes([text[at] ^ 1]) + text[at + 1 :])
        assert KernelSources(copy).hash != sources.hash, module
        file.write_bytes(text)
    assert KernelSources(copy).hash == sources.hash


def test_a_change_elsewhere_does_not(copy: Path, sources: KernelSources) -> None:
    for name in ("cli/main.py", "results/lidar/picture.py", "__init__.py"):
        file = copy / name
        file.write_text(file.read_text() + "\n# a change\n")
    assert KernelSources(copy).hash == sources.hash


@pytest.mark.parametrize("changed", [(numba, "__version__"), (llvmlite, "__version__"), (np, "__version__"), (sys, "version")])
def test_a_version_changes_the_hash(monkeypatch: pytest.MonkeyPatch, sources: KernelSources, changed: tuple[object, str]) -> None:
    monkeypatch.setattr(*changed, "1.2.3")
    assert KernelSources(PACKAGE).hash != sources.hash


def test_the_processor_and_numbas_settings_change_the_hash(monkeypatch: pytest.MonkeyPatch, sources: KernelSources) -> None:
    hashes = [sources.hash]
    monkeypatch.setenv("NUMBA_OPT", "1")
    hashes.append(KernelSources(PACKAGE).hash)
    generator = kernel_sources.cpu_target.target_context.codegen()
    system, name, features = generator.magic_tuple()
    for processor in ((system, "i486", features), (system, name, f"{features},-avx2")):
        monkeypatch.setattr(type(generator), "magic_tuple", lambda _, processor=processor: processor)
        hashes.append(KernelSources(PACKAGE).hash)
    assert len(set(hashes)) == 4


def test_a_file_that_is_written_to_is_noticed(copy: Path) -> None:
    sources = KernelSources(copy)
    assert not sources.have_changed()
    file = copy / "lidar" / "search" / "rectangle_indices.py"
    file.write_text(file.read_text() + "\n")
    assert sources.have_changed()
    file.unlink()
    assert sources.have_changed()
