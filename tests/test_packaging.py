"""What is installed: the wheel's contents, the editable install, the pinned versions, and what `import ial` costs."""

import ast
import os
import re
import shutil
import subprocess
import sys
import zipfile
from importlib.metadata import entry_points
from pathlib import Path

import pytest
from packaging.requirements import Requirement

import ial

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

ROOT = Path(__file__).resolve().parent.parent
FOLDERS = ("contractors", "datasets", "maps")
HEAVY = ("cv2", "matplotlib", "numba", "numpy", "pydantic", "rich", "rosbags", "scipy", "typer", "yaml")


def kept_files() -> list[str]:
    """Every file that git tracks or would track."""
    listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard", "-z"], cwd=ROOT, capture_output=True, text=True, check=True)
    return [name for name in listed.stdout.split("\0") if name and os.path.lexists(ROOT / name)]


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A wheel of the kept files alone, built without the network."""
    source, built = tmp_path_factory.mktemp("source"), tmp_path_factory.mktemp("wheel")
    for name in kept_files():
        (source / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(ROOT / name, source / name, follow_symlinks=False)
    command = [
        sys.executable,
        "-m",
        "pip",
        "wheel",
        "--quiet",
        "--no-index",
        "--no-build-isolation",
        "--no-deps",
        "--wheel-dir",
        built,
        source,
    ]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    (file,) = built.glob("ial-*.whl")
    return file


def run_elsewhere(code: str, folder: Path, **variables: str) -> str:
    environment = {name: value for name, value in os.environ.items() if name != "COVERAGE_PROCESS_CONFIG"}  # it measures no copies
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=folder, env=environment | variables, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()


def in_wheel(name: str) -> str:
    """Where a file of the repository lies in the wheel: the three folders at the top are packages of ial."""
    return f"ial/{name}" if name.startswith(tuple(f"{folder}/" for folder in FOLDERS)) else name


@pytest.mark.slow
def test_the_wheel_holds_every_module_and_nothing_else(wheel: Path) -> None:
    modules = {in_wheel(name) for name in kept_files() if name.endswith(".py")}
    modules = {name for name in modules if name.startswith("ial/")}
    held = {name for name in zipfile.ZipFile(wheel).namelist() if ".dist-info/" not in name}
    assert {name for name in held if name.endswith(".py")} == modules
    assert {name for name in held if not name.startswith("ial/")} == set()


@pytest.mark.slow
def test_the_wheel_holds_the_sample(wheel: Path) -> None:
    sample = {in_wheel(name) for name in kept_files() if name.startswith("datasets/sample/")}
    held = set(zipfile.ZipFile(wheel).namelist())
    assert sample <= held
    assert {"ial/datasets/sample/sample.mcap", "ial/datasets/sample/map.yaml", "ial/datasets/sample/LICENSE-MRPT", "ial/py.typed"} <= held


@pytest.mark.slow
def test_the_wheel_names_the_licences_and_the_command(wheel: Path) -> None:
    with zipfile.ZipFile(wheel) as archive:
        facts = {name.partition(".dist-info/")[2]: name for name in archive.namelist() if ".dist-info/" in name}
        assert {"licenses/LICENSE", "licenses/datasets/sample/LICENSE-MRPT"} <= set(facts)
        assert "ial = ial.cli.entry:main" in archive.read(facts["entry_points.txt"]).decode()
        assert "License-Expression: Apache-2.0" in archive.read(facts["METADATA"]).decode()
        assert archive.read(facts["top_level.txt"]).decode().split() == ["ial"]


@pytest.mark.slow
def test_the_unpacked_wheel_gives_ial_and_no_bare_name(wheel: Path, tmp_path: Path) -> None:
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(tmp_path / "site")
    code = f"""
import importlib.util, ial.contractors, ial.datasets, ial.maps
print(ial.__file__, ial.contractors.__file__, *(name for name in {FOLDERS} if importlib.util.find_spec(name)))
"""
    origins = run_elsewhere(code, tmp_path, PYTHONPATH=str(tmp_path / "site")).split()
    assert origins == [str(tmp_path / "site" / "ial" / name) for name in ("__init__.py", "contractors/__init__.py")]


def test_the_editable_install_gives_ial_and_no_bare_name(tmp_path: Path) -> None:
    code = f"""
import importlib.util, ial.contractors
print(ial.__file__, *(name for name in {FOLDERS} if importlib.util.find_spec(name)))
"""
    assert run_elsewhere(code, tmp_path).split() == [str(ROOT / "ial" / "__init__.py")]


def test_the_command_exists() -> None:
    (command,) = entry_points(group="console_scripts", name="ial")
    assert callable(command.load())


@pytest.mark.parametrize("folder", FOLDERS)
def test_the_folder_is_linked_into_the_package(folder: str) -> None:
    assert (ROOT / "ial" / folder).readlink() == Path("..", folder)
    staged = subprocess.run(["git", "ls-files", "--stage", f"ial/{folder}"], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    assert staged == "" or staged.startswith("120000 ")


def test_importing_ial_loads_no_other_library(tmp_path: Path) -> None:
    code = f"import sys, ial; ial.Pose, ial.MapError; print(*(name for name in {HEAVY} if name in sys.modules))"
    assert run_elsewhere(code, tmp_path) == ""


@pytest.mark.parametrize("name", ial.__all__)
def test_a_public_name_loads(name: str) -> None:
    assert getattr(ial, name).__name__.rpartition(".")[2] == name


def test_an_unknown_name_is_an_attribute_error() -> None:
    with pytest.raises(AttributeError, match="no attribute 'nonsense'"):
        _ = ial.nonsense


@pytest.mark.parametrize("package", ["ial", *(f"ial/{folder}" for folder in FOLDERS), "ial/bouncing", "ial/lidar"])
def test_type_checkers_see_the_names_that_load_lazily(package: str, tmp_path: Path) -> None:
    names = run_elsewhere(f"import {package.replace('/', '.')} as package; print(*getattr(package, '__all__', ()))", tmp_path).split()
    tree = ast.parse((ROOT / package / "__init__.py").read_text())
    blocks = [node for node in tree.body if isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING"]
    imports = [node for block in blocks for node in block.body if isinstance(node, ast.ImportFrom)]
    if blocks:
        assert sorted(alias.asname or alias.name for node in imports for alias in node.names) == sorted(names)


def pins(name: str, python: str) -> dict[str, str]:
    lines = (ROOT / "requirements" / name).read_text().splitlines()
    pinned = [Requirement(line) for line in lines if line and not line.startswith("#")]
    at = {"python_version": python, "python_full_version": f"{python}.20"}
    return {each.name: str(each.specifier).removeprefix("==") for each in pinned if each.marker is None or each.marker.evaluate(at)}


@pytest.mark.parametrize("python", ["3.10", "3.11", "3.12", "3.13"])
def test_every_requirement_is_pinned_and_the_sets_agree(python: str) -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())
    run, others = pins("run.txt", python), [pins(f"{name}.txt", python) for name in ("test", "lint", "docs")]
    assert {re.split(r"[<>=]", text)[0].lower() for text in project["project"]["dependencies"]} <= set(run)
    assert {"crival", "pyinterval"} <= set(others[0])
    for other in others:
        assert run.items() <= other.items()
        assert all(other[name] == version for pinned in others for name, version in pinned.items() if name in other)


def test_pins_name_no_address() -> None:
    for file in (ROOT / "requirements").iterdir():
        assert not re.search(r"://|index-url|find-links +\S|(^|\s)@ ", re.sub(r"--no-emit-\S+", "", file.read_text())), file
