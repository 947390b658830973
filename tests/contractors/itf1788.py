"""A reader of the interval test language ITL, as far as the bare cases of ITF1788 need it."""

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

Bounds = tuple[float, float]

EMPTY: Bounds = (math.inf, -math.inf)
ENTIRE: Bounds = (-math.inf, math.inf)

_COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*", re.DOTALL)
_CASE = re.compile(r"(?P<operation>[\w-]+)\s+(?P<inputs>[^=;{}]+?)\s*=\s*(?P<result>[^;{}]+?)\s*;")
_VALUE = re.compile(r"\[[^\]]*\](?:_\w+)?|[^\s,]+")


@dataclass(frozen=True)
class Case:
    """One line: an operation, what goes in, what comes out. A value is a pair of bounds or a number."""

    operation: str
    inputs: tuple[Bounds | float, ...]
    result: Bounds | float
    source: str


class _NotBareError(Exception):
    """The value is decorated, NaI, or no literal of two doubles."""


def _number(text: str) -> float:
    text = text.strip().lower().replace("infinity", "inf")
    value = float.fromhex(text) if "0x" in text else float(text)
    return value


def _value(text: str) -> Bounds | float:
    if not text.startswith("["):
        return math.nan if text.lower() == "nan" else _number(text)
    if "_" in text or text == "[nai]":
        raise _NotBareError
    inside = text[1:-1].strip()
    if inside == "empty":
        return EMPTY
    if inside == "entire":
        return ENTIRE
    lower, _, upper = inside.partition(",")
    return _number(lower), _number(upper or lower)


def cases(folder: Path, *operations: str) -> Iterator[Case]:
    """Yield the bare cases of some operations, out of all files of a folder."""
    for file in sorted(folder.glob("*.itl")):
        text = _COMMENT.sub(lambda comment: "\n" * comment[0].count("\n"), file.read_text())
        for found in _CASE.finditer(text):
            if found["operation"] not in operations:
                continue
            source = f"{file.name}:{text.count(chr(10), 0, found.start()) + 1}: {found[0]}"
            try:
                inputs = tuple(_value(word) for word in _VALUE.findall(found["inputs"]))
                yield Case(found["operation"], inputs, _value(found["result"]), source)
            except _NotBareError:
                continue
