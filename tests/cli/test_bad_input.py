"""Every bad input of the main job: exit status 2, one line that says what was found, where, and what to do; and nothing is left behind."""

import math
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

Refused = Callable[..., str]


@pytest.fixture
def localize(refused: Refused, room: Path) -> Refused:
    """Return a function that localizes a recording in a good map, and must be refused."""
    return lambda recording, *options: refused("localize", recording, "--map", room, "--out", "run", *options)


def test_missing_recording(localize: Refused) -> None:
    assert re.search(r"missing\.bag: .*no such file.*check the path", localize("missing.bag"))


def test_empty_recording(localize: Refused, tmp_path: Path) -> None:
    (tmp_path / "empty.bag").touch()
    assert "empty.bag: the file is empty; copy the recording again" in localize("empty.bag")


def test_a_file_of_another_kind(localize: Refused, tmp_path: Path) -> None:
    (tmp_path / "notes.txt").write_text("nothing to see here\n")
    assert re.search(r"notes\.txt: not a recording of a known kind; give a ROS 1 \.bag", localize("notes.txt"))


@pytest.mark.parametrize("suffix", ["mcap", "bag"])
@pytest.mark.parametrize("share", [0.2, 0.9])
def test_truncated_bag(localize: Refused, ial: Callable[..., Any], sample: Path, tmp_path: Path, suffix: str, share: float) -> None:
    whole = tmp_path / f"whole.{suffix}"
    ial("convert", sample, whole)
    content = whole.read_bytes()
    (tmp_path / f"cut.{suffix}").write_bytes(content[: int(share * len(content))])
    assert f"cut.{suffix}" in localize(f"cut.{suffix}")


def test_no_scan_topic(localize: Refused, bag: Any) -> None:
    assert re.search(r"no topic with laser scans.*its topics are: .*/odom", localize(bag.write(topics=())))


def test_two_scan_topics(localize: Refused, bag: Any) -> None:
    text = localize(bag.write(topics=("/front", "/rear")))
    assert re.search(
        r"several topics .*/front, /rear; choose one with --scan-topic /front; several lidars are used together if each is named", text
    )


def test_a_scan_topic_that_is_not_there(localize: Refused, bag: Any) -> None:
    assert "topic /nonsense is not in the recording" in localize(bag.write(), "--scan-topic", "/nonsense")


def test_scan_without_odometry(localize: Refused, bag: Any) -> None:
    assert re.search(r"no odometry.*record /odom or /tf too", localize(bag.write(odometry=False)))


@pytest.mark.parametrize("ranges", [[math.nan] * 3, [math.inf] * 3, [-math.inf] * 3, [0.01] * 3, [50.0] * 3])
def test_a_recording_whose_beams_are_all_invalid(localize: Refused, bag: Any, ranges: list[float]) -> None:
    assert re.search(r"none of the 3 processed scans has a usable beam.*ial info", localize(bag.write(ranges=ranges)))


def test_scans_without_beams(localize: Refused, bag: Any) -> None:
    assert "3 × scan without beams" in localize(bag.write(ranges=[]))


def test_zero_increment(localize: Refused, bag: Any) -> None:
    assert "3 × scan with an angle increment of zero" in localize(bag.write(angle_increment=0.0))


@pytest.mark.parametrize("options", [["--from", 99], ["--from", 3]])
def test_from_beyond_the_end(localize: Refused, bag: Any, options: list[object]) -> None:
    assert re.search(r"no scan was left to process from scan \d+ on; choose an earlier --from", localize(bag.write(), *options))


def test_to_not_above_from(localize: Refused, bag: Any) -> None:
    assert "give a --to above --from" in localize(bag.write(), "--from", 2, "--to", 2)


def test_no_map(refused: Refused, bag: Any) -> None:
    assert re.search(r"no map to localize .*run\.mcap in; give --map MAP", refused("localize", bag.write(), "--out", "run"))


@pytest.fixture
def in_map(refused: Refused, room: Path) -> Callable[..., str]:
    """Return a function that localizes the sample in the room after a change of its YAML file, and must be refused."""

    def run(old: str, new: str) -> str:
        text = room.read_text()
        assert old in text
        room.write_text(text.replace(old, new))
        return refused("localize", "--map", room, "--out", "run")

    return run


def test_missing_map(refused: Refused) -> None:
    assert "nowhere.yaml: the map does not exist; check the path" in refused("localize", "--map", "nowhere.yaml", "--out", "run")


def test_missing_image(in_map: Callable[..., str]) -> None:
    assert "gone.pgm" in in_map("room.pgm", "gone.pgm")


@pytest.mark.parametrize("value", ["0.0", ".nan", "-0.1"])
def test_resolution(in_map: Callable[..., str], value: str) -> None:
    assert re.search(r"room\.yaml: .*resolution", in_map("resolution: 0.1", f"resolution: {value}"))


def test_origin_with_nan(in_map: Callable[..., str]) -> None:
    assert re.search(r"room\.yaml: `origin: \.?nan` is not a", in_map("[0.0, 0.0, 0.0]", "[0.0, .nan, 0.0]"))


@pytest.mark.parametrize(("grey", "missing"), [(254, "no occupied cell"), (205, "no occupied cell"), (0, "no free cell")])
def test_a_map_of_one_class(refused: Refused, room: Path, grey: int, missing: str) -> None:
    image = room.with_suffix(".pgm")
    image.write_bytes(b"P5\n80 60\n255\n" + bytes([grey]) * 4800)
    assert missing in refused("localize", "--map", room, "--out", "run")


