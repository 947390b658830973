from dataclasses import MISSING

from ial.keys.entry import entries, gone
from tests.keys.rooms import Room


def test_every_key_is_listed_where_it_stands_with_its_default_and_its_unit() -> None:
    assert [(".".join(entry.path), entry.default, entry.unit, entry.one) for entry in entries(Room)] == [
        ("floor", 0, "", True),
        ("size", {"width": 1.0, "height": 3.0}, "m", False),
        ("size.width", 1.0, "m", True),
        ("size.height", 3.0, "m", True),
        ("window", None, "mm", True),
        ("window.width", MISSING, "mm", True),
        ("window.height", 2.0, "mm", True),
        ("doors", {}, "cm", False),
        ("doors.NAME.width", MISSING, "cm", False),
        ("doors.NAME.height", 2.0, "cm", False),
        ("people", None, "", True),
    ]


def test_keys_of_earlier_versions_are_known() -> None:
    assert list(gone(Room)) == [(("size", "depth"), "is called height now"), (("window", "depth"), "is called height now")]
