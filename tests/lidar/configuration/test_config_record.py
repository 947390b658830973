import yaml

from ial.lidar.configuration.config import Bounds, LocalizerConfig
from ial.lidar.configuration.config_record import config_record, config_yaml


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
