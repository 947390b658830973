"""Parts of numbers of beams, as their decimals say and not as doubles round."""

import math
from decimal import Decimal
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
import yaml

from ial.cli.lidar.config_file import resolve
from ial.datasets.scan import LaserScan
from ial.errors import ConfigError
from ial.lidar.configuration.config import LocalizerConfig
from ial.lidar.configuration.config_record import config_of, config_record, config_yaml
from ial.lidar.configuration.share import number_of
from ial.lidar.evidence.beams import scan_beams, select_beams

KEYS = ("outliers", "outlier_margin", "max_outliers", "max_jump")


def scan(beams: int) -> LaserScan:
    return LaserScan(0, np.ones(beams, np.float32), -1.0, 0.01)


def test_every_share_of_two_digits_of_up_to_360_beams_is_the_whole_part_of_the_decimal_product() -> None:
    wrong = [
        (percent, beams)
        for percent in range(1, 100)
        for beams in range(1, 361)
        if number_of(percent / 100, beams) != percent * beams // 100
    ]
    assert wrong == []
    assert math.floor(0.35 * 180) == 62  # in doubles 22 of these are one too small


@pytest.mark.parametrize("share", [0.35, np.float64(0.35), np.float32(0.35), np.float16(0.35), Decimal("0.35"), Fraction(7, 20)])
def test_a_part_in_any_type_means_what_it_is_written_as(share: Any) -> None:
    config = LocalizerConfig(outliers=share)
    assert number_of(share, 180) == scan_beams(scan(180), config).outliers == 63
    assert select_beams(scan(180), config.bounds, share, 180).outliers == 63


@pytest.mark.parametrize("number", [7, np.int64(7), np.uint8(7)])
def test_a_whole_number_in_any_type_is_that_many(number: Any) -> None:
    config = LocalizerConfig(outliers=number)
    assert type(config.outliers) is int
    assert number_of(number, 3) == scan_beams(scan(9), config).outliers == 7


def test_all_four_shares_of_an_automatic_number_are_exact() -> None:
    config = LocalizerConfig(outlier_margin=0.29, max_outliers=0.57, max_jump=0.58, max_beams=200)
    beams = scan_beams(scan(100), config)
    assert (beams.margin, beams.outliers, beams.jump) == (29, 57, 58)


def test_a_third_is_a_third_and_is_written_so_that_it_can_be_read_again() -> None:
    config = LocalizerConfig(outliers=Fraction(1, 3), max_jump=Fraction(1))
    assert scan_beams(scan(9), config).outliers == 3
    assert config_of(config_record(config)) == config
    settings = [f"{key}={config_record(config)[key]}" for key in KEYS]
    assert resolve(settings=settings, environment={}) == config
    assert yaml.safe_load(config_yaml(config))["max_jump"] == "1/1"  # and not 1, which is one beam


@pytest.mark.parametrize("key", KEYS)
@pytest.mark.parametrize("share", [-0.1, 1.1, math.nan, np.float32(np.nan), np.bool_(True), Fraction(4, 3), Decimal("-0.1"), "0.3", 0.5j])
def test_what_is_no_share_is_refused_by_name(key: str, share: Any) -> None:
    with pytest.raises(ConfigError, match=key):
        LocalizerConfig(**{key: share})


@pytest.mark.parametrize("text", ["1/0", "/", "1/3/3", "4/3", "-1/3", "a/b"])
def test_a_text_that_is_no_fraction_is_refused(text: str) -> None:
    with pytest.raises(ConfigError, match=r"outliers=.* (no fraction|whole number of beams)"):
        resolve(settings=[f"outliers={text}"], environment={})


@pytest.mark.parametrize("share", [-1, -0.1, math.nan, "0.3"])
def test_no_number_is_made_of_what_is_no_share(share: Any) -> None:
    with pytest.raises(ConfigError, match="no share of the beams"):
        number_of(share, 10)


@pytest.mark.parametrize(
    "wrong", [Decimal("nan"), Decimal("sNaN"), Decimal("inf"), math.nan, 10**5000], ids=["nan", "sNaN", "inf", "float", "long"]
)
def test_what_is_no_number_or_no_file_can_hold_is_no_share(wrong: Any) -> None:
    for key in KEYS:
        with pytest.raises(ConfigError, match=f"LocalizerConfig.{key} is "):
            LocalizerConfig(**{key: wrong})


def test_the_word_auto_is_a_text_of_python_whoever_gives_it() -> None:
    assert "outliers: auto" in config_yaml(LocalizerConfig(outliers=np.str_("auto")))  # type: ignore[arg-type]
