"""Grey images of the PGM family (Netpbm), P2 as text and P5 as bytes."""

import re
from typing import Any

import numpy as np
import numpy.typing as npt

from ial.errors import MapError
from ial.maps.grids.occupancy_grid import check_size

GreyArray = npt.NDArray[Any]

_GAP = rb"(?:\s|#[^\r\n]*[\r\n])+"
_HEADER = re.compile(rb"P([25])" + _GAP + rb"(\d{1,9})" + _GAP + rb"(\d{1,9})" + _GAP + rb"(\d{1,9})(?:#[^\r\n]*)?\s")
_COMMENT = re.compile(rb"#[^\r\n]*")


def decode_pgm(data: bytes) -> tuple[GreyArray, int]:
    """Return the pixels of a PGM image and its maximum, the value of white.

    Parameters
    ----------
    data
        The content of the file.

    Returns
    -------
    pixels
        uint8, or uint16 where the maximum exceeds 255, of shape (rows, columns); row 0 on top.
    maximum
        From 1 to 65535.

    Raises
    ------
    MapError
        If the data are not the image that the header announces. Nothing is allocated for pixels that are not there.
    """
    header = _HEADER.match(data)
    if header is None:
        raise MapError("the header is damaged; a PGM image begins with P2 or P5, width, height and the value of white")
    columns, rows, maximum = (int(header[i]) for i in (2, 3, 4))
    check_size(rows, columns)
    if not 1 <= maximum <= 65535:
        raise MapError(f"the header gives {maximum} as the value of white; PGM allows 1 to 65535")
    pixels = (_text if header[1] == b"2" else _binary)(data, header.end(), rows * columns, maximum)
    if pixels.max() > maximum:
        raise MapError(f"a pixel has the value {pixels.max()}, above {maximum}, the value of white in the header")
    return pixels.astype(np.uint8 if maximum < 256 else np.uint16, copy=False).reshape(rows, columns), maximum


def _binary(data: bytes, start: int, count: int, maximum: int) -> GreyArray:
    kind = np.dtype(np.uint8 if maximum < 256 else ">u2")
    length = count * kind.itemsize
    if data[start - 1 : start + 1] == b"\r\n" and len(data) == start + 1 + length:
        start += 1  # a header with the line ends of Windows
    if len(data) < start + length:
        raise MapError(f"the image is cut short: the header announces {length} bytes of pixels, {len(data) - start} are there")
    if data[start + length :].strip():
        raise MapError(f"the header announces {length} bytes of pixels, {len(data) - start} are there: the size in the header is wrong")
    return np.frombuffer(data, kind, count, start)


def _text(data: bytes, start: int, count: int, maximum: int) -> GreyArray:
    body = _COMMENT.sub(b"", data[start:])
    strange = body.translate(None, b"0123456789 \t\r\n\v\f")
    if strange:
        raise MapError(f"the pixels of a P2 image are written as whole numbers, but {strange[:10]!r} is among them")
    if 2 * count - 1 > len(body):
        raise MapError(f"the image is cut short: the header announces {count} pixels, {len(body.split())} are there")
    pixels = np.fromstring(body.decode("ascii"), dtype=np.int64, sep=" ") if body.strip() else np.empty(0, np.int64)
    if len(pixels) != count:
        fault = "the image is cut short" if len(pixels) < count else "the size in the header is wrong"
        raise MapError(f"the header announces {count} pixels, {len(pixels)} are there: {fault}")
    return pixels


def encode_pgm(pixels: npt.NDArray[np.uint8]) -> bytes:
    """Return the content of a P5 file of an 8-bit image, uint8 of shape (rows, columns), row 0 on top."""
    rows, columns = pixels.shape
    return b"P5\n%d %d\n255\n" % (columns, rows) + pixels.tobytes()
