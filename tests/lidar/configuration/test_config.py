import math
from typing import Any

import pytest

from ial.errors import ConfigError
from ial.lidar.configuration.config import Bounds, LocalizedSize, LocalizerConfig, Precision

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


def test_zero_bounds_and_the_defaults_are_accepted() -> None:
    assert Bounds(0.0, 0.0, 0.0).map_error_m == 0.0
    config = LocalizerConfig()
    assert (config.domain, config.recovery, config.max_seconds) == ("free", "union", None)
    assert LocalizedSize() == LocalizedSize(0.5, math.radians(15.0))
