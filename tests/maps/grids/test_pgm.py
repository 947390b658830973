"""PGM images: both forms, what the header may look like, and every way to be wrong."""

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from ial.errors import MapError
from ial.maps.grids.pgm import decode_pgm, encode_pgm

BODY = b"\x00\x01\x02\xfe\xfd\xff"


@pytest.mark.parametrize(
    "data",
    [
        b"P5\n3 2\n255\n" + BODY,
        b"P5 3 2 255 " + BODY,
        b"P5\n# CREATOR: map_saver 0.050 m/pix\n3 2\n# another\n255\n" + BODY,
        b"P5\n3 2\n255# last\n" + BODY,
        b"P5\r\n3 2\r\n255\r\n" + BODY,
        b"P5\n3 2\n255\n" + BODY + b"\n",
        b"P2\n3 2\n255\n0 1 2\n254 253 255\n",
        b"P2 3 2 255\n0 1 2 # a comment with 12 numbers\n254\t253\r\n255",
    ],
)
def test_forms_of_one_image(data: bytes) -> None:
    pixels, maximum = decode_pgm(data)
    assert pixels.dtype == np.uint8
    assert maximum == 255
    assert pixels.tolist() == [[0, 1, 2], [254, 253, 255]]


def test_sixteen_bits_come_with_the_high_byte_first() -> None:
    pixels, maximum = decode_pgm(b"P5\n2 1\n1000\n\x00\x01\x03\xe8")
    assert (pixels.dtype, maximum, pixels.tolist()) == (np.uint16, 1000, [[1, 1000]])
    pixels, maximum = decode_pgm(b"P2\n2 1\n65535\n1 65535")
    assert (pixels.dtype, maximum, pixels.tolist()) == (np.uint16, 65535, [[1, 65535]])


@pytest.mark.parametrize(
    ("data", "text"),
    [
        (b"P5", "header"),
        (b"P5\n3\n255\n", "header"),
        (b"P5\n-3 2\n255\n" + BODY, "header"),
        (b"P5\n3 2\n255", "header"),
        (b"P5\n# " + b"1" * 50_000, "header"),
        (b"P5\n0 2\n255\n", "0 × 2 cells"),
        (b"P5\n3 0\n255\n", "3 × 0 cells"),
        (b"P5\n70000 2\n255\n" + BODY, "per side"),
        (b"P5\n65000 65000\n255\n" + BODY, "in all"),
        (b"P5\n30000 30000\n255\n" + BODY, "cut short"),
        (b"P2\n30000 30000\n255\n0 1 2", "cut short"),
        (b"P5\n999999999 999999999\n255\n" + BODY, "per side"),
        (b"P5\n3 2\n0\n" + BODY, "white"),
        (b"P5\n3 2\n65536\n" + BODY, "white"),
        (b"P5\n3 2\n255\n" + BODY[:-1], "cut short"),
        (b"P5\n3 2\n255\n" + BODY + b"x", "size in the header is wrong"),
        (b"P5\n3 2\n100\n" + BODY, "above 100"),
        (b"P5\n3 2\n256\n" + BODY, "cut short"),
        (b"P2\n3 2\n255\n0 1 2 3 4", "cut short"),
        (b"P2\n3 2\n255\n1000 1 2 3 4", "cut short"),
        (b"P2\n3 2\n255\n0 1 2 3 4 5 6", "size in the header is wrong"),
        (b"P2\n3 2\n255\n0 1 2 3 4 256", "above 255"),
        (b"P2\n1 1\n255\n99999999999999999999999", "above 255"),
        (b"P2\n3 2\n255\n0 1 2 -3 4 5", "whole numbers"),
        (b"P2\n3 2\n255\n0 1 2 nan 4 5", "whole numbers"),
        (b"P2\n1 1\n255\n", "cut short"),
    ],
)
def test_wrong_images_are_refused(data: bytes, text: str) -> None:
    with pytest.raises(MapError, match=text):
        decode_pgm(data)


@given(st.binary(max_size=200))
@example(b"P5\n3 2\n255\n" + BODY)
def test_random_bytes_are_an_image_or_an_error(data: bytes) -> None:
    for start in (b"", b"P2\n", b"P5\n2 ", b"P2 3 2 255\n", b"P5 3 2 255\n"):
        try:
            pixels, maximum = decode_pgm(start + data)
        except MapError:
            continue
        assert pixels.ndim == 2
        assert pixels.max() <= maximum


def test_what_is_written_is_read() -> None:
    pixels = np.random.default_rng(2).integers(0, 256, (7, 5), dtype=np.uint8)
    decoded, maximum = decode_pgm(encode_pgm(pixels))
    assert maximum == 255
    assert (decoded == pixels).all()
