"""`Record`: a dataclass whose fields are keys. It refuses wrong values, and its documentation lists its keys."""

import inspect
import textwrap
from collections.abc import Iterator, Mapping
from dataclasses import Field, dataclass, fields
from typing import Any, ClassVar

from ial.errors import ConfigError
from ial.keys.key import Key
from ial.keys.kind import Kind, Maybe, shown


class Record:
    """The base of frozen dataclasses of which every field has a `key`.

    Raises
    ------
    ConfigError
        If a value may not be given. Values in types of NumPy become those of Python.
    """

    __dataclass_fields__: ClassVar[dict[str, Field[Any]]]
    gone: ClassVar[Mapping[str, str]] = {}  # keys of earlier versions, and what is to be done about each

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        described = {name: each.metadata["key"] for name, each in vars(cls).items() if isinstance(each, Field)}
        entries = [f"{name}\n{textwrap.indent(each.sentence, '    ')}" for name, each in described.items()]
        raised = "ConfigError\n    If a value may not be given."
        sections = ["Parameters\n----------", *entries, "", "Raises\n------", raised]
        cls.__doc__ = "\n".join([inspect.cleandoc(cls.__doc__ or ""), "", *sections, ""])

    def __post_init__(self) -> None:
        faults = []
        for name, each in keys_of(type(self)).items():
            value = getattr(self, name)
            try:
                object.__setattr__(self, name, each.kind.checked(value))
            except ValueError as fault:
                faults.append(f"{type(self).__name__}.{name} is {shown(value)}: {fault}")
        if faults:
            raise ConfigError("; ".join(faults))


def keys_of(record: type[Record]) -> Mapping[str, Key]:
    """Return the keys of a record by their names."""
    return {each.name: each.metadata["key"] for each in fields(record)}


def plain(record: Record) -> dict[str, Any]:
    """Return a record as a file holds it: keys, and values that YAML and JSON have."""
    content: dict[str, Any] = {}
    for name, each in keys_of(type(record)).items():
        value = each.kind.written(getattr(record, name))
        content |= value if isinstance(each.kind, Part) and each.kind.flat else {name: value}
    return content


@dataclass(frozen=True)
class Part(Kind):
    """A record within a record.

    Parameters
    ----------
    of
        Its class.
    flat
        Whether files write its keys beside those around it, and not below a key of their own.
    """

    of: type[Record]
    flat: bool = False

    @property
    def allowed(self) -> str:
        """What may be given."""
        return f"its keys ({', '.join(names(self.of))}; in Python, {self.of.__name__})"

    @property
    def brief(self) -> str:
        """The same, short."""
        return ""

    def checked(self, value: Any) -> Record:
        """Return a record of that class as it is."""
        if not isinstance(value, self.of):
            raise ValueError(f"give {self.allowed}")
        return value

    def written(self, value: Any) -> dict[str, Any]:
        """Return its keys and their values."""
        return plain(value)


@dataclass(frozen=True)
class Named(Kind):
    """Records of one class by names that the user chooses.

    Parameters
    ----------
    of
        Their class.
    """

    of: type[Record]

    @property
    def allowed(self) -> str:
        """What may be given."""
        return f"names, and for each {Part(self.of).allowed}"

    @property
    def brief(self) -> str:
        """The same, short."""
        return ""

    def checked(self, value: Any) -> dict[str, Record]:
        """Return a dictionary of their own of records as they are."""
        if not isinstance(value, Mapping) or not all(isinstance(one, str) and isinstance(each, self.of) for one, each in value.items()):
            raise ValueError(f"give {self.allowed}")
        return {str(name): each for name, each in value.items()}

    def written(self, value: Any) -> dict[str, dict[str, Any]]:
        """Return the keys and values of each."""
        return {name: plain(each) for name, each in value.items()}


def part_of(kind: Kind) -> type[Record] | None:
    """Return the class of the record that a value of a kind is, or may be; None if it is no record."""
    within = kind.of if isinstance(kind, Maybe) else kind
    return within.of if isinstance(within, Part) else None


def names(record: type[Record]) -> Iterator[str]:
    """Yield the keys of a record as files have them."""
    for name, each in keys_of(record).items():
        if isinstance(each.kind, Part) and each.kind.flat:
            yield from names(each.kind.of)
        else:
            yield name
