import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import yaml

from ial.errors import ConfigError
from ial.lidar.configuration.config import Bounds, FreeSpace, LocalizedSize, LocalizerConfig, Precision
from ial.lidar.configuration.config_record import config_yaml

BAD = [-1e-9, -1.0, math.nan, math.inf, -math.inf]


@pytest.mark.parametrize("name", ["range_error_m", "bearing_error_rad", "map_error_m"])
@pytest.mark.parametrize("value", BAD)
def test_a_bound_that_is_negative_or_not_finite_is_refused_by_name(name: str, value: float) -> None:
    with pytest.raises(ConfigError, match=name):
        Bounds(**{name: value})


@pytest.mark.parametrize("name", ["position_m", "heading_rad"])
@pytest.mark.parametrize("value", [*BAD, 0.0])
@pytest.mark.parametrize("record", [Precision, LocalizedSize])
def test_a_size_that_is_not_positive_is_refused_by_name(record: Any, name: str, value: float) -> None:
    with pytest.raises(ConfigError, match=name):
        record(**{name: value})


@pytest.mark.parametrize("outliers", [-1, -0.1, 1.1, math.nan, math.inf, True, False, "3", None])
def test_outliers_that_are_neither_a_number_of_beams_nor_a_fraction_are_refused(outliers: Any) -> None:
    with pytest.raises(ConfigError, match="outliers"):
        LocalizerConfig(outliers=outliers)


@pytest.mark.parametrize("outliers", [0, 1, 10_000, 0.0, 0.5, 1.0])
def test_outliers_may_be_a_number_or_a_fraction(outliers: int | float) -> None:
    assert LocalizerConfig(outliers=outliers).outliers == outliers


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("max_boxes", 0),
        ("max_boxes", -5),
        ("max_beams", 0),
        ("domain", "occupied"),
        ("recovery", "absorb"),
        ("max_seconds", 0.0),
        ("max_seconds", -1.0),
        ("max_seconds", math.nan),
        ("max_seconds", math.inf),
    ],
)
def test_what_makes_no_sense_is_refused_by_name(name: str, value: Any) -> None:
    with pytest.raises(ConfigError, match=name):
        LocalizerConfig(**{name: value})


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: Bounds(range_error_m=True), r"Bounds\.range_error_m is True: give a number, not a truth value"),
        (lambda: Bounds(map_error_m="0.1"), r"Bounds\.map_error_m is '0\.1': give a finite number"),
        (lambda: LocalizerConfig(max_beams=True), r"LocalizerConfig\.max_beams is True: give a whole number"),
        (lambda: LocalizerConfig(deskew="false"), r"LocalizerConfig\.deskew is 'false': give true or false"),
        (lambda: LocalizerConfig(bounds=Precision()), r"LocalizerConfig\.bounds is Precision.*: give its keys .*in Python, Bounds"),
        (lambda: FreeSpace(use=0), r"FreeSpace\.use is 0: give true or false"),
    ],
)
def test_what_a_file_may_not_say_python_may_not_say_either(make: Callable[[], Any], said: str) -> None:
    with pytest.raises(ConfigError, match=said):
        make()


def test_numbers_of_numpy_are_kept_as_those_of_python_and_can_be_written() -> None:
    config = LocalizerConfig(Bounds(np.float32(0.1)), max_beams=np.int64(90), deskew=np.bool_(True), robot_radius_m=np.float64(0.2))
    assert config == LocalizerConfig(Bounds(float(np.float32(0.1))), max_beams=90, deskew=True, robot_radius_m=0.2)
    assert yaml.safe_load(config_yaml(config))["range_error_m"] == float(np.float32(0.1))


def test_zero_bounds_and_the_defaults_are_accepted() -> None:
    assert Bounds(0.0, 0.0, 0.0).map_error_m == 0.0
    config = LocalizerConfig()
    assert (config.domain, config.recovery, config.max_seconds) == ("free", "union", None)
    assert LocalizedSize() == LocalizedSize(0.5, math.radians(15.0))
