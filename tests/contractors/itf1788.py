"""A reader of the interval test language ITL, as far as the bare cases of ITF1788 need it."""

import math
import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

Pair = tuple[float, float]

EMPTY: Pair = (math.inf, -math.inf)
ENTIRE: Pair = (-math.inf, math.inf)

_COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*", re.DOTALL)
_CASE = re.compile(r"(?P<operation>[\w-]+)\s+(?P<inputs>[^=;{}]+?)\s*=\s*(?P<result>[^;{}]+?)\s*;")
_VALUE = re.compile(r"\[[^\]]*\](?:_\w+)?|[^\s,]+")


@dataclass(frozen=True)
class Case:
    """One line: an operation, what goes in, what comes out. A value is a pair of bounds, a number, a truth value or a name."""

    operation: str
    inputs: tuple[Any, ...]
    results: tuple[Any, ...]
    source: str

    @property
    def result(self) -> Any:
        """The only result, or the first of two."""
        return self.results[0]


class _NotBareError(Exception):
    """The value is decorated, NaI, or no literal of two doubles."""


def _number(text: str) -> float:
    text = text.strip().lower().replace("infinity", "inf")
    return float.fromhex(text) if "0x" in text else float(text)


def _value(text: str) -> Any:
    if not text.startswith("["):
        try:
            return {"true": True, "false": False}[text] if text in ("true", "false") else _number(text)
        except ValueError:
            return text
    if "_" in text or text == "[nai]":
        raise _NotBareError
    inside = text[1:-1].strip()
    if inside == "empty":
        return EMPTY
    if inside == "entire":
        return ENTIRE
    lower, _, upper = inside.partition(",")
    return _number(lower), _number(upper or lower)


def _values(text: str) -> tuple[Any, ...]:
    return tuple(_value(word) for word in _VALUE.findall(text))


def cases(folder: Path, *operations: str) -> Iterator[Case]:
    """Yield the bare cases of some operations, out of all files of a folder."""
    for file in sorted(folder.glob("*.itl")):
        text = _COMMENT.sub(lambda comment: "\n" * comment[0].count("\n"), file.read_text())
        for match in _CASE.finditer(text):
            if match["operation"] not in operations:
                continue
            source = f"{file.name}:{text.count(chr(10), 0, match.start()) + 1}: {match[0]}"
            try:
                yield Case(match["operation"], _values(match["inputs"]), _values(match["result"]), source)
            except _NotBareError:
                continue


def flat(values: Iterable[Any]) -> list[Any]:
    """Return the bounds of pairs, and other values as they are, one after the other."""
    return [part for value in values for part in (value if isinstance(value, tuple) else (value,))]


def _same(ours: Any, theirs: Any) -> bool:
    return bool(ours == theirs or (ours != ours and theirs != theirs))


def missed(folder: Path, operation: str, kernel: Callable[..., Any], tight: bool) -> list[str]:
    """Return the bare cases of an operation that a kernel fails: loses some of the result, or, if it should be tight, gives another one."""
    failed = []
    for case in cases(folder, operation):
        ours, theirs = flat([kernel(*flat(case.inputs))]), flat(case.results)
        if not (all(map(_same, ours, theirs)) if tight else ours[0] <= theirs[0] and theirs[1] <= ours[1]):
            failed.append(f"{case.source} but ours is {ours}")
    return failed
