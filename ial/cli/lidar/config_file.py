"""The configuration of a localizer, from its four sources: the command line, the environment, a YAML file, and the defaults."""

import difflib
import os
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from ial.errors import ConfigError
from ial.keys.entry import entries, gone
from ial.keys.kind import shown
from ial.lidar.configuration.config import LocalizerConfig
from ial.lidar.configuration.config_record import config_of, file_content, yaml_content

_PREFIX = "IAL_"
_OTHER_VARIABLES = ("IAL_THREADS", "IAL_CACHE_DIR", "IAL_DATA", "IAL_ITF1788")


def resolve(
    file: Path | None = None,
    settings: Sequence[str] = (),
    environment: Mapping[str, str] = os.environ,
    beneath: Mapping[str, Any] | None = None,
    **named: Any,
) -> LocalizerConfig:
    """Return the configuration; the command line wins over the environment, that over the file, and that over the defaults.

    Parameters
    ----------
    file
        A YAML file with any of the keys.
    settings
        ``KEY=VALUE`` texts from the command line, with dots in the key: ``motion.translation.per_scan=0.2``.
    environment
        The variables; a key is called ``IAL_`` and its capitals there, with ``_`` for dots: ``IAL_MOTION_TRANSLATION_PER_SCAN``.
    beneath
        What a command takes in place of some defaults, for what nobody has said.
    named
        Values of options of their own; None where one was not given.

    Raises
    ------
    ConfigError
        If a key is unknown or a value cannot be used. The text names the source, the key, and what is allowed.
    """
    said: dict[str, Any] = dict(beneath or {})
    config = config_of(said)
    for source, layer in _layers(file, settings, environment, named):
        said = _merged(said, layer)
        try:
            config = config_of(said)
        except ConfigError as error:
            raise ConfigError(f"{source}: {error}") from None
    return config


def _layers(
    file: Path | None, settings: Sequence[str], environment: Mapping[str, str], named: Mapping[str, Any]
) -> Iterator[tuple[str, dict[str, Any]]]:
    """Yield the sources from the weakest to the strongest, each with what it says."""
    if file is not None:
        yield str(file), file_content(file)
    yield from _variables({name: value for name, value in environment.items() if name.startswith(_PREFIX)})
    for setting in settings:
        key, equals, value = setting.partition("=")
        if not equals or not key.strip():
            raise ConfigError(f"--set {setting}: give KEY=VALUE, such as --set motion.translation.per_scan=0.2")
        yield f"--set {setting}", _nested(key.strip().split("."), _parsed(value, f"--set {setting}"))
    for key, value in named.items():
        if value is not None:
            yield f"--{key}", {key: value}


def _variables(environment: Mapping[str, str]) -> Iterator[tuple[str, dict[str, Any]]]:
    """Yield the variables, each with what it says."""
    known = {_variable(entry.path): entry.path for entry in entries(LocalizerConfig) if entry.one}
    for name in sorted(environment.keys() - _OTHER_VARIABLES):
        if name in known:
            yield name, _nested(known[name], _parsed(environment[name], name))
            continue
        for path, text in gone(LocalizerConfig):
            if name == _variable(path):
                raise ConfigError(f"the environment variable {name} {text}")
        close = difflib.get_close_matches(name, [*known, *_OTHER_VARIABLES], 1)
        hint = f"did you mean {close[0]}?" if close else f"variables that are known begin with {', '.join(sorted(known)[:3])}, …"
        raise ConfigError(f"the environment variable {name} is no setting of ial; unset it, or correct it: {hint}")


def _variable(path: Sequence[str]) -> str:
    return _PREFIX + "_".join(path).upper()


def _nested(path: Sequence[str], value: Any) -> dict[str, Any]:
    for key in reversed(path):
        value = {key: value}
    return dict(value)


def _parsed(text: str, source: str) -> Any:
    try:
        return yaml_content(text)
    except ConfigError as error:
        raise ConfigError(f"{source}: {error}") from None
    except ValueError:
        raise ConfigError(f"{source}: {shown(text)} is no value; give a number or a word") from None


def _merged(below: Mapping[str, Any], above: Mapping[str, Any]) -> dict[str, Any]:
    merged = dict(below)
    for key, value in above.items():
        both = isinstance(value, dict) and isinstance(below.get(key), dict)
        merged[key] = _merged(below[key], value) if both else value
    return merged
