"""Files of localizing sequences: `write_sequence`, `read_sequence`.

JSON with every number as a text, so that none is rounded by whatever reads it: the polygon, the sizes of the first information state, for
each step its direction and the sizes after it, and the end. Each step carries a digest of everything before and of itself, so that a
change is found at its step. A digest proves that a file is as it was written; that the sequence is right, `verify` proves.
"""

import hashlib
import json
import re
from fractions import Fraction
from pathlib import Path
from typing import Any

from ial.compass.primitive import MOST_BITS
from ial.compass.sequence import Sequence, Sizes
from ial.errors import MapError, SequenceError
from ial.maps.polygons.polygon import ExactPoint
from ial.maps.polygons.polygon_json import parse_polygon_json, polygon_json
from ial.whole_file import whole_files

_FORMAT, _VERSION = "ial localizing sequence", 1
_LARGEST_FILE = 2**26  # bytes
_NUMBER = re.compile(r"-?\d{1,4000}(/\d{1,4000})?", re.ASCII)

_KEYS = {"format", "version", "polygon", "boundary", "steps", "end"}


def write_sequence(sequence: Sequence, path: str | Path) -> None:
    """Write a localizing sequence with its certificate.

    Raises
    ------
    OutputError
        If the file cannot be written.
    """
    record = _record(sequence)
    steps = ",\n  ".join(json.dumps(each) for each in record.pop("steps"))
    lines = [f"{json.dumps(key)}: {json.dumps(value)}" for key, value in record.items()]
    lines.insert(-1, f'"steps": [\n  {steps}\n ]')
    text = "{\n " + ",\n ".join(lines) + "\n}"
    with whole_files(path, what="the sequence") as (lent,):
        lent.write_text(text + "\n", encoding="utf-8")


def read_sequence(path: str | Path) -> Sequence:
    """Read a localizing sequence; whether it is right is for `verify` to say.

    Raises
    ------
    SequenceError
        If the file cannot be read, holds something else, or is not as it was written; if a step was changed or is missing, the message
        says which.
    """
    path = Path(path)
    try:
        if path.stat().st_size > _LARGEST_FILE:
            raise SequenceError(f"the file is larger than {_LARGEST_FILE} bytes; a localizing sequence is not so long")
        content = json.loads(path.read_text(encoding="utf-8"), object_pairs_hook=_once)
    except SequenceError as error:
        raise SequenceError(f"{path}: {error}") from None
    except OSError as error:
        raise SequenceError(f"{path}: the sequence cannot be read ({error.strerror or error}); check the path") from None
    except (ValueError, RecursionError) as error:
        raise SequenceError(f"{path}: this is no sequence, since it is not JSON ({error}); write one with `ial compass plan`") from None
    try:
        return _sequence(content)
    except SequenceError as error:
        raise SequenceError(f"{path}: {error}") from None


def _once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    held = dict(pairs)
    if len(held) < len(pairs):
        raise SequenceError("a name stands twice in one part of it, so that readers may differ in what it says; plan the sequence again")
    return held


def _record(sequence: Sequence) -> dict[str, Any]:
    polygon = json.loads(polygon_json([sequence.polygon]))["polygons"][0]
    end = [str(number) for number in sequence.end]
    first = {"pieces": sequence.sizes[0][0], "points": sequence.sizes[0][1]}
    digest = _digest("", polygon, first)
    record: dict[str, Any] = {"format": _FORMAT, "version": _VERSION, "polygon": polygon, "boundary": {**first, "sha256": digest}}
    steps = []
    for direction, (pieces, points) in zip(sequence.directions, sequence.sizes[1:], strict=True):
        step = {"direction": [str(number) for number in direction], "pieces": pieces, "points": points}
        digest = _digest(digest, step)
        steps.append({**step, "sha256": digest})
    return {**record, "steps": steps, "end": {"place": end, "sha256": _digest(digest, end)}}


