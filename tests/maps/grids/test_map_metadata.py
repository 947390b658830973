"""The YAML file of a map: what is read, and every way to be wrong."""

import math
from pathlib import Path

import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

from ial.errors import MapError
from ial.maps.grids.map_metadata import MapMetadata, read_metadata

GOOD = {
    "image": "map.pgm",
    "resolution": "0.05",
    "origin": "[-1.5, 2, 0.25]",
    "negate": "0",
    "occupied_thresh": "0.65",
    "free_thresh": "0.196",
}


def write(folder: Path, **changes: str | None) -> Path:
    """Write a map file; None leaves a key out."""
    file = folder / "map.yaml"
    file.write_text("".join(f"{key}: {value}\n" for key, value in {**GOOD, **changes}.items() if value is not None))
    return file


def test_all_keys(tmp_path: Path) -> None:
    metadata = read_metadata(write(tmp_path, mode="scale", comment="{an: [unknown, key]}"))
    assert (metadata.image, metadata.resolution, metadata.negate, metadata.mode) == (tmp_path / "map.pgm", 0.05, False, "scale")
    assert (metadata.origin.x, metadata.origin.y, metadata.origin.theta) == (-1.5, 2.0, 0.25)
    assert (metadata.free_thresh, metadata.occupied_thresh) == (0.196, 0.65)


def test_mode_is_trinary_where_it_is_missing(tmp_path: Path) -> None:
    assert read_metadata(write(tmp_path)).mode == "trinary"


@pytest.mark.parametrize(("text", "negate"), [("0", False), ("1", True), ("true", True), ("False", False), ("no", False), ("'1'", True)])
def test_negate(tmp_path: Path, text: str, negate: bool) -> None:
    assert read_metadata(write(tmp_path, negate=text)).negate is negate


@pytest.mark.parametrize(("text", "value"), [("5e-2", 0.05), (".05", 0.05), ('"0.05"', 0.05), ("1", 1.0), ("+0.1", 0.1)])
def test_forms_of_a_number(tmp_path: Path, text: str, value: float) -> None:
    assert read_metadata(write(tmp_path, resolution=text)).resolution == value


def test_origin_in_block_style_and_a_yaw_beyond_a_turn(tmp_path: Path) -> None:
    origin = read_metadata(write(tmp_path, origin="\n  - 1\n  - 2\n  - 7.0")).origin
    assert (origin.x, origin.y) == (1.0, 2.0)
    assert origin.theta == pytest.approx(7.0 - 2 * math.pi)


def test_paths_of_the_image(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("HOME", str(tmp_path / "someone"))
    assert read_metadata(write(tmp_path, image="sub/a map.png")).image == tmp_path / "sub" / "a map.png"
    assert read_metadata(write(tmp_path, image="/elsewhere/map.pgm")).image == Path("/elsewhere/map.pgm")
    assert read_metadata(write(tmp_path, image="~/maps/map.pgm")).image == tmp_path / "someone" / "maps" / "map.pgm"
    with pytest.raises(MapError, match="home folder"):
        read_metadata(write(tmp_path, image="~nobody-of-this-name/map.pgm"))


@pytest.mark.parametrize("key", GOOD)
def test_a_missing_key_is_named(tmp_path: Path, key: str) -> None:
    with pytest.raises(MapError, match=f"`{key}:` is missing"):
        read_metadata(write(tmp_path, **{key: None}))


@pytest.mark.parametrize(
    ("changes", "text"),
    [
        ({"image": ""}, "empty"),
        ({"image": "[a, b]"}, "single value"),
        ({"mode": "quaternary"}, "trinary, scale or raw"),
        ({"mode": "Trinary"}, "trinary, scale or raw"),
        ({"negate": "2"}, "neither 0 nor 1"),
        ({"negate": "maybe"}, "neither 0 nor 1"),
        ({"resolution": "0"}, "resolution"),
        ({"resolution": "-0.05"}, "resolution"),
        ({"resolution": "nan"}, "not a finite number"),
        ({"resolution": ".nan"}, "not a number"),
        ({"resolution": ".inf"}, "not a number"),
        ({"resolution": "1e999"}, "not a finite number"),
        ({"resolution": "five centimetres"}, "not a number"),
        ({"resolution": ""}, "not a number"),
        ({"resolution": "[0.05]"}, "single value"),
        ({"resolution": "1e-9"}, "metres"),
        ({"origin": "[1, 2]"}, "three numbers"),
        ({"origin": "[1, 2, 3, 4]"}, "three numbers"),
        ({"origin": "[1, 2, [3]]"}, "three numbers"),
        ({"origin": "5"}, "three numbers"),
        ({"origin": "{x: 1, y: 2, yaw: 3}"}, "three numbers"),
        ({"origin": "[nan, 2, 3]"}, "not a finite number"),
        ({"origin": "[1, 2, .nan]"}, "not a number"),
        ({"origin": "[1, 2, north]"}, "not a number"),
        ({"free_thresh": "0.7"}, "free_thresh < occupied_thresh"),
        ({"free_thresh": "0.65"}, "free_thresh < occupied_thresh"),
        ({"free_thresh": "-0.1"}, "0 <= free_thresh"),
        ({"occupied_thresh": "65"}, "occupied_thresh <= 1"),
        ({"occupied_thresh": "nan"}, "not a finite number"),
        ({"extra": "1\nresolution: 0.1"}, "twice"),
    ],
)
def test_impossible_values_are_refused_with_the_path(tmp_path: Path, changes: dict[str, str], text: str) -> None:
    file = write(tmp_path, **changes)
    with pytest.raises(MapError, match=text) as caught:
        read_metadata(file)
    assert str(file) in str(caught.value)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("content", "text"),
    [
        (b"", "no `key: value`"),
        (b"just words", "no `key: value`"),
        (b"- a\n- list\n", "no `key: value`"),
        (b"a: [1, 2", "not YAML"),
        (b"a: b: c", "not YAML"),
        (b"a: *nowhere", "not YAML"),
        (b"a: 1\n---\nb: 2\n", "not YAML"),
        (b"\xff\xfe\x00", "not text"),
        (b"a: \x00", "not YAML"),
        (b"[" * 16_000, "not YAML"),
        (b"- " * 8_000, "not YAML"),
        (b"a" * 20_000, "too many"),
        (b"P5\n3 2\n255\n\x00\x01\x02\xfe\xfd\xff", "not text"),
        (b"!!python/object/apply:os.system ['true']", "no `key: value`"),
    ],
)
def test_other_files_are_refused(tmp_path: Path, content: bytes, text: str) -> None:
    file = tmp_path / "map.yaml"
    file.write_bytes(content)
    with pytest.raises(MapError, match=text):
        read_metadata(file)


