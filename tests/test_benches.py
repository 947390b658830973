"""The benches name nothing that is no longer there: no test runs them, and no type checker reads them."""

import ast
import runpy
from importlib import import_module
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
BENCHES = sorted((ROOT / "bench").glob("*.py"))


def is_there(module: str, name: str) -> bool:
    """Return whether a module has a name, or a module of that name in it."""
    if hasattr(import_module(module), name):
        return True
    try:
        import_module(f"{module}.{name}")
    except ModuleNotFoundError:
        return False
    return True


@pytest.mark.parametrize("bench", BENCHES, ids=lambda bench: bench.name)
def test_a_bench_imports_what_there_is(bench: Path) -> None:
    statements = [node for node in ast.walk(ast.parse(bench.read_text(encoding="utf-8"))) if isinstance(node, ast.ImportFrom)]
    names = [
        (str(node.module), alias.name) for node in statements for alias in node.names if str(node.module).split(".")[0] in {"ial", "tests"}
    ]
    assert [f"{module}.{name}" for module, name in names if not is_there(module, name)] == []


def test_a_name_that_is_gone_is_noticed() -> None:
    assert is_there("ial.lidar.search", "pose_contractor")
    assert not is_there("ial.lidar", "pose_contractor")


def test_every_edit_applies_and_its_tests_are_there() -> None:
    edits = runpy.run_path(str(ROOT / "bench" / "edits.py"))["Edit"].listed()
    assert [(edit.path, edit.old) for edit in edits if not edit.applies(ROOT)] == []
    assert {test for edit in edits for test in edit.tests if not (ROOT / test.partition("::")[0]).exists()} == set()
