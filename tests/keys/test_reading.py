from typing import Any

import pytest

from ial.errors import ConfigError
from ial.keys.reading import read
from ial.keys.record import plain
from tests.keys.rooms import Place, Room, Size
from tests.keys.test_record import PLAIN, ROOM


def test_what_is_written_reads_back() -> None:
    assert read(Room(), PLAIN) == ROOM
    assert read(ROOM, plain(Room())) == Room(doors={})
    assert read(ROOM, {}) == ROOM


def test_keys_that_are_left_out_keep_the_value_that_was_there() -> None:
    assert read(Room(), {"size": {"width": "7"}}).size == Size(7.0, 3.0)
    assert read(ROOM, {"window": {"height": 9}}).window == Size(4.0, 9.0)
    assert read(Room(), {"window": {"width": 9}}).window == Size(9.0, 2.0)  # there was none
    assert read(ROOM, {"window": None}).window is None
    assert read(ROOM, {"doors": {"blue": {"width": 1}}}).doors == {"blue": Size(1.0)}
    assert read(ROOM, {"floor": 9.0}).place == Place(9)


@pytest.mark.parametrize(
    ("content", "said"),
    [
        ({"flor": 1}, "^unknown key 'flor'; allowed are floor, size, window, doors, people; did you mean 'floor'\\?$"),
        ({"place": {"floor": 1}}, "^unknown key 'place'; allowed are floor, "),
        ({1: 1}, "^unknown key '1'; "),
        ({"window": {"hight": 1, "width": 1}}, "^unknown key 'window.hight'; allowed are width, height; did you mean 'height'\\?$"),
        ({"window": {"height": 1}}, "^the key 'window.width' is missing$"),
        ({"window": 4}, "^window is 4: give its keys .*, or null$"),
        ({"doors": {"red": {"depth": 1, "width": 1}}}, "^the key 'doors.red.depth' is called height now$"),
        ({"doors": {"red": 3}}, "^doors.red is 3: give its keys "),
        ({"doors": {2: {"width": 1}}}, "^doors: the name 2 is no text; put it in quotes$"),
        ({"doors": None}, "^doors is None: give names"),
        ({"size": None}, "^size is None: give its keys"),
        ({"size": {"width": -1, "height": 0}, "floor": "x"}, "^floor is 'x': .*; size.width is -1: .*; size.height is 0: [^;]*$"),
    ],
)
def test_every_fault_is_named_with_its_path(content: dict[Any, Any], said: str) -> None:
    with pytest.raises(ConfigError, match=said):
        read(Room(), content)