def test_aliases_that_multiply_do_not_hang(tmp_path: Path) -> None:
    lines = ["a0: &a0 [x, x, x, x, x, x, x, x, x]"] + [f"a{i}: &a{i} [{', '.join([f'*a{i - 1}'] * 9)}]" for i in range(1, 60)]
    merges = ["b0: &b0 {x: 1}"] + [f"b{i}: &b{i} {{<<: [{', '.join([f'*b{i - 1}'] * 9)}]}}" for i in range(1, 60)]
    file = tmp_path / "map.yaml"
    file.write_text("\n".join([*lines, *merges, *(f"{key}: {value}" for key, value in GOOD.items())]))
    assert read_metadata(file).resolution == 0.05  # 9**60 steps would never end


def test_what_is_no_file_is_refused(tmp_path: Path) -> None:
    with pytest.raises(MapError, match="does not exist"):
        read_metadata(tmp_path / "nowhere.yaml")
    with pytest.raises(MapError, match="not a file"):
        read_metadata(tmp_path)
    with pytest.raises(MapError):
        read_metadata(tmp_path / "null\0character.yaml")


def read_or_refuse(folder: Path, content: bytes) -> MapMetadata | None:
    file = folder / "map.yaml"
    file.write_bytes(content)
    try:
        return read_metadata(file)
    except MapError as error:
        text = str(error)
    assert str(file) in text
    return None


fuzzed = settings(max_examples=150, suppress_health_check=[HealthCheck.function_scoped_fixture])
WHOLE = "".join(f"{key}: {value}\n" for key, value in GOOD.items()).encode()


@pytest.mark.slow
@fuzzed
@given(
    content=st.binary(max_size=300)
    | st.text(max_size=300).map(str.encode)
    | st.text("[]{}:-,&*!|>'\"%@`#? \n\tax10", max_size=80).map(str.encode)
)
@example(content=b"? [a]\n: b")
@example(content=b"{[a]: b, {c: d}: e}")
def test_random_content_is_refused(tmp_path: Path, content: bytes) -> None:
    assert read_or_refuse(tmp_path, content) is None


@fuzzed
@given(
    position=st.integers(0, len(WHOLE)),
    length=st.integers(0, 20),
    insert=st.binary(max_size=6) | st.text("0123456789.e-nai[]{}:# \n", max_size=6).map(str.encode),
)
def test_a_changed_file_gives_possible_values_or_an_error(tmp_path: Path, position: int, length: int, insert: bytes) -> None:
    metadata = read_or_refuse(tmp_path, WHOLE[:position] + insert + WHOLE[position + length :])
    if metadata is not None:
        assert 0.0 < metadata.resolution < math.inf
        assert 0.0 <= metadata.free_thresh < metadata.occupied_thresh <= 1.0
        assert all(map(math.isfinite, (metadata.origin.x, metadata.origin.y, metadata.origin.theta)))
        assert metadata.mode in ("trinary", "scale", "raw")
