import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ial.cli.lidar.config_file import resolve
from ial.datasets.motion import ErrorBound, MotionBounds
from ial.errors import ConfigError
from ial.keys.entry import entries
from ial.lidar.configuration.config import Bounds, LocalizerConfig, Precision
from ial.lidar.configuration.config_record import config_yaml

BOUND = st.floats(0.0, 10.0)
ERROR = st.builds(ErrorBound, BOUND, BOUND, BOUND)
CONFIG = st.builds(
    LocalizerConfig,
    bounds=st.builds(Bounds, BOUND, BOUND, BOUND, st.builds(MotionBounds, ERROR, ERROR, st.none() | ERROR)),
    outliers=st.just("auto") | st.integers(0, 100) | st.floats(0.0, 1.0),
    outlier_margin=st.integers(0, 100) | st.floats(0.0, 1.0),
    max_outliers=st.integers(0, 100) | st.floats(0.0, 1.0),
    max_jump=st.integers(0, 100) | st.floats(0.0, 1.0),
    precision=st.builds(Precision, st.floats(1e-3, 1.0), st.floats(1e-3, 1.0)),
    max_boxes=st.integers(1, 2**40),
    max_beams=st.integers(1, 1000),
    deskew=st.booleans(),
    robot_radius_m=st.floats(0.0, 5.0),
    check_every=st.integers(0, 1000),
    domain=st.sampled_from(["free", "free_or_unknown"]),
    recovery=st.sampled_from(["union", "restart"]),
    max_seconds=st.none() | st.floats(1e-3, 1e3),
)


def test_without_any_source_the_defaults_hold() -> None:
    assert resolve(environment={}) == LocalizerConfig()


@pytest.mark.slow
@given(config=CONFIG)
def test_what_is_written_reads_back_to_the_last_bit(tmp_path_factory: pytest.TempPathFactory, config: LocalizerConfig) -> None:
    file = tmp_path_factory.mktemp("config") / "config.yaml"
    file.write_text(config_yaml(config))
    read = resolve(file, environment={})
    assert read == config
    assert type(read.outliers) is type(config.outliers)


def test_the_command_line_wins_over_the_environment_that_over_the_file(tmp_path: Path) -> None:
    file = tmp_path / "config.yaml"
    file.write_text("outliers: 1\nmax_beams: 11\nmap_error_m: 0.11\nmotion: {translation: {per_scan: 0.5}}\n")
    environment = {"IAL_OUTLIERS": "2", "IAL_MAX_BEAMS": "22", "IAL_MOTION_TRANSLATION_PER_METRE": "0.25", "IAL_THREADS": "1"}
    config = resolve(file, ["max_beams=33"], environment, outliers="3", domain=None)
    assert (config.outliers, config.max_beams, config.bounds.map_error_m) == (3, 33, 0.11)
    defaults = LocalizerConfig().bounds.motion
    assert config.bounds.motion == MotionBounds(replace(defaults.translation, per_scan=0.5, per_metre=0.25), defaults.rotation)
    assert resolve(file, [], environment).outliers == 2


def test_every_key_has_a_variable_of_its_own_and_what_all_say_is_what_was_written() -> None:
    kept = [entry for entry in entries(LocalizerConfig) if entry.one and entry.path[:2] != ("motion", "sideways")]
    names = ["IAL_" + "_".join(entry.path).upper() for entry in kept]
    assert len(names) == len(set(names))
    said = {name: "null" if entry.default is None else str(entry.default) for name, entry in zip(names, kept, strict=True)}
    assert resolve(environment=said) == LocalizerConfig()
    sideways = resolve(environment={"IAL_MOTION_SIDEWAYS": "{per_scan: 1}", "IAL_MOTION_SIDEWAYS_PER_METRE": "2"}).bounds.motion.sideways
    assert sideways == ErrorBound(per_metre=2.0, per_scan=1.0)


def test_lidars_may_have_errors_of_their_own(tmp_path: Path) -> None:
    file = tmp_path / "config.yaml"
    file.write_text("lidars: {rear: {range_error_m: 1e-1, bearing_error_rad: 0.02}}\n")
    config = resolve(file, environment={})
    assert config.bounds.of("rear") == replace(config.bounds, range_error_m=0.1, bearing_error_rad=0.02)
    assert config.bounds.of("front") == config.bounds
    again = tmp_path / "again.yaml"
    again.write_text(config_yaml(config))
    assert resolve(again, environment={}) == config


