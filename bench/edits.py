"""Edits of one line each that break a bound, and whether a test sees them.

    python bench/edits.py [--only TEXT ...] [--open] [--report FILE]

A test that no wrong line can make fail says nothing. `edits.toml` lists lines of the code that carry a bound, what to write in their
place, and the tests that have to see it. Each edit is made in a copy of the checkout, and these tests run on it; the report, `edits.md`,
says which test killed the edit, or that it SURVIVED. An edit whose old text does not occur exactly once any more is named, and nothing is
run before all apply: the list is mended together with the code. `--only` tries those whose file or text holds one of some texts, `--open`
those that the report names no test for; the report keeps what it says about the others.

An edit takes some seconds, most of them to compile its kernels: an edit of a file with machine code in it has a cache of its own, which is
thrown away, and the others share that of the code as it is.
"""

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

ROOT = Path(__file__).resolve().parent.parent
_LONGEST_S = 900
_COMPILED = ("ial.contractors.kernels import", "import numba", "from numba", "llvmlite")  # what files with machine code in them import
_PROBE = """
import ial, ial.contractors.rounding, ial.datasets.motion, ial.maps.grids.cell_index, pathlib
for module in (ial, ial.contractors.rounding, ial.datasets.motion, ial.maps.grids.cell_index):
    assert pathlib.Path(module.__file__).resolve().is_relative_to(pathlib.Path.cwd().resolve()), module.__file__
"""


@dataclass(frozen=True)
class Edit:
    """One edit, and the tests that have to see it."""

    path: str
    old: str
    new: str
    tests: tuple[str, ...]

    @classmethod
    def listed(cls) -> list["Edit"]:
        """Return all edits of the list."""
        files = tomllib.loads((ROOT / "bench" / "edits.toml").read_text(encoding="utf-8"))["file"]
        return [cls(file["path"], old, new, tuple(own[0] if own else file["tests"])) for file in files for old, new, *own in file["edits"]]

    def applies(self, tree: Path) -> bool:
        """Return whether the old text occurs exactly once."""
        return (tree / self.path).read_text(encoding="utf-8").count(self.old) == 1

    @property
    def cells(self) -> str:
        """How the report tells the edit from others: its file, the old text and the new one."""
        old, new = (" ".join(text.split()).replace("|", "\\|") for text in (self.old, self.new))
        return f"| {self.path} | `{old}` | {f'`{new}`' if new else '(nothing)'} |"


def copied(tree: Path) -> None:
    """Copy what git tracks, or would track, links as links."""
    listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard", "-z"], cwd=ROOT, capture_output=True, text=True, check=True)
    for name in filter(None, listed.stdout.split("\0")):
        if (ROOT / name).exists():
            (tree / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, tree / name, follow_symlinks=False)


def run(tree: Path, cache: Path, *command: str) -> subprocess.CompletedProcess[str]:
    """Run Python on the copy, with a folder for its kernels."""
    # Bytecode is told by the time and the size of its source, and an edit may leave both as they are.
    ours = {"PYTHONPATH": str(tree), "IAL_CACHE_DIR": str(cache), "PYTHONDONTWRITEBYTECODE": "1"}
    return subprocess.run(
        [sys.executable, *command], cwd=tree, env=os.environ | ours, capture_output=True, text=True, timeout=_LONGEST_S, check=False
    )


def outcome(tree: Path, cache: Path, tests: tuple[str, ...]) -> str:
    """Return which test fails, or that none does."""
    try:
        done = run(tree, cache, "-m", "pytest", "-x", "-q", "-p", "no:cacheprovider", *tests)
    except subprocess.TimeoutExpired:
        return "hangs"
    if done.returncode == 0:
        return "**SURVIVED**"
    failed = [line.split(" ")[1] for line in done.stdout.splitlines() if line.startswith(("FAILED ", "ERROR "))]
    if done.returncode != 1 or not failed or "::" not in failed[0]:
        return f"**NO TEST RAN**: pytest ended with {done.returncode}, {' '.join(failed)}"
    name, _, test = failed[0].partition("::")
    return f"{Path(name).name}: _{test.partition('[')[0]}_"


def main() -> int:
    """Try the edits; return 1 if one survived, 2 if one does not apply."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", nargs="+", default=[""], metavar="TEXT", help="try only edits whose file or text holds one of these")
    parser.add_argument("--open", action="store_true", help="try only edits for which the report names no test")
    parser.add_argument("--report", type=Path, default=ROOT / "bench" / "edits.md", help="the report, bench/edits.md by default")
    options = parser.parse_args()
    listed = Edit.listed()
    edits = [edit for edit in listed if any(text in edit.path or text in edit.old for text in options.only)]
    if options.open:
        edits = [edit for edit in edits if not known(options.report).get(edit.cells, "").endswith("_ |")]
    note(options.report, listed, {})
    if not edits:
        return 0
    with tempfile.TemporaryDirectory() as folder:
        tree, cache = Path(folder) / "ial", Path(folder) / "cache"
        copied(tree)
        stale = [edit for edit in edits if not edit.applies(tree)]
        for edit in stale:
            print(f"DOES NOT APPLY: {edit.path}: {edit.old}")
        if stale:
            return 2
        run(tree, cache, "-c", _PROBE).check_returncode()
        tests = tuple(dict.fromkeys(test for edit in edits for test in edit.tests))
        if (unedited := outcome(tree, cache, tests)) != "**SURVIVED**":
            print(f"tests fail without any edit: {unedited}")
            return 2
        outcomes = []
        for number, edit in enumerate(edits, 1):
            file = tree / edit.path
            text = file.read_text(encoding="utf-8")
            file.write_text(text.replace(edit.old, edit.new), encoding="utf-8")
            with tempfile.TemporaryDirectory() as own:
                compiled = any(mark in text for mark in _COMPILED)
                outcomes.append(outcome(tree, Path(own) if compiled else cache, edit.tests))
            file.write_text(text, encoding="utf-8")
            print(f"{number}/{len(edits)} {edit.cells} {outcomes[-1]}", flush=True)
            note(options.report, listed, {edit.cells: f"{edit.cells} {outcomes[-1]} |"})
    return int(any(each.startswith("**") for each in outcomes))


def known(report: Path) -> dict[str, str]:
    """Return the rows of a report by their cells, those of edits among others."""
    rows = report.read_text(encoding="utf-8").splitlines() if report.exists() else []
    return {row.rpartition("|")[0].rpartition("|")[0] + "|": row for row in rows}


def note(report: Path, edits: list[Edit], news: dict[str, str]) -> None:
    """Write new rows into a report; what it says about edits that are listed no more is left out."""
    rows = known(report) | news
    lines = [rows.get(each.cells, f"{each.cells} not tried |") for each in edits]
    tried = sum(not row.endswith(" not tried |") for row in lines)
    report.write_text(
        "# Edits that break a bound, and the tests that see them\n\n"
        "Made by `bench/edits.py` from `bench/edits.toml`. Each row is an edit of one line, made in a copy of the checkout.\n\n"
        f"{len(lines)} edits, {tried} tried, {sum('| **' in row for row in lines)} survived.\n\n"
        "| file | old | new | killed by |\n| --- | --- | --- | --- |\n" + "\n".join(lines) + "\n",
        encoding="utf-8",
    )


if __name__ == "__main__":
    sys.exit(main())