def _digest(before: str, *content: Any) -> str:
    """Return the SHA-256 of a text that says what came before, and some content with its keys sorted."""
    return hashlib.sha256(json.dumps([before, *content], sort_keys=True).encode()).hexdigest()


def _sequence(content: Any) -> Sequence:
    if not isinstance(content, dict) or content.get("format") != _FORMAT:
        raise SequenceError("this is no localizing sequence; write one with `ial compass plan`")
    if type(content.get("version")) is not int or content["version"] != _VERSION:
        raise SequenceError(f"the sequence has version {content.get('version')!r}, and this program reads {_VERSION}; plan it again")
    try:
        polygons = parse_polygon_json(json.dumps({"polygons": [content.get("polygon")]}))
    except MapError as error:
        raise SequenceError(f"step 0: {error}") from None
    if unknown := sorted(content.keys() - _KEYS):
        raise SequenceError(f"it has {unknown[0][:40]!r}, which no sequence has; plan it again")
    steps, boundary, end = content.get("steps"), content.get("boundary"), content.get("end")
    if not isinstance(steps, list) or not isinstance(boundary, dict) or not isinstance(end, dict):
        raise SequenceError('the sequence has no list "steps", or no "boundary", or no "end"; plan it again')
    sizes, directions = [_sizes(boundary, 0)], []
    for number, step in enumerate(steps, 1):
        if not isinstance(step, dict):
            raise SequenceError(f"step {number}: this is no step; plan the sequence again")
        directions.append(_direction(step, number))
        sizes.append(_sizes(step, number))
    read = Sequence(polygons[0], tuple(directions), tuple(sizes), _place(end))
    _compare(_record(read), content)
    return read


def _compare(record: dict[str, Any], content: dict[str, Any]) -> None:
    """Raise unless a file is what would be written for what was read from it."""
    if record["polygon"] != content["polygon"] or record["boundary"] != content["boundary"]:
        raise SequenceError("step 0: the polygon is not the one that the sequence was written with; plan it again")
    for number, (step, held) in enumerate(zip(record["steps"], content["steps"], strict=True), 1):
        if step != held:
            raise SequenceError(f"step {number}: it was changed, or one before it is missing; plan the sequence again")
    if record["end"] != content["end"]:
        raise SequenceError(f"step {len(record['steps'])}: the end was changed, or a step before it is missing; plan the sequence again")


def _sizes(step: dict[str, Any], number: int) -> Sizes:
    sizes = step.get("pieces"), step.get("points")
    if not all(type(each) is int and 0 <= each < 2**32 for each in sizes):
        raise SequenceError(f'step {number}: "pieces" and "points" are {sizes}, not two whole numbers; plan the sequence again')
    return sizes  # type: ignore[return-value]


def _numbers(pair: Any, step: int, what: str) -> tuple[Fraction, Fraction]:
    if not isinstance(pair, list) or len(pair) != 2 or not all(isinstance(each, str) and _NUMBER.fullmatch(each) for each in pair):
        raise SequenceError(f'step {step}: {what} is {str(pair)[:60]}, not two exact numbers as texts, such as ["3", "-1/2"]')
    try:
        return Fraction(pair[0]), Fraction(pair[1])
    except ZeroDivisionError:
        raise SequenceError(f"step {step}: {what} is {str(pair)[:60]}, which divides by zero") from None


def _direction(step: dict[str, Any], number: int) -> tuple[int, int]:
    x, y = _numbers(step.get("direction"), number, "the direction")
    if not x and not y:
        raise SequenceError(f"step {number}: the direction is (0, 0), which leads nowhere")
    if x.denominator > 1 or y.denominator > 1 or max(abs(x), abs(y)) >= 2**MOST_BITS:
        raise SequenceError(f"step {number}: the direction is no pair of whole numbers of at most {MOST_BITS} bits")
    return int(x), int(y)


def _place(end: dict[str, Any]) -> ExactPoint:
    return _numbers(end.get("place"), 0, "the end")
