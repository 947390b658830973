"""Names of a package that are loaded when they are first used, so that importing the package costs almost nothing (PEP 562)."""

import sys
from collections.abc import Callable, Mapping, Sequence
from importlib import import_module
from typing import Any


def lazy(package: str, homes: Mapping[str, Sequence[str]]) -> tuple[Callable[[str], Any], Callable[[], list[str]], list[str]]:
    """Return ``__getattr__``, ``__dir__`` and ``__all__`` of a package.

    Type checkers do not see such names; the package imports them once more under ``if TYPE_CHECKING``.

    Parameters
    ----------
    package
        The package, its ``__name__``.
    homes
        For each module of the package the names that it gives; no names stand for the module itself.
    """
    home_of = {name: home for home, names in homes.items() for name in names or (home,)}
    exported = sorted(home_of)

    def get(name: str) -> Any:
        if name not in home_of:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        try:
            module = import_module(f"{package}.{home_of[name]}")
        except AttributeError as error:  # Python would take it for "no such name" and hide what is wrong
            raise ImportError(f"{package}.{name} cannot be imported: {error}", name=f"{package}.{home_of[name]}") from error
        value = getattr(module, name) if homes[home_of[name]] else module
        setattr(sys.modules[package], name, value)
        return value

    return get, lambda: exported, exported
