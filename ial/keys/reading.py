"""`read`: a record with the values that a file or another source gives; every fault is named, with what to do."""

from collections.abc import Mapping
from dataclasses import MISSING, fields
from difflib import get_close_matches
from typing import Any, TypeVar

from ial.errors import ConfigError
from ial.keys.kind import Kind, shown
from ial.keys.record import Named, Part, Record, keys_of, names, part_of

R = TypeVar("R", bound=Record)


def read(base: R, content: Mapping[Any, Any]) -> R:
    """Return a record with other values for some of its keys.

    Parameters
    ----------
    base
        Where the values of keys come from that are left out.
    content
        Keys and values as `ial.keys.record.plain` writes them, or as people write them: a text may stand for a number.

    Raises
    ------
    ConfigError
        If a key is unknown, or a value may not be given. All faults are said.
    """
    faults: list[str] = []
    record = _record(type(base), base, content, (), faults)
    if record is None:
        raise ConfigError("; ".join(faults))
    return record


def _record(kind: type[R], base: R | None, content: Mapping[Any, Any], path: tuple[str, ...], faults: list[str]) -> R | None:
    known = list(names(kind))
    for name in content:
        dotted = ".".join((*path, str(name)))
        if name in kind.gone:
            faults.append(f"the key '{dotted}' {kind.gone[name]}")
        elif name not in known:
            close = get_close_matches(str(name), known, 1)
            hint = f"; did you mean '{close[0]}'?" if close else ""
            faults.append(f"unknown key '{dotted}'; allowed are {', '.join(known)}{hint}")
    return _values(kind, base, content, path, faults)


def _values(kind: type[R], base: R | None, content: Mapping[Any, Any], path: tuple[str, ...], faults: list[str]) -> R | None:
    """Return the record of the values, in which no key is unknown; None, if there is a fault by now."""
    defaults = {each.name: each.default is not MISSING or each.default_factory is not MISSING for each in fields(kind)}
    values = {}
    for name, each in keys_of(kind).items():
        before = getattr(base, name, None)
        if isinstance(each.kind, Part) and each.kind.flat:
            values[name] = _values(each.kind.of, before, content, path, faults)
        elif name in content:
            values[name] = _value(each.kind, before, content[name], (*path, name), faults)
        elif base is not None:
            values[name] = before
        elif not defaults[name]:
            faults.append(f"the key '{'.'.join((*path, name))}' is missing")
    return None if faults else kind(**values)


def _value(kind: Kind, before: Any, content: Any, path: tuple[str, ...], faults: list[str]) -> Any:
    part = part_of(kind)
    if part is not None and isinstance(content, Mapping):
        return _record(part, before, content, path, faults)
    if isinstance(kind, Named) and isinstance(content, Mapping):
        faults += [
            f"{'.'.join(path)}: the name {shown(name)} is no text; put it in quotes" for name in content if not isinstance(name, str)
        ]
        return {name: _value(Part(kind.of), None, each, (*path, str(name)), faults) for name, each in content.items()}
    try:
        return kind.checked(kind.meant(content))
    except ValueError as fault:
        faults.append(f"{'.'.join(path)} is {shown(content)}: {fault}")
