"""The configuration of a localizer in the form in which files hold it."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import yaml

from ial.errors import ConfigError
from ial.keys.reading import read
from ial.keys.record import plain
from ial.lidar.configuration.config import LocalizerConfig

_HEADER = "# The configuration of a localizer, with every default filled in. Lengths in metres, angles in radians.\n"


def config_record(config: LocalizerConfig) -> dict[str, Any]:
    """Return the keys and values of a configuration file: those of `LocalizerConfig`, with those of its bounds at the top."""
    return plain(config)


def config_of(record: Mapping[Any, Any]) -> LocalizerConfig:
    """Return the configuration that a file with these keys and values means; keys that are left out have their defaults.

    Raises
    ------
    ConfigError
        If a key is unknown or a value may not be given.
    """
    return read(LocalizerConfig(), record)


def config_yaml(config: LocalizerConfig) -> str:
    """Return a configuration as YAML, ready to be given as a configuration file."""
    return _HEADER + yaml.safe_dump(config_record(config), sort_keys=False)


def read_config(file: Path | str) -> LocalizerConfig:
    """Read a configuration file, such as the ``config.yaml`` of a run; keys that are left out have their defaults.

    Nothing else is read: no variable of the environment changes what a file says.

    Raises
    ------
    ConfigError
        If it cannot be read, a key is unknown or a value may not be given. The text names the file, the key, and what is allowed.
    """
    content = file_content(Path(file))
    try:
        return config_of(content)
    except ConfigError as error:
        raise ConfigError(f"{file}: {error}") from None


def file_content(file: Path) -> dict[Any, Any]:
    """Return the keys and values of a configuration file as they are written there.

    Raises
    ------
    ConfigError
        If it cannot be read, is no YAML file of keys, or holds a key twice.
    """
    try:
        content = yaml_content(file.read_text(encoding="utf-8"))
    except ConfigError as error:
        raise ConfigError(f"{file}: {error}") from None
    except OSError as error:
        raise ConfigError(f"{file}: the configuration cannot be read ({error.strerror or error}); check the path") from None
    except ValueError as error:
        raise ConfigError(f"{file}: not a YAML file ({error}); `ial localize --dump-config` prints one to begin with") from None
    if content is None:
        return {}
    if not isinstance(content, dict):
        raise ConfigError(f"{file}: holds no `key: value` lines; `ial localize --dump-config` prints a file to begin with")
    return content


def yaml_content(text: str) -> Any:
    """Return what a text in YAML says.

    Raises
    ------
    ConfigError
        If it holds a key twice.
    ValueError
        If it is no YAML, or a value in it is none of the type that it looks like: a date of a 13th month.
    """
    try:
        return yaml.load(text, Loader=_Loader)
    except ConfigError:
        raise
    except Exception as error:  # what a constructor of PyYAML raises depends on the text: KeyError, AttributeError, RecursionError, …
        raise ValueError(str(error)) from None


class _Loader(yaml.SafeLoader):
    """Reads YAML and refuses a key that is there twice, of which YAML would silently keep the last."""

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict[Any, Any]:
        keys = [key.value for key, _ in node.value if isinstance(key, yaml.ScalarNode)]
        twice = [key for key in keys if keys.count(key) > 1]
        if twice:
            raise ConfigError(f"line {node.start_mark.line + 1}: the key '{twice[0]}' is there twice; keep one")
        return super().construct_mapping(node, deep)