@pytest.mark.parametrize(("text", "value"), [("7", 7), ("0.25", 0.25), ("1", 1), ("1.0", 1.0), ("0", 0), ("1e-1", 0.1)])
def test_a_number_of_outliers_and_a_fraction_stay_apart(text: str, value: float) -> None:
    for config in (resolve(environment={}, outliers=text), resolve(settings=[f"outliers={text}"], environment={})):
        assert config.outliers == value
        assert type(config.outliers) is type(value)


def test_yaml_writes_of_numbers_that_yaml_takes_for_text(tmp_path: Path) -> None:
    file = tmp_path / "config.yaml"
    file.write_text("range_error_m: 1e-3\nlocalized_size: {heading_rad: 1}\n")
    config = resolve(file, environment={})
    assert (config.bounds.range_error_m, config.localized_size.heading_rad) == (1e-3, 1.0)
    assert math.isclose(config.localized_size.position_m, LocalizerConfig().localized_size.position_m)


def test_an_empty_file_changes_nothing(tmp_path: Path) -> None:
    (tmp_path / "config.yaml").write_text("# nothing\n")
    assert resolve(tmp_path / "config.yaml", environment={}) == LocalizerConfig()


@pytest.mark.parametrize(
    ("settings", "environment", "message"),
    [
        (["max_beam=3"], {}, "--set max_beam=3: unknown key 'max_beam'.*did you mean 'max_beams'"),
        (["motion.translation=3"], {}, "--set motion.translation=3: motion.translation is 3: "),
        (["lidars.rear.range_error=1"], {}, "unknown key 'lidars.rear.range_error'; allowed are range_error_m, "),
        (["lidars.rear.range_error_m=1"], {}, "the key 'lidars.rear.bearing_error_rad' is missing"),
        (["max_beams"], {}, "--set max_beams: give KEY=VALUE"),
        (["=3"], {}, "--set =3: give KEY=VALUE"),
        (["max_beams=["], {}, r"--set max_beams=\[: '\[' is no value"),
        ([], {"IAL_MAX_BEAMS": "-3"}, "IAL_MAX_BEAMS: max_beams is -3: "),
        ([], {"IAL_MAXBEAMS": "3"}, "IAL_MAXBEAMS is no setting of ial; .*did you mean IAL_MAX_BEAMS"),
        (["motion.rotation.base=1"], {}, "the key .motion.rotation.base. has become two: per_scan, .*per_message"),
        ([], {"IAL_MOTION_TRANSLATION_BASE": "1"}, "variable IAL_MOTION_TRANSLATION_BASE has become two: per_scan, .*per_message"),
        ([], {"IAL_XYZZY": "3"}, "IAL_XYZZY is no setting of ial; unset it"),
    ],
)
def test_a_wrong_setting_is_named_with_its_source(settings: list[str], environment: dict[str, str], message: str) -> None:
    with pytest.raises(ConfigError, match=message):
        resolve(None, settings, environment)


@pytest.mark.parametrize(
    "value",
    ["2024-13-45", "!!float x", "!!int x", "!!bool x", "!!timestamp x", "9" * 5000, "0x" + "f" * 5000, "[" * 2000, "{a: 1"],
    ids=lambda value: value[:12],
)
def test_a_value_that_only_looks_like_one_is_an_error_in_every_source(value: str, tmp_path: Path) -> None:
    (tmp_path / "c.yaml").write_text(f"max_boxes: {value}\n")
    sources: list[dict[str, Any]] = [
        {"settings": [f"max_boxes={value}"]},
        {"environment": {"IAL_MAX_BOXES": value}},
        {"file": tmp_path / "c.yaml"},
    ]
    for source in sources:
        with pytest.raises(ConfigError, match=r"max_boxes|MAX_BOXES|not a YAML file"):
            resolve(**{"environment": {}, **source})


def test_a_key_that_is_there_twice_in_one_setting_is_refused() -> None:
    with pytest.raises(ConfigError, match=r"--set .*'position_m' is there twice"):
        resolve(settings=["precision={position_m: 1, position_m: 2}"], environment={})
