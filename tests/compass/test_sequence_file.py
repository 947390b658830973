import json
import random
import re
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

from ial.compass.planning import localizing_sequence
from ial.compass.sequence import Sequence
from ial.compass.sequence_file import read_sequence, write_sequence
from ial.errors import OutputError, SequenceError
from tests.maps.polygons.known_polygons import HOLED, SPIKES
from tests.maps.polygons.random_polygons import random_polygon

SEQUENCE = localizing_sequence(SPIKES)


@pytest.fixture
def path(tmp_path: Path) -> Path:
    write_sequence(SEQUENCE, tmp_path / "sequence.json")
    return tmp_path / "sequence.json"


@pytest.mark.parametrize("sequence", [SEQUENCE, localizing_sequence(HOLED), localizing_sequence(random_polygon(12, 2))])
def test_what_is_read_is_what_was_written(tmp_path: Path, sequence: Sequence) -> None:
    write_sequence(sequence, tmp_path / "s.json")
    assert read_sequence(tmp_path / "s.json") == sequence


def test_every_number_that_must_not_be_rounded_is_a_text(path: Path) -> None:
    content = json.loads(path.read_text())
    assert content["format"] == "ial localizing sequence"
    assert content["version"] == 1
    exact = [*content["polygon"]["outer"], *(step["direction"] for step in content["steps"]), content["end"]["place"]]
    assert all(isinstance(number, str) for pair in exact for number in pair)


def refusal(path: Path, change: Callable[[Any], Any]) -> str:
    """Return what is said of a file that was changed."""
    content = json.loads(path.read_text())
    path.write_text(json.dumps(change(content) or content))
    with pytest.raises(SequenceError, match=re.escape(str(path))) as refused:
        read_sequence(path)
    return str(refused.value)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda content: content["polygon"]["outer"].__setitem__(2, ["9", "5/2"]), "step 0: the polygon is not the one"),
        (lambda content: content["boundary"].update(points=8), "step 0: "),
        (lambda content: content["steps"][1].update(direction=["1", "1"]), "step 2: it was changed, or one before it is missing"),
        (lambda content: content["steps"][1].update(points=77), "step 2: it was changed"),
        (lambda content: content["steps"].pop(0) and None, "step 1: it was changed, or one before it is missing"),
        (lambda content: content["steps"].pop() and None, f"step {len(SEQUENCE) - 1}: the end was changed, or a step before it is missing"),
        (lambda content: content["steps"].insert(1, content["steps"][0]), "step 2: "),
        (lambda content: content["end"].update(place=["1", "1"]), f"step {len(SEQUENCE)}: the end was changed"),
        (
            lambda content: content["steps"][0].update(direction=["2.5", "1"]),
            "step 1: the direction is ['2.5', '1'], not two exact numbers",
        ),
        (lambda content: content["steps"][0].update(direction=[2, 1]), "step 1: the direction is [2, 1], not two exact numbers as texts"),
        (lambda content: content["steps"][0].update(direction=["1/2", "1"]), "step 1: the direction is no pair of whole numbers"),
        (lambda content: content["steps"][0].update(direction=[str(2**64), "1"]), "of at most 64 bits"),
        (lambda content: content["steps"][0].update(direction=["0", "0"]), "leads nowhere"),
        (lambda content: content["steps"][0].update(direction=["1/0", "1"]), "divides by zero"),
        (lambda content: content["steps"][0].update(pieces="3"), "not two whole numbers"),
        (lambda content: content["steps"][0].update(pieces=-3), "not two whole numbers"),
        (lambda content: content.update(steps=None), 'no list "steps"'),
        (lambda content: content["steps"].__setitem__(0, 7), "step 1: this is no step"),
        (lambda content: content.update(version=2), "version 2, and this program reads 1"),
        (lambda content: content["polygon"]["outer"].reverse(), "step 0: the polygon is not the one"),
        (lambda content: content["polygon"]["outer"].append(content["polygon"]["outer"][0]), "a corner twice"),
        (lambda content: content.update(polygon=None), 'no "outer" ring'),
        (lambda content: {"polygons": []}, "this is no localizing sequence"),
        (lambda content: [1], "this is no localizing sequence"),
    ],
)
def test_a_file_that_was_changed_is_refused_at_its_step(path: Path, change: Callable[[Any], Any], said: str) -> None:
    assert said in refusal(path, change)


def test_what_is_no_file_of_a_sequence(tmp_path: Path) -> None:
    path = tmp_path / "s.json"
    with pytest.raises(SequenceError, match="cannot be read"):
        read_sequence(path)
    for content in (b"", b"\xff\xfe", b'{"format": ', b"[" * 10_000):
        path.write_bytes(content)
        with pytest.raises(SequenceError, match="not JSON"):
            read_sequence(path)
    with pytest.raises(OutputError, match="cannot be written"):
        write_sequence(SEQUENCE, tmp_path / "nowhere" / "s.json")


def altered(content: Any, chooser: random.Random) -> None:
    """Change a direction, a vertex or the end, or leave out a step."""
    steps = content["steps"]
    at = chooser.randrange(len(steps))
    kind = chooser.randrange(4)
    if kind == 3:
        del steps[at]
        return
    pair = (steps[at]["direction"], chooser.choice(content["polygon"]["outer"]), content["end"]["place"])[kind]
    which = chooser.randrange(2)
    pair[which] = str(Fraction(pair[which]) + chooser.choice((-2, -1, 1, 2)))


def test_200_altered_files_are_all_refused_at_their_step(path: Path) -> None:
    chooser = random.Random(6)
    whole = path.read_text()
    for _ in range(200):
        path.write_text(whole)
        assert re.search(r": step \d+: ", refusal(path, lambda content: altered(content, chooser)))


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ('"version": 1', '"version": true', "version True"),
        ('"version": 1', '"version": 1.0', "version 1.0"),
        ('"version": 1', '"version": 1, "note": "mine"', "it has 'note', which no sequence has"),
        ('"version": 1', '"version": 1, "version": 1', "a name stands twice"),
        ('{"direction"', '{"direction": ["7", "7"], "direction"', "a name stands twice"),
    ],
)
def test_what_readers_may_take_in_different_ways_is_refused(path: Path, old: str, new: str, said: str) -> None:
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new, 1))
    with pytest.raises(SequenceError, match=said):
        read_sequence(path)
