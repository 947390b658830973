import ast
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from ial.contractors.kernels import source_files, source_hash

ROOT = Path(__file__).resolve().parents[2]
MESSAGE = "compiling kernels, once"


class Copy:
    """A copy of the package that a test may change, run in processes of its own."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.package = folder / "ial"
        self.home = folder / "cache"
        self.package.mkdir()
        for name in ("__init__.py", "errors.py", "lazy.py", "pose.py"):
            shutil.copy(ROOT / "ial" / name, self.package)
        shutil.copytree(ROOT / "contractors", self.package / "contractors", ignore=shutil.ignore_patterns("__pycache__"))

    def start(self, script: str) -> subprocess.Popen[str]:
        environment = {name: value for name, value in os.environ.items() if name not in ("IAL_CACHE_DIR", "NUMBA_DISABLE_JIT")}
        environment |= {"PYTHONPATH": str(self.folder), "XDG_CACHE_HOME": str(self.home)}
        lines = f"import ial\nassert ial.__file__.startswith({str(self.folder)!r})\n{script}"
        command = [sys.executable, "-c", lines]
        return subprocess.Popen(command, env=environment, cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def run(self, script: str) -> tuple[str, str]:
        process = self.start(script)
        out, err = process.communicate(timeout=100)
        assert process.returncode == 0, err
        return out.strip(), err

    def cache(self) -> Path:
        return Path(self.run("from ial.contractors.kernels import cache_folder; print(cache_folder())")[0])


STEPS = "from ial.contractors.rounding import check_rounding, up, down; check_rounding(); print(up(1.0) > 1.0)"
USER = "from ial.contractors.user import twice; print(twice(1.0))"


@pytest.fixture
def copy(tmp_path: Path) -> Copy:
    return Copy(tmp_path)


def test_the_cache_is_beside_the_code_and_filled_once(copy: Copy) -> None:
    folder = copy.cache()
    assert folder.parent == copy.package / "contractors" / "__pycache__"
    assert folder.name.startswith("kernels-")
    first, second = copy.run(STEPS), copy.run(STEPS)
    assert first[0] == second[0] == "True"
    assert first[1].count(MESSAGE) == 1
    assert str(folder) in first[1]
    assert MESSAGE not in second[1]
    assert list(folder.rglob("*.nbc"))


def test_the_folder_changes_with_a_kernel_and_only_with_a_kernel(copy: Copy) -> None:
    before = copy.cache()
    contractor = copy.package / "contractors" / "contractor.py"
    contractor.write_text(contractor.read_text() + "\n# a change\n")
    assert copy.cache() == before
    arithmetic = copy.package / "contractors" / "intervals" / "arithmetic.py"
    arithmetic.write_text(arithmetic.read_text() + "\n# a change\n")
    assert copy.cache() != before


def test_a_change_in_a_called_kernel_of_another_file_is_noticed(copy: Copy) -> None:
    called, user = (copy.package / "contractors" / name for name in ("called.py", "user.py"))
    called.write_text("from ial.contractors.kernels import kernel\n\n\n@kernel\ndef step(x):\n    return x + 1.0\n")
    user.write_text(
        "from ial.contractors.called import step\nfrom ial.contractors.kernels import kernel\n\n\n"
        "@kernel\ndef twice(x):\n    return step(step(x))\n"
    )
    assert copy.run(USER)[0] == "3.0"
    called.write_text(called.read_text().replace("1.0", "2.0"))
    assert copy.run(USER)[0] == "5.0"


def test_a_read_only_installation_uses_the_cache_of_the_user(copy: Copy) -> None:
    (copy.package / "contractors" / "__pycache__").write_text("")  # a file in the way stops even the superuser
    assert copy.cache().parent == copy.home / "ial"
    assert MESSAGE in copy.run(STEPS)[1]
    assert MESSAGE not in copy.run(STEPS)[1]


def test_two_processes_may_compile_at_once(copy: Copy) -> None:
    processes = [copy.start(STEPS) for _ in range(2)]
    results = [process.communicate(timeout=100) for process in processes]
    assert [out.strip() for out, _ in results] == ["True", "True"], results


def test_the_hash_covers_the_kernels_of_every_room() -> None:
    names = {file.name for file in source_files()}
    assert {"kernels.py", "rounding.py", "arithmetic.py", "trigonometric.py", "operation.py", "polar.py", "relaxation.py"} <= names
    assert "contractor.py" not in names
    assert len(source_hash()) == 16


def is_kernel(function: ast.FunctionDef) -> bool:
    return any(isinstance(decorator, ast.Name) and decorator.id == "kernel" for decorator in function.decorator_list)


@pytest.mark.parametrize("file", source_files(), ids=lambda file: file.name)
def test_no_kernel_gives_up_ieee_semantics_or_runs_numbas_own_threads(file: Path) -> None:
    tree = ast.parse(file.read_text())
    for node in ast.walk(tree):
        if isinstance(node, ast.keyword) and node.arg in ("fastmath", "parallel"):
            assert isinstance(node.value, ast.Constant), ast.dump(node)
            assert node.value.value is False, f"{file}: {node.arg}"
        if isinstance(node, ast.Attribute | ast.Name):
            name = node.attr if isinstance(node, ast.Attribute) else node.id
            assert name != "prange", file
            assert file.name == "kernels.py" or name not in ("njit", "jit", "vectorize"), f"{file}: compile with @kernel"
        if isinstance(node, ast.FunctionDef) and is_kernel(node):
            called = {inner.attr for inner in ast.walk(node) if isinstance(inner, ast.Attribute)}
            assert "nextafter" not in called, f"{file}: {node.name}: use a bit step, twenty times faster"


def test_the_sources_hold_kernels_at_all() -> None:
    trees = [ast.parse(file.read_text()) for file in source_files()]
    kernels = [node.name for tree in trees for node in ast.walk(tree) if isinstance(node, ast.FunctionDef) and is_kernel(node)]
    assert {"add", "sin", "contract_polar"} <= set(kernels)
