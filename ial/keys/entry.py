"""`Entry`: a key where it stands in a configuration."""

from collections.abc import Iterator
from dataclasses import MISSING, dataclass, fields
from typing import Any

from ial.keys.key import Key
from ial.keys.record import Named, Part, Record, keys_of, part_of

ANY_NAME = "NAME"
"""Stands in a path for a name that the user chooses."""


@dataclass(frozen=True)
class Entry:
    """A key where it stands.

    Parameters
    ----------
    path
        The keys that lead to it, as in files, and itself.
    key
        Its description.
    default
        The value that it has by default, as files hold it; MISSING if it has to be given.
    unit
        Its unit, empty for none.
    """

    path: tuple[str, ...]
    key: Key
    default: Any
    unit: str

    @property
    def one(self) -> bool:
        """Whether it has a place of its own in every configuration, and a value that is no keys of their own."""
        return ANY_NAME not in self.path and not isinstance(self.key.kind, Part | Named)


def entries(record: type[Record], base: Record | None = None, path: tuple[str, ...] = (), unit: str = "") -> Iterator[Entry]:
    """Yield the keys of a record and of its parts, in the order of files; a part comes before its keys.

    Parameters
    ----------
    record
        The class.
    base
        A record of that class with the defaults, if it has others here than everywhere.
    path, unit
        Where the record stands, and the unit of that.
    """
    for each in fields(record):
        key = keys_of(record)[each.name]
        default: Any = each.default
        if base is not None:
            default = getattr(base, each.name)
        elif each.default_factory is not MISSING:
            default = each.default_factory()
        part = part_of(key.kind)
        if isinstance(key.kind, Part) and key.kind.flat:
            yield from entries(key.kind.of, default, path, unit)
            continue
        own = key.unit.format(unit)
        yield Entry((*path, each.name), key, default if default is MISSING else key.kind.written(default), own)
        if part is not None:
            yield from entries(part, default, (*path, each.name), own)
        if isinstance(key.kind, Named):
            yield from entries(key.kind.of, None, (*path, each.name, ANY_NAME), own)


def gone(record: type[Record], path: tuple[str, ...] = ()) -> Iterator[tuple[tuple[str, ...], str]]:
    """Yield the keys that a record and its parts had in earlier versions, as paths, and what is to be done about each."""
    for name, text in record.gone.items():
        yield (*path, name), text
    for entry in entries(record):
        part = part_of(entry.key.kind)
        if part is not None and len(entry.path) == 1:
            yield from gone(part, (*path, *entry.path))
