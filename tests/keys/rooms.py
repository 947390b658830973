"""A small configuration with everything that one may have."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from ial.keys.key import key
from ial.keys.kind import Maybe, Number, Whole
from ial.keys.record import Named, Part, Record


@dataclass(frozen=True)
class Size(Record):
    """How large something is."""

    gone = {"depth": "is called height now"}

    width: float = field(metadata=key(Number(), "from left to right", "{}"))
    height: float = field(default=2.0, metadata=key(Number(above=0.0), "from bottom to top", "{}"))


@dataclass(frozen=True)
class Place(Record):
    """Where something is."""

    floor: int = field(default=0, metadata=key(Whole(0, 9), "the storey"))


@dataclass(frozen=True)
class Room(Record):
    """A room.

    It has a door.
    """

    place: Place = field(default_factory=Place, metadata=key(Part(Place, flat=True), "where it is"))
    size: Size = field(default=Size(1.0, 3.0), metadata=key(Part(Size), "how large it is", "m"))
    window: Size | None = field(default=None, metadata=key(Maybe(Part(Size)), "its window; null for none", "mm"))
    doors: Mapping[str, Size] = field(default_factory=dict, metadata=key(Named(Size), "its doors, by name", "cm"))
    people: int | None = field(default=None, metadata=key(Maybe(Whole(0)), "how many are in it"))
