"""The configuration of a localizer, from its four sources: the command line, the environment, a YAML file, and the defaults."""

import difflib
import os
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import yaml

from ial.errors import ConfigError
from ial.lidar.configuration.config import LocalizerConfig
from ial.lidar.configuration.config_record import config_of, config_record

_PREFIX = "IAL_"
_LIDAR = {"range_error_m": 0.0, "bearing_error_rad": 0.0}
_BASE_IS_GONE = (
    "has become two: per_scan, added once from each scan to the next, and per_message, added for each odometry message between them; "
    "give the old value as per_scan if it was measured from scan to scan, and as per_message if it is of one message"
)
_OTHER_VARIABLES = ("IAL_THREADS", "IAL_CACHE_DIR", "IAL_DATA", "IAL_ITF1788")


def resolve(
    file: Path | None = None, settings: Sequence[str] = (), environment: Mapping[str, str] = os.environ, **named: Any
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
    named
        Values of options of their own; None where one was not given.

    Raises
    ------
    ConfigError
        If a key is unknown or a value cannot be used. The text names the source, the key, and what is allowed.
    """
    record = config_record(LocalizerConfig())
    config = LocalizerConfig()
    for source, layer in _layers(record, file, settings, environment, named):
        record = _merged(record, layer)
        config = _validated(record, source)
    return config


def _layers(
    defaults: Mapping[str, Any], file: Path | None, settings: Sequence[str], environment: Mapping[str, str], named: Mapping[str, Any]
) -> Iterator[tuple[str, dict[str, Any]]]:
    """Yield the sources from the weakest to the strongest, each with what it says."""
    if file is not None:
        yield str(file), _read(file)
    names = {_PREFIX + "_".join(path).upper(): path for path in _paths(defaults)}
    for variable in sorted(environment):
        if variable in names:
            yield variable, _nested(names[variable], _parsed(environment[variable], variable))
        elif variable.startswith(_PREFIX) and variable not in _OTHER_VARIABLES:
            if variable.startswith(f"{_PREFIX}MOTION_") and variable.endswith("_BASE"):
                raise ConfigError(f"the environment variable {variable} {_BASE_IS_GONE}")
            close = difflib.get_close_matches(variable, [*names, *_OTHER_VARIABLES], 1)
            hint = f"did you mean {close[0]}?" if close else f"variables that are known begin with {', '.join(sorted(names)[:3])}, …"
            raise ConfigError(f"the environment variable {variable} is no setting of ial; unset it, or correct it: {hint}")
    for setting in settings:
        key, equals, value = setting.partition("=")
        if not equals or not key.strip():
            raise ConfigError(f"--set {setting}: give KEY=VALUE, such as --set motion.translation.per_scan=0.2")
        yield f"--set {setting}", _nested(key.strip().split("."), _parsed(value, f"--set {setting}"))
    for key, value in named.items():
        if value is not None:
            yield f"--{key}", {key: value}


def _paths(record: Mapping[str, Any], above: tuple[str, ...] = ()) -> Iterator[tuple[str, ...]]:
    for key, value in record.items():
        if isinstance(value, dict):
            yield from _paths(value, (*above, key))
        else:
            yield (*above, key)


def _nested(path: Sequence[str], value: Any) -> dict[str, Any]:
    for key in reversed(path):
        value = {key: value}
    return dict(value)


def _parsed(text: str, source: str) -> Any:
    try:
        return yaml.safe_load(text)
    except yaml.YAMLError:
        raise ConfigError(f"{source}: {text!r} is no value; give a number or a word") from None


class _Loader(yaml.SafeLoader):
    """Reads YAML and refuses a key that is there twice, of which YAML would silently keep the last."""

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict[Any, Any]:
        keys = [key.value for key, _ in node.value if isinstance(key, yaml.ScalarNode)]
        twice = [key for key in keys if keys.count(key) > 1]
        if twice:
            raise ConfigError(f"line {node.start_mark.line + 1}: the key '{twice[0]}' is there twice; keep one")
        return super().construct_mapping(node, deep)


def _read(file: Path) -> dict[str, Any]:
    try:
        content = yaml.load(file.read_text(encoding="utf-8"), Loader=_Loader)
    except ConfigError as error:
        raise ConfigError(f"{file}: {error}") from None
    except OSError as error:
        raise ConfigError(f"{file}: the configuration cannot be read ({error.strerror or error}); check the path") from None
    except (yaml.YAMLError, UnicodeDecodeError, RecursionError, ValueError) as error:
        raise ConfigError(f"{file}: not a YAML file ({error}); `ial localize --dump-config` prints one to begin with") from None
    if content is None:
        return {}
    if not isinstance(content, dict):
        raise ConfigError(f"{file}: holds no `key: value` lines; `ial localize --dump-config` prints a file to begin with")
    return content


def _merged(below: Mapping[str, Any], above: Mapping[str, Any]) -> dict[str, Any]:
    merged = dict(below)
    for key, value in above.items():
        both = isinstance(value, dict) and isinstance(below.get(key), dict)
        merged[key] = _merged(below[key], value) if both else value
    return merged


def _validated(record: dict[str, Any], source: str) -> LocalizerConfig:
    if _as_written(record, config_record(LocalizerConfig())):
        try:
            return config_of(record)
        except (ConfigError, TypeError):
            pass  # said better below
    # Only where a value needs to be converted, or an error explained: importing pydantic costs 10 MB, which a robot may not have.
    from pydantic import ValidationError

    from ial.cli.lidar.config_keys import ConfigKeys

    try:
        return ConfigKeys.model_validate(record).config()
    except ValidationError as error:
        raise ConfigError("; ".join(f"{source}: {_fault(dict(fault), record)}" for fault in error.errors())) from None
    except ConfigError as error:
        raise ConfigError(f"{source}: {error}") from None


def _as_written(value: Any, default: Any) -> bool:
    """Return whether a value has the very form in which ial writes it: the same keys, and types that need no conversion."""
    if default == {}:  # the lidars, by name
        return isinstance(value, dict) and all(isinstance(name, str) and _as_written(each, _LIDAR) for name, each in value.items())
    if isinstance(default, dict):
        return (
            isinstance(value, dict) and list(value) == list(default) and all(_as_written(value[key], each) for key, each in default.items())
        )
    # Where the default is a word or nothing, a number may stand as well.
    return type(value) is type(default) or (isinstance(default, str | None) and type(value) in (int, float))


def _fault(fault: Mapping[str, Any], record: Mapping[str, Any]) -> str:
    """Return what is wrong with a value, and what is allowed."""
    path = [str(part) for part in fault["loc"]]
    key = ".".join(path)
    if path[0] == "motion" and path[-1] == "base":
        return f"the key '{key}' {_BASE_IS_GONE}"
    if fault["type"] == "extra_forbidden":
        level: Any = config_record(LocalizerConfig())
        for part in path[:-1]:
            # What is empty by default has the keys of its sibling, or those of a lidar.
            level = level.get(part) or level.get("translation") or _LIDAR
        close = difflib.get_close_matches(path[-1], level, 1)
        hint = f"; did you mean '{close[0]}'?" if close else ""
        return f"unknown key '{key}'; allowed are {', '.join(level)}{hint}"
    if fault["type"] == "missing":
        return f"the key '{key}' is missing"
    said = str(fault["msg"]).removeprefix("Value error, ")
    return f"{key} is {fault['input']!r}: {said[0].lower()}{said[1:]}"
