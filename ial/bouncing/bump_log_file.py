"""Logs of bumps on disk: which form a file has, and writing one."""

import csv
import io
import json
from collections.abc import Sequence
from fractions import Fraction
from pathlib import Path

from ial.bouncing.bump_event import BumpEvent
from ial.bouncing.bump_log import COLUMNS, LogForm
from ial.errors import StreamError
from ial.maps.polygons.exact_number import text_of
from ial.whole_file import whole_files

_FORMS: dict[str, LogForm] = {".csv": "csv", ".jsonl": "jsonl"}


def log_form(path: Path) -> LogForm:
    """Return what a log is written in, by the suffix of its name.

    Raises
    ------
    StreamError
        If the suffix is another one.
    """
    try:
        return _FORMS[path.suffix.lower()]
    except KeyError:
        raise StreamError(f"{path}: a log is named .csv (with a header) or .jsonl (JSON lines); give it one of these names") from None


def write_log(events: Sequence[BumpEvent], path: Path) -> None:
    """Write a log, in the form of its suffix; `bump_events` reads the same events.

    Raises
    ------
    StreamError
        If the suffix is not one of a log.
    OutputError
        If the file cannot be written.
    """
    form = log_form(path)
    rows = [_fields(event) for event in events]
    names = [name for name in COLUMNS if name in COLUMNS[:2] or any(name in row for row in rows)]
    text = io.StringIO()
    if form == "csv":
        table = csv.DictWriter(text, names, lineterminator="\n")
        table.writeheader()
        table.writerows(rows)
    else:
        text.writelines(f"{json.dumps(row, ensure_ascii=False)}\n" for row in rows)
    with whole_files(path, what="the log") as (lent,):
        lent.write_text(text.getvalue(), encoding="utf-8")


def _fields(event: BumpEvent) -> dict[str, str]:
    fields = {"time": _digits(event.time_s), "event": str(event.kind)}
    if event.robot:
        fields["robot"] = event.robot
    if event.place is not None:
        fields |= dict(zip(COLUMNS[3:], map(_digits, event.place), strict=True))
    return fields


def _digits(number: Fraction) -> str:
    """Return a number exactly: as a decimal with up to nine digits, else as a fraction."""
    billionths = number * 10**9
    if billionths.denominator > 1:
        return text_of(number)
    whole, part = divmod(abs(billionths.numerator), 10**9)
    decimals = f"{part:09d}".rstrip("0")
    return f"{'-' * (number < 0)}{whole}{'.' * bool(decimals)}{decimals}"
