"""The configuration of a localizer in the form in which files hold it."""

import dataclasses
from collections.abc import Mapping
from fractions import Fraction
from typing import Any

import yaml

from ial.datasets.motion import ErrorBound, MotionBounds
from ial.errors import ConfigError
from ial.lidar.configuration.config import Bounds, FreeSpace, LidarBounds, LocalizedSize, LocalizerConfig, Precision

_HEADER = "# The configuration of a localizer, with every default filled in. Lengths in metres, angles in radians.\n"


def config_record(config: LocalizerConfig) -> dict[str, Any]:
    """Return the keys and values of a configuration file: those of `LocalizerConfig`, with those of its bounds at the top."""
    record = dataclasses.asdict(config)
    bounds: dict[str, Any] = record.pop("bounds")
    return {**bounds, **{key: _written(value) for key, value in record.items()}}


def config_of(record: Mapping[str, Any]) -> LocalizerConfig:
    """Return the configuration that `config_record` has written; every key must be there.

    Raises
    ------
    ConfigError
        If a value cannot be used.
    """
    rest = dict(record)
    motion = rest.pop("motion")
    errors = {name: rest.pop(name) for name in ("range_error_m", "bearing_error_rad", "map_error_m")}
    sideways = None if motion["sideways"] is None else ErrorBound(**motion["sideways"])
    wheels = MotionBounds(ErrorBound(**motion["translation"]), ErrorBound(**motion["rotation"]), sideways)
    lidars = {str(frame): LidarBounds(**own) for frame, own in rest.pop("lidars").items()}
    bounds = Bounds(**errors, motion=wheels, lidars=lidars)
    parts = {"free_space": FreeSpace, "precision": Precision, "localized_size": LocalizedSize}
    made = {name: kind(**rest.pop(name)) for name, kind in parts.items()}
    return LocalizerConfig(bounds=bounds, **made, **{key: _read(value) for key, value in rest.items()})


def _written(value: Any) -> Any:
    """Return a fraction as a text, "1/1" too: 1 would be one beam."""
    return f"{value.numerator}/{value.denominator}" if isinstance(value, Fraction) else value


def _read(value: Any) -> Any:
    """Return a text of that form as a fraction."""
    if not isinstance(value, str) or "/" not in value:
        return value
    try:
        return Fraction(value)
    except (ValueError, ZeroDivisionError):
        raise ConfigError(f"{value!r} is no fraction; give one such as 1/3") from None


def config_yaml(config: LocalizerConfig) -> str:
    """Return a configuration as YAML, ready to be given as a configuration file."""
    return _HEADER + yaml.safe_dump(config_record(config), sort_keys=False)
