from fractions import Fraction
from pathlib import Path

import pytest
import yaml

from ial.errors import ConfigError
from ial.lidar.configuration.config import Bounds, LidarBounds, LocalizerConfig, Precision
from ial.lidar.configuration.config_record import config_record, config_yaml, read_config


def test_the_keys_are_those_of_a_configuration_file() -> None:
    record = config_record(LocalizerConfig())
    assert {"range_error_m", "bearing_error_rad", "map_error_m", "outliers", "max_boxes", "max_beams", "domain"} <= set(record)
    assert set(record["motion"]) == {"translation", "rotation", "sideways"}
    assert list(record["motion"]["rotation"]) == ["per_message", "per_metre", "per_radian", "per_second", "per_scan"]
    assert set(record["localized_size"]) == {"position_m", "heading_rad"}
    assert set(record["precision"]) == {"position_m", "heading_rad", "halvings"}


def test_yaml_says_the_same_to_the_last_bit() -> None:
    config = LocalizerConfig(bounds=Bounds(range_error_m=0.1 + 0.2, bearing_error_rad=1e-7), outliers=7, max_seconds=None)
    assert yaml.safe_load(config_yaml(config)) == config_record(config)
    assert isinstance(yaml.safe_load(config_yaml(config))["outliers"], int)


def test_python_reads_the_file_that_ial_writes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    config = LocalizerConfig(Bounds(0.1 + 0.2, lidars={"rear": LidarBounds(0.1, 0.02)}), outliers=Fraction(1, 3), max_seconds=0.5)
    (tmp_path / "config.yaml").write_text(config_yaml(config))
    monkeypatch.setenv("IAL_MAX_BEAMS", "3")
    assert read_config(tmp_path / "config.yaml") == read_config(str(tmp_path / "config.yaml")) == config


def test_a_file_may_leave_keys_out(tmp_path: Path) -> None:
    (tmp_path / "some.yaml").write_text("map_error_m: 1e-1\nprecision: {halvings: 0}\n")
    assert read_config(tmp_path / "some.yaml") == LocalizerConfig(Bounds(map_error_m=0.1), precision=Precision(halvings=0))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("max_beam: 3", "unknown key 'max_beam'; .*did you mean 'max_beams'"),
        ("precision: {position_m: 0}", r"precision\.position_m is 0: give a finite number greater than or equal to 0\.001: finer cells"),
        ("- 3", "holds no `key: value` lines"),
        ("max_beams: 3\nmax_beams: 4", "'max_beams' is there twice"),
    ],
)
def test_a_wrong_file_is_named_with_its_fault(tmp_path: Path, text: str, said: str) -> None:
    (tmp_path / "wrong.yaml").write_text(text)
    with pytest.raises(ConfigError, match=f"wrong.yaml: .*{said}"):
        read_config(tmp_path / "wrong.yaml")
    with pytest.raises(ConfigError, match=r"nowhere\.yaml: .*check the path"):
        read_config(tmp_path / "nowhere.yaml")
