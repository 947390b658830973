"""`Report`: the result of a benchmark as Markdown, with what is needed to judge and to repeat it."""

import argparse
import datetime
import os
import platform
import shlex
import sys
from collections.abc import Iterable
from importlib.metadata import version
from pathlib import Path


class Report:
    """Text that is built up line by line, shown as it grows, and written to a file at the end.

    Parameters
    ----------
    title
        The heading.
    about
        What is measured and how, in a few sentences.
    """

    def __init__(self, title: str, about: str) -> None:
        self._lines: list[str] = []
        self.say(f"# {title}\n\n{about}\n")
        self.say(f"- {datetime.datetime.now(datetime.timezone.utc):%Y-%m-%d %H:%M} UTC, ial {version('ial')}, numba {version('numba')}")
        self.say(f"- {_processor()}, {os.cpu_count()} cores, Python {platform.python_version()}, {platform.system()} {platform.release()}")
        if hasattr(os, "getloadavg"):
            self.say(f"- load before: {os.getloadavg()[0]:.1f}; times on a busy machine compare only within one table")
        self.say(f"- repeat with: `python {shlex.join([Path(sys.argv[0]).name, *sys.argv[1:]])}` in `bench/`\n")

    def say(self, text: str = "") -> None:
        """Add a paragraph or a line."""
        self._lines.append(text)
        print(text, flush=True)

    def table(self, head: Iterable[str], rows: Iterable[Iterable[object]]) -> None:
        """Add a table; rows are shown as they come."""
        head = list(head)
        self.say(f"| {' | '.join(head)} |")
        self.say("|---" * len(head) + "|")
        for row in rows:
            self.say(f"| {' | '.join(map(str, row))} |")
        self.say()

    def write(self, out: Path | None) -> None:
        """Write the report to a file, if one is given."""
        if out is not None:
            out.write_text("\n".join(self._lines) + "\n")


def options(about: str) -> argparse.ArgumentParser:
    """Return a parser of the options that every benchmark has."""
    parser = argparse.ArgumentParser(description=about)
    parser.add_argument("--out", type=Path, metavar="FILE", help="also write the report to a file")
    return parser


def _processor() -> str:
    """Return the name of the processor, as well as the system tells it."""
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        return platform.processor() or platform.machine()
    names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.machine()
