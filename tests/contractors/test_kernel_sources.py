import ast
import functools
import gc
import os
import random
import shutil
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from types import CodeType, ModuleType
from typing import Any

import pytest
from numba.core.dispatcher import Dispatcher

import ial
from ial.contractors import kernel_cache
from ial.contractors.kernel_sources import KernelSources

PACKAGE = Path(ial.__path__[0])
COMPILERS = ("numba", "llvmlite", "ial.contractors.kernels")


@functools.cache
def modules() -> dict[str, ast.Module]:
    trees = {}
    for folder, _, names in os.walk(PACKAGE, followlinks=True):
        for file in (Path(folder, name) for name in names if name.endswith(".py")):
            parts = file.relative_to(PACKAGE.parent).with_suffix("").parts
            trees[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = ast.parse(file.read_bytes())
    return trees


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


@pytest.mark.slow
def test_whatever_imports_a_compiler_is_covered(sources: KernelSources) -> None:
    compiling = {module for module in modules() if compiles(module)}
    assert {
        "ial.lidar.search.rectangle_indices",
        "ial.lidar.search.empty_rectangles",
        "ial.contractors.rounding",
        "ial.contractors.kernel_cache",
    } <= compiling
    assert compiling <= set(sources.files)


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


def hashes(sources: KernelSources) -> dict[str, str]:
    return {module: sources.hash([module]) for module in sources.files}


def test_a_copy_without_links_has_the_same_hashes(copy: Path, sources: KernelSources) -> None:
    assert hashes(KernelSources(copy)) == hashes(sources)


def reached_from(module: str) -> set[str]:
    """The import closure of a module, from syntax trees."""
    reached, todo = set(), [module]
    while todo:
        if (module := todo.pop()) not in reached:
            reached.add(module)
            todo += set(imports(module)) & modules().keys()
    return reached


@pytest.mark.slow
def test_one_byte_in_a_file_changes_the_hashes_of_what_imports_it_however_deep_and_no_other(copy: Path, sources: KernelSources) -> None:
    before = hashes(sources)
    holding = {module: reached_from(module) for module in sources.files}
    generator = random.Random(12)
    for module, original in sources.files.items():
        file = copy / original.relative_to(PACKAGE)
        text = file.read_bytes()
        at = generator.randrange(len(text))
        file.write_bytes(text[:at] + bytes([text[at] ^ 1]) + text[at + 1 :])
        after = hashes(KernelSources(copy))
        both = before.keys() & after.keys()  # the byte may lie in an import
        assert {name for name in both if after[name] != before[name]} == {name for name in both if module in holding[name]}, module
        file.write_bytes(text)


def test_a_change_elsewhere_does_not(copy: Path, sources: KernelSources) -> None:
    for name in ("cli/main.py", "results/lidar/picture.py", "__init__.py"):
        file = copy / name
        file.write_text(file.read_text() + "\n# a change\n")
    assert hashes(KernelSources(copy)) == hashes(sources)


def test_a_comment_in_one_kernel_file_leaves_most_others_as_they_are(sources: KernelSources) -> None:
    kernels = [module for module in sources.files if "kernel" in vars(import_module(module))]
    for changed in ("ial.lidar.search.free_space", "ial.contractors.paving.clusters", "ial.bouncing.cells.model"):
        compiled_anew = [module for module in kernels if changed in sources.closure([module])]
        assert len(compiled_anew) < len(kernels) / 5, changed


def called(function: Any) -> Iterator[tuple[str, Any]]:
    """Yield the kernels and intrinsics that a function takes from its module, from modules in it, and from what it closes over."""
    names = {name for code in codes(function.__code__) for name in code.co_names}
    values = [function.__globals__[name] for name in names if name in function.__globals__]
    values += [getattr(value, name) for value in values if isinstance(value, ModuleType) for name in names if hasattr(value, name)]
    values += [cell.cell_contents for cell in function.__closure__ or ()]
    for value in values:
        inner = getattr(value, "py_func", None) or getattr(value, "_defn", None)
        if inner is not None:
            yield inner.__module__, inner


def codes(code: CodeType) -> Iterator[CodeType]:
    yield code
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            yield from codes(constant)


@pytest.mark.slow
def test_what_numba_really_calls_is_in_the_hash_of_the_caller(sources: KernelSources) -> None:
    """Not read off the text: from the functions themselves as they are once everything is imported."""
    for module in sources.files:
        import_module(module)
    every = [value for value in gc.get_objects() if issubclass(type(value), Dispatcher) and value.__module__ in sources.files]
    checked = 0
    for dispatcher in every:
        own = sources.closure(part.__module__ for part in kernel_cache._functions(dispatcher.py_func))
        todo, seen = [dispatcher.py_func], set()
        while todo:
            for module, function in called(todo.pop()):
                if module.startswith("ial.") and function not in seen:
                    assert module in own, f"{dispatcher.py_func.__qualname__} calls {function.__qualname__}"
                    seen.add(function)
                    todo.append(function)
                    checked += 1
    assert (len(every) > 300, checked > 1000) == (True, True)


def test_nothing_changes_what_numba_makes_of_the_code_of_other_files(sources: KernelSources) -> None:
    """An overload works without being imported by the kernel that calls it, so no hash would hold it."""
    for module in sources.files:
        for node in ast.walk(modules()[module]):
            if isinstance(node, ast.ImportFrom) and node.module == "numba.extending":
                assert {alias.name for alias in node.names} == {"intrinsic"}, module
            if isinstance(node, ast.Attribute):
                assert not ast.unparse(node).startswith("numba.extending"), module


def test_a_file_that_is_written_to_is_noticed(copy: Path) -> None:
    sources = KernelSources(copy)
    assert not sources.have_changed()
    file = copy / "lidar" / "search" / "rectangle_indices.py"
    file.write_text(file.read_text() + "\n")
    assert sources.have_changed()
    file.unlink()
    assert sources.have_changed()
