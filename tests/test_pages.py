"""The pages of the documentation: lines that can be read anywhere, and no file named that is not there."""

import ast
import re
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path

import pytest

from tests.test_house import HOUSE, MODULES, ROOMS, ROOT, kept_files

WRITTEN = [file for file in kept_files() if file.suffix == ".md" and file.parent != ROOT / "bench" and file.name != "CHANGELOG.md"]
LONGEST = 140
PATH = re.compile(r"`((?!\S*__pycache__)(?:ial|contractors|maps|datasets|tests|bench|docs|requirements|\.ci)/[\w./-]*)`")
FOLDER = re.compile(r"^\| `(\S+)/` \|", re.MULTILINE)


def page_name(page: Path) -> str:
    return str(page.relative_to(ROOT))


def prose(text: str) -> Iterator[str]:
    """Yield the lines of a page that are neither code nor a row of a table; a link counts as its text alone, and a picture as nothing."""
    code = False
    for line in text.splitlines():
        if line.lstrip().startswith(("```", ":::")):
            code = not code
        elif not code and not line.lstrip().startswith("|"):
            yield re.sub(r"\]\([^)\s]*\)", "]", re.sub(r"!\[[^]]*\]\([^)\s]*\)", "", line))


@pytest.mark.parametrize("page", WRITTEN, ids=page_name)
def test_lines_are_short(page: Path) -> None:
    assert [line for line in prose(page.read_text(encoding="utf-8")) if len(line) > LONGEST] == []


def test_only_code_tables_and_links_may_be_long() -> None:
    long = "x" * 200
    assert list(prose(f"```sh\n{long}\n```\n| {long} |\n[text]({long})\n![{long}](a)\n{long}")) == ["[text]", "", long]


@pytest.mark.parametrize("page", WRITTEN, ids=page_name)
def test_names_that_a_page_imports_are_there(page: Path) -> None:
    blocks = re.findall(r"```python\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL)
    statements = [node for block in blocks for node in ast.walk(ast.parse(block)) if isinstance(node, ast.ImportFrom)]
    names = [(str(node.module), alias.name) for node in statements if str(node.module).split(".")[0] == "ial" for alias in node.names]
    assert [f"{module}.{name}" for module, name in names if not hasattr(import_module(module), name)] == []


@pytest.mark.parametrize("page", WRITTEN, ids=page_name)
def test_files_that_a_page_names_are_there(page: Path) -> None:
    named = set(PATH.findall(page.read_text(encoding="utf-8")))
    planned = {room.path for room in ROOMS.values() if room.planned}
    assert {name for name in named if ROOT / name not in planned and not (ROOT / name).exists()} == set()


def test_the_architecture_says_what_every_folder_is_for() -> None:
    listed = FOLDER.findall(HOUSE["PAGE"].read_text(encoding="utf-8"))
    folders = {file.parent.relative_to(ROOT).as_posix() for file in MODULES.values() if file.name != "__init__.py"}
    assert sorted(listed) == sorted(folders - {"ial"})
