"""Edits of one line each that break a bound, and whether a test sees them.

    python bench/edits.py [--only TEXT ...] [--report FILE]

A test that no wrong line can make fail says nothing. `edits.toml` lists lines of the code that carry a bound, what to write in their
place, and the tests that have to see it. Each edit is made in a copy of the checkout, and these tests run on it; the report, `edits.md`,
says which test killed the edit, or that it SURVIVED. An edit whose old text does not occur exactly once any more is named, and nothing is
run before all apply: the list is mended together with the code. `--only` tries those whose file or text holds one of some texts, and
writes no report unless asked.

An edit takes some seconds, most of them to compile its kernels: the cache of each is its own, and is thrown away.
"""

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
import tomllib
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
_LONGEST_S = 900
_PROBE = """
import ial, ial.contractors.rounding, ial.datasets.motion, ial.maps.cell_index, pathlib
for module in (ial, ial.contractors.rounding, ial.datasets.motion, ial.maps.cell_index):
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

    def place(self, tree: Path) -> int:
        """Return the line at which the old text stands, 0 if it does not stand there exactly once."""
        text = (tree / self.path).read_text(encoding="utf-8")
        return text[: text.index(self.old)].count("\n") + 1 if text.count(self.old) == 1 else 0

    def row(self, line: int, outcome: str) -> str:
        """Return a row of the report."""
        old, new = (" ".join(text.split()).replace("|", "\\|") for text in (self.old, self.new))
        return f"| {self.path}:{line} | `{old}` | {f'`{new}`' if new else '(nothing)'} | {outcome} |"


def copied(tree: Path) -> None:
    """Copy what git tracks, or would track, links as links."""
    listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard", "-z"], cwd=ROOT, capture_output=True, text=True, check=True)
    for name in filter(None, listed.stdout.split("\0")):
        if (ROOT / name).exists():
            (tree / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, tree / name, follow_symlinks=False)


def run(tree: Path, *command: str) -> subprocess.CompletedProcess[str]:
    """Run Python on the copy, with an empty cache of kernels."""
    with tempfile.TemporaryDirectory() as cache:
        # Bytecode is told by the time and the size of its source, and an edit may leave both as they are.
        ours = {"PYTHONPATH": str(tree), "IAL_CACHE_DIR": cache, "PYTHONDONTWRITEBYTECODE": "1"}
        return subprocess.run(
            [sys.executable, *command], cwd=tree, env=os.environ | ours, capture_output=True, text=True, timeout=_LONGEST_S, check=False
        )


def outcome(tree: Path, tests: tuple[str, ...]) -> str:
    """Return which test fails, or that none does."""
    try:
        done = run(tree, "-m", "pytest", "-x", "-q", "-p", "no:cacheprovider", *tests)
    except subprocess.TimeoutExpired:
        return "hangs"
    if done.returncode == 0:
        return "**SURVIVED**"
    failed = [line.split(" ")[1] for line in done.stdout.splitlines() if line.startswith(("FAILED ", "ERROR "))]
    if done.returncode != 1 or not failed or "::" not in failed[0]:
        return f"**NO TEST RAN**: pytest ended with {done.returncode}, {' '.join(failed)}"
    name, _, test = failed[0].partition("::")
    return f"{Path(name).name}: {test.partition('[')[0]}"


def main() -> int:
    """Try the edits; return 1 if one survived, 2 if one does not apply."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", nargs="+", default=[""], metavar="TEXT", help="try only edits whose file or text holds one of these")
    parser.add_argument("--report", type=Path, help="where to write the report; bench/edits.md if all edits are tried")
    options = parser.parse_args()
    edits = [edit for edit in Edit.listed() if any(text in edit.path or text in edit.old for text in options.only)]
    report = options.report or (None if any(options.only) else ROOT / "bench" / "edits.md")
    with tempfile.TemporaryDirectory() as folder:
        tree = Path(folder) / "ial"
        copied(tree)
        stale = [edit for edit in edits if not edit.place(tree)]
        for edit in stale:
            print(f"DOES NOT APPLY: {edit.path}: {edit.old}")
        if stale:
            return 2
        run(tree, "-c", _PROBE).check_returncode()
        tests = tuple(dict.fromkeys(test for edit in edits for test in edit.tests))
        if (unedited := outcome(tree, tests)) != "**SURVIVED**":
            print(f"tests fail without any edit: {unedited}")
            return 2
        rows = []
        for number, edit in enumerate(edits, 1):
            file = tree / edit.path
            text, line = file.read_text(encoding="utf-8"), edit.place(tree)
            file.write_text(text.replace(edit.old, edit.new), encoding="utf-8")
            rows.append(edit.row(line, outcome(tree, edit.tests)))
            file.write_text(text, encoding="utf-8")
            print(f"{number}/{len(edits)} {rows[-1]}", flush=True)
            if report:
                report.write_text(_written(rows, len(edits)), encoding="utf-8")
    return int(any("**" in row for row in rows))


def _written(rows: list[str], wanted: int) -> str:
    survivors = sum("**" in row for row in rows)
    return (
        "# Edits that break a bound, and the tests that see them\n\n"
        "Made by `bench/edits.py` from `bench/edits.toml`. Each row is an edit of one line, made in a copy of the checkout.\n\n"
        f"{len(rows)} of {wanted} edits tried, {survivors} survived.\n\n"
        "| where | old | new | killed by |\n| --- | --- | --- | --- |\n" + "\n".join(rows) + "\n"
    )


if __name__ == "__main__":
    sys.exit(main())
