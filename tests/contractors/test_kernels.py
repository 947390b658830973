import ast
import functools
import os
import resource
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from ial.contractors.kernel_sources import kernel_sources
from tests.contractors.package_copy import RESULT, ROOT, USE, PackageCopy
from tests.contractors.pickle_bomb import plant

MESSAGE = "compiling kernels, once, that were not used before (to be kept in "
FILES = list(kernel_sources().files.values())


@pytest.fixture
def copy(tmp_path: Path) -> PackageCopy:
    return PackageCopy(tmp_path)


@pytest.mark.slow
def test_code_is_kept_beside_the_users_own_code_and_compiled_once(copy: PackageCopy) -> None:
    assert copy.use() == (RESULT, [f"{MESSAGE}{copy.kept[0].parent})"])
    assert {file.parent.parent for file in copy.kept} == {copy.package / "contractors" / "__pycache__"}
    assert len(copy.kept) == 3
    assert copy.use() == (RESULT, [])


@pytest.mark.slow
def test_a_change_of_a_constant_in_a_file_without_kernels_is_noticed(copy: PackageCopy) -> None:
    copy.use()
    copy.constant.write_text("STEP = 2.00\n")
    result, lines = copy.use()
    assert (result, len(lines)) == ("3.0 5.0 10.0", 1)


CORNER = """
import numpy as np
from ial.contractors.kernels import kernel
from ial.lidar.search.rectangle_indices import OFFSET, rectangle_indices


@kernel
def corner(bounds):
    return rectangle_indices(bounds, 0, OFFSET, OFFSET, OFFSET, OFFSET, np.int32(9), np.int32(9))[0]


print(corner(np.full((1, 4), 4.5)))
"""


@pytest.mark.slow
def test_a_change_of_an_intrinsic_is_noticed(copy: PackageCopy) -> None:
    search = copy.package / "lidar" / "search"
    search.mkdir(parents=True)
    indices = search / "rectangle_indices.py"
    shutil.copy(ROOT / "ial" / "lidar" / "search" / "rectangle_indices.py", indices)
    (copy.package / "corner.py").write_text(CORNER)
    assert copy.use("import ial.corner")[0] == "4"
    assert len(copy.kept) == 1
    text = indices.read_text()
    changed = text.replace("[int(OFFSET)] * 4", "[int(OFFSET) - 3] * 4")
    assert changed != text
    indices.write_text(changed)
    assert copy.use("import ial.corner")[0] == "7"


@pytest.mark.slow
def test_a_change_compiles_anew_what_follows_from_it_and_nothing_else(copy: PackageCopy) -> None:
    (copy.package / "other.py").write_text("from ial.contractors.kernels import kernel\n\n\n@kernel\ndef other(x):\n    return x\n")
    script = f"{USE}\nfrom ial.other import other\nother(1.0)\n"
    copy.use(script)
    before = set(copy.kept)
    with (copy.package / "other.py").open("a") as file:
        file.write("# a comment\n")
    assert len(copy.use(script)[1]) == 1
    (new,) = set(copy.kept) - before
    assert new.name.startswith("other-")
    copy.constant.write_text("STEP = 2.00\n")
    copy.use(script)
    assert sorted(file.name.split("-")[0] for file in set(copy.kept) - before - {new}) == ["double", "step", "twice"]


@pytest.mark.slow
def test_two_processes_may_compile_at_once(copy: PackageCopy) -> None:
    processes = [copy.start() for _ in range(2)]
    results = [process.communicate(timeout=100) for process in processes]
    assert [out.strip() for out, _ in results] == [RESULT, RESULT], results
    assert len(copy.kept) == 3


@pytest.mark.slow
def test_a_disk_that_takes_no_more_is_said_in_one_line(copy: PackageCopy) -> None:
    _, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    limit = f"import resource; resource.setrlimit(resource.RLIMIT_FSIZE, (4096, {hard}))\n"
    result, (announced, line) = copy.use(limit + USE)
    assert (result, announced.startswith(MESSAGE)) == (RESULT, True)
    assert line.startswith("compiled kernels are no longer kept in ")
    assert line.endswith("File too large; IAL_CACHE_DIR may name another folder")
    assert not list(copy.kept)
    assert {path.name for path in copy.package.rglob("*") if path.is_file() and path.suffix not in (".py", ".pyc")} == set()


@pytest.fixture(scope="module")
def planted(tmp_path_factory: pytest.TempPathFactory) -> PackageCopy:
    """A copy whose kernels are kept in ``parent/shared``, where somebody has replaced them by what makes the file ``run``."""
    copy = PackageCopy(tmp_path_factory.mktemp("planted"))
    copy.use(IAL_CACHE_DIR=str(copy.folder / "parent" / "shared"))
    plant(copy.folder / "parent", copy.folder / "run")
    return copy


def lay_open(path: Path, mode: int) -> None:
    path.chmod(mode)


def give_away(path: Path, user: int) -> None:
    if os.geteuid() != 0:
        pytest.skip("only root can give folders away")
    os.chown(path, user, user)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("spoil", "place", "how"),
    [
        (lay_open, "parent/shared", 0o777),
        (lay_open, "parent/shared", 0o770),
        (lay_open, "parent", 0o770),
        (give_away, "parent/shared", 65534),
    ],
)
def test_nothing_is_run_from_a_folder_that_others_can_change(
    planted: PackageCopy, spoil: Callable[[Path, int], None], place: str, how: int
) -> None:
    shared = planted.folder / "parent" / "shared"
    spoil(planted.folder / place, how)
    result, lines = planted.use(IAL_CACHE_DIR=str(shared))
    assert (result, (planted.folder / "run").exists()) == (RESULT, False)
    assert lines[0].startswith(f"compiled kernels are not kept in {shared}: {planted.folder / place} ")
    assert [line.startswith(MESSAGE) for line in lines[1:]] in ([], [True])  # beside the code, where they may have been kept meanwhile
    for path in (planted.folder / "parent", shared):
        path.chmod(0o700)
        os.chown(path, os.geteuid(), -1)


@functools.cache
def tree(file: Path) -> ast.Module:
    return ast.parse(file.read_text())


def is_kernel(function: ast.FunctionDef) -> bool:
    return any(isinstance(decorator, ast.Name) and decorator.id == "kernel" for decorator in function.decorator_list)


@pytest.mark.slow
@pytest.mark.parametrize("file", FILES, ids=lambda file: file.name)
def test_no_kernel_gives_up_ieee_semantics_or_runs_numbas_own_threads(file: Path) -> None:
    for node in ast.walk(tree(file)):
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


@pytest.mark.slow
def test_the_sources_hold_kernels_at_all() -> None:
    kernels = [node.name for file in FILES for node in ast.walk(tree(file)) if isinstance(node, ast.FunctionDef) and is_kernel(node)]
    assert {"add", "sin", "contract_polar"} <= set(kernels)
