"""Logs of bumps with times: CSV with a header, or JSON lines, read line by line so that a log may still grow."""

import csv
import json
from collections.abc import Iterable, Iterator, Mapping
from fractions import Fraction
from typing import Any, Literal, cast

from ial.bouncing.bump_event import BumpEvent, EventKind
from ial.errors import MapError, StreamError
from ial.maps.polygons.exact_number import exact_number

LogForm = Literal["csv", "jsonl"]
COLUMNS = ("time", "event", "robot", "x", "y", "heading")
"""What is read of a line: the first two must be there, and the last three count at a start alone."""

_KINDS = ("start", "bump")
_PLACE = COLUMNS[3:]


def bump_events(lines: Iterable[bytes], name: str, form: LogForm | None = None) -> Iterator[BumpEvent]:
    """Yield the events of a log, each as soon as its line is there.

    Parameters
    ----------
    lines
        The lines with their line breaks.
    name
        What the log is called in messages.
    form
        What it is written in; told by the first line if it is left out.

    Raises
    ------
    StreamError
        If a line is no event or is cut off, a clock goes back, only some lines name a robot, or there is no event at all.
    """
    header: list[str] | None = None
    times: dict[str, Fraction] = {}
    count = 0
    for count, raw in enumerate(lines, 1):
        where = f"{name}, line {count}"
        text = _text(raw, where).strip()
        if not text:
            continue
        form = form or ("jsonl" if text.startswith("{") else "csv")
        if form == "csv" and header is None:
            header = _header(text, where)
            continue
        event = _event(_object(text, where) if header is None else _row(text, header, where), where)
        if times and (event.robot == "") != ("" in times):
            raise StreamError(f"{where}: only some lines name a robot, so it is not clear whose the others are; name it in all, or in none")
        before = times.get(event.robot, event.time_s)
        if event.time_s < before:
            raise StreamError(
                f"{where}: the clock goes back, from {float(before):.10g} to {float(event.time_s):.10g} s; sort the lines by time, and "
                "give robots with clocks of their own names in a column `robot`"
            )
        times[event.robot] = event.time_s
        yield event
    if not times:
        raise StreamError(f"{name}: the log holds no event{'' if count else ' and no line'}; give lines with `time` and `event`")


def _text(raw: bytes, where: str) -> str:
    if not raw.endswith(b"\n"):  # 12.3 may be the beginning of 12.34
        raise StreamError(f"{where}: the line does not end, so the log may be cut off; end it with a line break if it is complete")
    try:
        return raw.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise StreamError(f"{where}: no text; give CSV or JSON lines in UTF-8") from None


def _cells(text: str, where: str) -> list[str]:
    try:
        return [cell.strip() for cell in next(csv.reader([text], strict=True))]
    except csv.Error as error:
        raise StreamError(f"{where}: no line of CSV ({error}); separate the columns by commas") from None


def _header(text: str, where: str) -> list[str]:
    header = _cells(text, where)
    for name in COLUMNS:
        if name in COLUMNS[:2] and name not in header:
            raise StreamError(f"{where}: the header {text[:60]!r} has no column `{name}`; begin the log with `time,event`")
        if header.count(name) > 1:
            raise StreamError(f"{where}: the header has the column `{name}` twice; leave one out")
    return header


def _row(text: str, header: list[str], where: str) -> dict[str, Any]:
    cells = _cells(text, where)
    if len(cells) != len(header):
        raise StreamError(f"{where}: {len(cells)} columns, and the header has {len(header)}; is the line cut off?")
    return {name: cell for name, cell in zip(header, cells, strict=True) if cell}


def _object(text: str, where: str) -> dict[str, Any]:
    def number(digits: str) -> Fraction:
        return _number(digits, where)

    def once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        read = dict(pairs)
        if len(read) < len(pairs):
            raise StreamError(f"{where}: a name stands there twice; leave one out")
        return read

    try:
        read = json.loads(text, parse_float=number, parse_int=number, parse_constant=number, object_pairs_hook=once)
    except (json.JSONDecodeError, RecursionError):
        read = None
    if not isinstance(read, dict):
        raise StreamError(f'{where}: no JSON object in one line, or a part of one; give {{"time": 12.34, "event": "bump"}}')
    return {name: value for name, value in read.items() if value is not None}


def _number(value: object, where: str) -> Fraction:
    try:
        return exact_number(value, where)
    except MapError as error:
        raise StreamError(str(error)) from None


def _event(fields: Mapping[str, Any], where: str) -> BumpEvent:
    for name in COLUMNS[:2]:
        if name not in fields:
            raise StreamError(f"{where}: no `{name}`; every line needs a time in seconds, and `start` or `bump`")
    kind, robot = fields["event"], fields.get("robot", "")
    if kind not in _KINDS:
        raise StreamError(f"{where}: the event {str(kind)[:40]!r} is not known; write start (the robot begins to drive) or bump")
    if not isinstance(robot, str) and not (isinstance(robot, Fraction) and robot.denominator == 1):
        raise StreamError(f"{where}: the robot is {str(robot)[:40]!r}; give a name")
    known = [name for name in _PLACE if name in fields] if kind == "start" else []
    place = None
    if known:
        if len(known) < len(_PLACE):
            raise StreamError(
                f"{where}: a start with {' and '.join(known)} alone; give x and y in metres and the heading in degrees, or none"
            )
        x, y, heading = (_number(fields[name], f"{where}, {name}") for name in _PLACE)
        place = (x, y, heading)
    return BumpEvent(_number(fields["time"], f"{where}, time"), cast(EventKind, kind), str(robot), place, where)