def test_image_shorter_than_it_says(refused: Refused, room: Path) -> None:
    image = room.with_suffix(".pgm")
    image.write_bytes(image.read_bytes()[:1000])
    assert "room.pgm" in refused("localize", "--map", room, "--out", "run")


def test_a_map_that_is_no_map(refused: Refused, tmp_path: Path) -> None:
    (tmp_path / "map.pgm").write_bytes(b"P5\n1 1\n255\n\0")
    assert "this is no map; give the .yaml file" in refused("localize", "--map", "map.pgm", "--out", "run")


def test_a_recording_without_a_map(refused: Refused, sample: Path) -> None:
    assert "no topic carries a map" in refused("localize", sample, "--map", sample, "--out", "run")


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("rang_error_m: 0.1", r"config\.yaml: unknown key 'rang_error_m'; allowed are range_error_m, .*; did you mean 'range_error_m'\?"),
        ("motion: {translation: {bas: 1}}", r"unknown key 'motion\.translation\.bas'; allowed are per_message, per_metre, .*per_scan"),
        ("motion: {sideways: {bas: 1}}", r"unknown key 'motion\.sideways\.bas'; allowed are per_message, per_metre, .*per_scan"),
        ("motion: {sideways: {base: 1}}", r"'motion\.sideways\.base' has become two: per_scan, .* and per_message, "),
        ("motion: {rotation: {base: 1}}", r"'motion\.rotation\.base' has become two: per_scan, .* and per_message, "),
        ("motion: {sideways: 3}", r"motion\.sideways is 3"),
        ("map_error_m: -0.1", r"config\.yaml: map_error_m is -0\.1: .*greater than or equal to 0"),
        ("motion: {rotation: {per_radian: -1}}", r"motion\.rotation\.per_radian is -1: .*greater than or equal to 0"),
        ("range_error_m: .nan", r"range_error_m is nan: "),
        ("max_beams: 0", r"max_beams is 0: give a whole number from 1 to 8192"),
        ("outliers: 1.5", r"outliers is 1\.5: give a whole number of beams, or a fraction"),
        ("outliers: many", r"outliers is 'many': give a whole number"),
        ("domain: sea", r"domain is 'sea': .*'free' or 'free_or_unknown'"),
        ("motion: 3", r"motion is 3: "),
        ("range_error_m: yes", r"range_error_m is True: give a number"),
        ("a: [", r"config\.yaml: not a YAML file"),
        ("- 1", r"config\.yaml: holds no `key: value` lines"),
        ("max_beams: 9\nmax_beams: 8", r"config\.yaml: .*'max_beams' is there twice"),
    ],
)
def test_configuration(refused: Refused, tmp_path: Path, content: str, message: str) -> None:
    (tmp_path / "config.yaml").write_text(content)
    assert re.search(message, refused("localize", "--config", "config.yaml", "--out", "run"))


def test_a_configuration_that_is_not_there(refused: Refused) -> None:
    assert re.search(r"nowhere\.yaml: .*check the path", refused("localize", "--config", "nowhere.yaml", "--out", "run"))


def test_a_folder_that_cannot_be_written(refused: Refused, tmp_path: Path) -> None:
    (tmp_path / "run").write_text("a file")
    assert re.search(r"run: results cannot be written there .*--out", refused("localize", "--out", "run"))


def test_the_folder_is_tried_before_any_work(refused: Refused, tmp_path: Path) -> None:
    (tmp_path / "run").write_text("a file")
    assert "results cannot be written" in refused("localize", "missing.bag", "--map", "missing.yaml", "--truth", "no.tum", "--out", "run")


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (None, r"truth\.tum: cannot be read .*check the path"),
        ("", r"truth\.tum: holds no pose"),
        ("1 2 3\n", r"truth\.tum, line 1: 3 words"),
        ("1 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n", r"truth\.tum, line 2: .*sort the lines"),
        ("1 nan 0 0 0 0 0 1\n", r"truth\.tum, line 1: .*not finite"),
    ],
)
def test_truth(refused: Refused, tmp_path: Path, content: str | None, message: str) -> None:
    if content is not None:
        (tmp_path / "truth.tum").write_text(content)
    assert re.search(message, refused("localize", "--truth", "truth.tum", "--out", "run"))


def test_a_start_without_a_radius(refused: Refused) -> None:
    assert "belong together; give both" in refused("localize", "--initial", 1, 2, 3, "--out", "run")


@pytest.mark.parametrize("radius", [["-1", "0.1"], ["nan", "0.1"], ["1", "inf"]])
def test_a_start_that_is_no_region(refused: Refused, radius: list[str]) -> None:
    assert "is no region; give finite numbers" in refused("localize", "--initial", 1, 2, 3, "--initial-radius", *radius, "--out", "run")


def test_a_start_outside_the_map(refused: Refused) -> None:
    text = refused("localize", "--initial", 500, 500, 0, "--initial-radius", 1, 1, "--out", "run")
    assert "outside the free space of the map; check --initial" in text


def test_a_laser_pose_that_is_not_finite(localize: Refused, bag: Any) -> None:
    assert "give finite numbers with --laser-pose" in localize(bag.write(), "--laser-pose", 0, "nan", 0)
