"""Images of maps: the kinds of PNG, and files that are none."""

import os
import struct
import zlib
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from ial.errors import MapError
from ial.maps.grids.image_file import read_image

PNG = b"\x89PNG\r\n\x1a\n"


def part(kind: bytes, body: bytes) -> bytes:
    return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))


def png(columns: int, rows: int, depth: int, colour_type: int, lines: bytes, *others: bytes) -> bytes:
    """Return a PNG file; `lines` holds the rows, each with its filter byte in front."""
    header = part(b"IHDR", struct.pack(">IIBBBBB", columns, rows, depth, colour_type, 0, 0, 0))
    return PNG + header + b"".join(others) + part(b"IDAT", zlib.compress(lines)) + part(b"IEND", b"")


GREY = png(2, 2, 8, 0, b"\0\x01\x02\0\x03\x04")


def read(folder: Path, data: bytes) -> tuple[list[object], list[object] | None, int]:
    file = folder / "map.png"
    file.write_bytes(data)
    image = read_image(file)
    return image.colour.tolist(), None if image.alpha is None else image.alpha.tolist(), image.maximum


@pytest.mark.parametrize(
    ("data", "colour", "alpha", "maximum"),
    [
        (GREY, [[[1], [2]], [[3], [4]]], None, 255),
        (png(2, 1, 1, 0, b"\0\x40"), [[[0], [255]]], None, 255),
        (png(2, 1, 16, 0, b"\0\x01\x02\xff\xff"), [[[258], [65535]]], None, 65535),
        (png(1, 1, 8, 2, b"\0\x10\x20\x30"), [[[16, 32, 48]]], None, 255),
        (png(1, 1, 8, 6, b"\0\x10\x20\x30\x80"), [[[16, 32, 48]]], [[128]], 255),
        (png(1, 1, 8, 4, b"\0\x10\x80"), [[[16, 16, 16]]], [[128]], 255),
        (png(1, 1, 16, 4, b"\0\x10\x01\x80\x03"), [[[4097] * 3]], [[32771]], 65535),
        (png(2, 1, 8, 3, b"\0\0\1", part(b"PLTE", b"\1\2\3\4\5\6")), [[[1, 2, 3], [4, 5, 6]]], None, 255),
        (png(2, 1, 8, 3, b"\0\0\1", part(b"PLTE", b"\1\2\3\4\5\6"), part(b"tRNS", b"\0")), [[[1, 2, 3], [4, 5, 6]]], [[0, 255]], 255),
    ],
    ids=["grey", "bits", "grey16", "rgb", "rgba", "grey-alpha", "grey-alpha16", "palette", "palette-alpha"],
)
def test_kinds_of_png(tmp_path: Path, data: bytes, colour: list[object], alpha: list[object] | None, maximum: int) -> None:
    assert read(tmp_path, data) == (colour, alpha, maximum)


def test_a_pgm_is_recognized_by_its_content_not_its_name(tmp_path: Path) -> None:
    assert read(tmp_path, b"P5 2 1 255\n\x01\x02") == ([[[1], [2]]], None, 255)


@pytest.mark.parametrize(
    ("data", "text"),
    [
        (b"", "is empty"),
        (b"P6 1 1 255\nabc", "neither a PGM"),
        (b"\xff\xd8\xff\xe0 a photograph", "neither a PGM"),
        (GREY[:-1], "cut short"),
        (GREY[:40], "cut short"),
        (GREY[:8], "cut short"),
        (GREY[:45] + bytes([GREY[45] ^ 1]) + GREY[46:], "checksum"),
        (PNG + part(b"IDAT", b"") + part(b"IEND", b""), "header is missing"),
        (png(70000, 1, 8, 0, b""), "per side"),
        (png(0, 1, 8, 0, b""), "0 × 1 cells"),
        (png(30000, 30000, 8, 0, b"\0"), "damaged"),
        (png(2, 2, 8, 0, b"\0\1\2"), "damaged"),
        (png(2, 1, 8, 0, b"\0\1\2", part(b"tRNS", b"\0\1")), "transparent"),
    ],
)
def test_wrong_images_are_refused_with_their_path(tmp_path: Path, data: bytes, text: str) -> None:
    with pytest.raises(MapError, match=text) as caught:
        read(tmp_path, data)
    assert str(tmp_path / "map.png") in str(caught.value)


def test_what_is_no_file_is_refused(tmp_path: Path) -> None:
    with pytest.raises(MapError, match="does not exist"):
        read_image(tmp_path / "nowhere.pgm")
    with pytest.raises(MapError, match="not a file"):
        read_image(tmp_path)
    os.mkfifo(tmp_path / "pipe.pgm")  # reading it would wait for ever
    with pytest.raises(MapError, match="not a file"):
        read_image(tmp_path / "pipe.pgm")
    with pytest.raises(MapError):
        read_image(tmp_path / "null\0character.pgm")
    with pytest.raises(MapError, match="cannot be read"):
        read_image(tmp_path / ("long" * 1000))


def test_a_file_of_absurd_size_is_refused_unread(tmp_path: Path) -> None:
    file = tmp_path / "map.pgm"
    with file.open("wb") as stream:
        stream.truncate(2**40)  # sparse: it takes no room on the disk
    with pytest.raises(MapError, match="1099511627776 bytes"):
        read_image(file)


@settings(max_examples=150, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(data=st.data())
def test_a_damaged_png_never_passes_for_another_image(tmp_path: Path, data: st.DataObject) -> None:
    pixels = np.random.default_rng(3).integers(0, 256, (6, 9), dtype=np.uint8)
    whole = png(9, 6, 8, 0, b"".join(b"\0" + row.tobytes() for row in pixels))
    position = data.draw(st.integers(0, len(whole) - 1))
    change = data.draw(st.integers(1, 255))
    damaged = whole[:position] + bytes([whole[position] ^ change]) + whole[position + 1 :]
    for content in (damaged, whole[:position]):
        with pytest.raises(MapError):
            read(tmp_path, content)


@settings(max_examples=100, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(header=st.binary(min_size=13, max_size=13), body=st.binary(max_size=60), kind=st.sampled_from([b"PLTE", b"tRNS", b"gAMA", b"abcd"]))
def test_valid_parts_with_random_content_are_an_image_or_an_error(tmp_path: Path, header: bytes, body: bytes, kind: bytes) -> None:
    small = b"\0\0\0" + header[3:4] + b"\0\0\0" + header[7:]
    for head in (header, small):
        file = part(b"IHDR", head) + part(kind, body) + part(b"IDAT", zlib.compress(body)) + part(b"IEND", b"")
        try:
            text = f"map.png was read: {read(tmp_path, PNG + file)}"
        except MapError as error:
            text = str(error)
        assert "map.png" in text
