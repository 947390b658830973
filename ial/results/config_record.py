"""The configuration of a localizer in the form in which files hold it."""

import dataclasses
from typing import Any

import yaml

from ial.lidar.config import LocalizerConfig

_HEADER = "# The configuration of a localizer, with every default filled in. Lengths in metres, angles in radians.\n"


def config_record(config: LocalizerConfig) -> dict[str, Any]:
    """Return the keys and values of a configuration file: those of `LocalizerConfig`, with those of its bounds at the top."""
    record = dataclasses.asdict(config)
    return {**record.pop("bounds"), **record}


def config_yaml(config: LocalizerConfig) -> str:
    """Return a configuration as YAML, ready to be given as a configuration file."""
    return _HEADER + yaml.safe_dump(config_record(config), sort_keys=False)
