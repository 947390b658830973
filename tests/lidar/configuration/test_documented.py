"""The page about the configuration says what the code says."""

import contextlib
import re
import runpy
from dataclasses import MISSING
from pathlib import Path

import pytest

from ial.keys.entry import ANY_NAME, entries
from ial.keys.kind import Maybe
from ial.keys.record import Named, Part
from ial.lidar import LocalizerConfig, config_yaml

DOCS = Path(__file__).resolve().parents[3] / "docs"
PAGE = (DOCS / "localize.md").read_text(encoding="utf-8")


def test_the_table_is_that_of_today() -> None:
    assert runpy.run_path(str(DOCS / "keys.py"))["page"]() == PAGE, "run: python docs/keys.py"


def test_it_has_a_row_for_every_key_that_a_file_may_have() -> None:
    table = PAGE.partition("| key | default ")[2].partition("\n\n")[0]
    rows = re.findall(r"^\| `([\w.]+)` \|", table, re.MULTILINE)
    assert len(rows) == len(set(rows)) == len(list(entries(LocalizerConfig)))
    written = set(re.findall(r"^ *(\w+):", config_yaml(LocalizerConfig()), re.MULTILINE))
    assert {row.rpartition(".")[2] for row in rows if ANY_NAME not in row} == written


def test_every_key_says_what_it_means_and_takes_its_own_default() -> None:
    for entry in entries(LocalizerConfig):
        assert re.match(r"[a-z].{4}.*[^.]$", entry.key.means), entry.path
        assert entry.unit or not re.search("_(m|rad)$|seconds", entry.path[-1]), entry.path
        kind = entry.key.kind
        if entry.default is not MISSING and not isinstance(kind, Part | Named | Maybe):
            assert kind.checked(kind.meant(entry.default)) == entry.default


def test_the_lines_of_python_on_the_page_run(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (code,) = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)
    (tmp_path / "out" / "run").mkdir(parents=True)
    (tmp_path / "out" / "run" / "config.yaml").write_text(config_yaml(LocalizerConfig(outliers=7)))
    with contextlib.chdir(tmp_path):
        exec(code, {})
    assert capsys.readouterr().out.strip() == config_yaml(LocalizerConfig(outliers=7, max_beams=90)).strip()
