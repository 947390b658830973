"""Writes the table of all keys of the configuration into its page: python docs/keys.py."""

from collections.abc import Iterator
from dataclasses import MISSING
from pathlib import Path
from typing import Any

from ial.keys.entry import Entry, entries
from ial.keys.record import Part
from ial.lidar import LocalizerConfig

PAGE = Path(__file__).resolve().parent / "localize.md"
BEGIN = "<!-- written by docs/keys.py -->\n"
END = "<!-- end of what docs/keys.py writes -->\n"


def table() -> str:
    """Return the table, as Markdown."""
    head = ["| key | default | unit | values | means |", "|---|---|---|---|---|"]
    return "\n".join([*head, *_rows(), ""])


def page() -> str:
    """Return the page with the table of today."""
    before, _, rest = PAGE.read_text(encoding="utf-8").partition(BEGIN)
    _, _, after = rest.partition(END)
    return f"{before}{BEGIN}\n{table()}\n{END}{after}"


def _rows() -> Iterator[str]:
    for entry in entries(LocalizerConfig):
        cells = [f"`{'.'.join(entry.path)}`", _default(entry), entry.unit, entry.key.kind.brief, entry.key.means]
        yield f"| {' | '.join(cells)} |"


def _default(entry: Entry) -> str:
    value: Any = entry.default
    if isinstance(entry.key.kind, Part):
        return ""
    if value is MISSING:
        return "must be given"
    if isinstance(value, str):
        return f"`{value}`"
    if value is None or isinstance(value, bool):
        return "null" if value is None else str(value).lower()
    return f"{value:.4g}" if isinstance(value, float) else str(value)


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
