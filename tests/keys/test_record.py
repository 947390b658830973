import dataclasses
from typing import Any

import numpy as np
import pytest

from ial.errors import ConfigError
from ial.keys.record import keys_of, names, plain
from tests.keys.rooms import Place, Room, Size

ROOM = Room(Place(3), Size(5.0), Size(4.0, 1.0), {"red": Size(0.9)}, 2)
PLAIN = {
    "floor": 3,
    "size": {"width": 5.0, "height": 2.0},
    "window": {"width": 4.0, "height": 1.0},
    "doors": {"red": {"width": 0.9, "height": 2.0}},
    "people": 2,
}


def test_a_record_is_written_with_its_flat_parts_beside_the_rest() -> None:
    assert plain(ROOM) == PLAIN
    assert list(plain(ROOM)) == list(names(Room)) == list(PLAIN)
    assert plain(Room()) == {"floor": 0, "size": {"width": 1.0, "height": 3.0}, "window": None, "doors": {}, "people": None}


def test_it_is_a_dataclass_like_any_other() -> None:
    assert dataclasses.replace(ROOM, people=None) == Room(Place(3), Size(5.0), Size(4.0, 1.0), {"red": Size(0.9)})
    assert dataclasses.astuple(Size(1.0)) == (1.0, 2.0)
    assert repr(Size(1)) == "Size(width=1.0, height=2.0)"
    with pytest.raises(dataclasses.FrozenInstanceError):
        ROOM.people = 3  # type: ignore[misc]


def test_values_are_kept_in_plain_types_and_dictionaries_are_its_own() -> None:
    doors = {"red": Size(np.float64(0.5))}  # type: ignore[arg-type]
    room = Room(doors=doors)
    doors.clear()
    assert type(room.doors["red"].width) is float
    assert list(room.doors) == ["red"]
    assert [type(name) for name in Room(doors={np.str_("red"): Size(0.5)}).doors] == [str]


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ({"size": 3}, r"Room.size is 3: give its keys \(width, height; in Python, Size\)"),
        ({"place": None}, r"Room.place is None: give its keys \(floor; in Python, Place\)"),
        ({"window": Place()}, r"Room.window is Place\(floor=0\): give its keys .*Size\), or null"),
        ({"doors": {"red": 3}}, "Room.doors is .*: give names, and for each its keys"),
        ({"doors": {1: Size(1.0)}}, "Room.doors is "),
        ({"doors": [Size(1.0)]}, "Room.doors is "),
        ({"people": -1, "size": {}}, "Room.size is {}: .*; Room.people is -1: give a whole number greater than or equal to 0, or null"),
    ],
)
def test_wrong_values_are_refused_by_name_and_all_at_once(wrong: dict[str, Any], said: str) -> None:
    with pytest.raises(ConfigError, match=said):
        Room(**wrong)


def test_the_documentation_lists_the_keys() -> None:
    assert Room.__doc__ is not None
    assert Room.__doc__.startswith("A room.\n\nIt has a door.\n\nParameters\n----------\nplace\n    Where it is.\nsize\n")
    assert "people\n    How many are in it (whole, ≥ 0, null).\n\nRaises\n------\nConfigError\n" in Room.__doc__
    assert "height\n    From bottom to top (> 0).\n" in str(Size.__doc__)


def test_a_key_knows_all_but_its_name_and_default() -> None:
    key = keys_of(Size)["height"]
    assert (key.means, key.unit, key.kind.allowed) == ("from bottom to top", "{}", "a finite number greater than 0")
