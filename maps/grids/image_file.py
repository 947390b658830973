"""Images of maps: PGM and PNG, grey or coloured, 8 or 16 bits, with or without transparency."""

import struct
import zlib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from ial.errors import MapError
from ial.maps.grids.occupancy_grid import LARGEST_AREA, check_size
from ial.maps.grids.pgm import decode_pgm

_PNG = b"\x89PNG\r\n\x1a\n"
_LARGEST_FILE = 2 * LARGEST_AREA  # bytes


@dataclass(frozen=True, eq=False)
class Image:
    """Pixels as they are in the file, row 0 on top.

    Parameters
    ----------
    colour
        uint8 or uint16 of shape (rows, columns, channels) with 1 channel (grey) or 3 (red, green, blue).
    alpha
        Opacity of the same type, shape (rows, columns); None where the file has none.
    maximum
        The value of white and of full opacity.
    """

    colour: npt.NDArray[Any]
    alpha: npt.NDArray[Any] | None
    maximum: int


def read_image(path: Path) -> Image:
    """Read an image.

    Raises
    ------
    MapError
        If the file is missing, is neither PGM nor PNG, is damaged or cut short, or holds no pixel or too many.
    """
    try:
        if not path.exists():
            raise MapError(f"{path}: the image of the map does not exist; correct `image:` in its YAML file")
        if not path.is_file():
            raise MapError(f"{path}: the image of the map is not a file; correct `image:` in its YAML file")
        if path.stat().st_size > _LARGEST_FILE:
            raise MapError(f"{path}: the image has {path.stat().st_size} bytes, more than any supported map; crop it, or use larger cells")
        data = path.read_bytes()
    except (OSError, ValueError) as error:  # ValueError: a path with a null character
        raise MapError(f"{str(path)!r}: the image of the map cannot be read: {error}") from error
    try:
        if data[:2] in (b"P2", b"P5"):
            pixels, maximum = decode_pgm(data)
            return Image(pixels[:, :, None], None, maximum)
        if data.startswith(_PNG):
            return _decode_png(data)
    except MapError as error:
        raise MapError(f"{path}: {error}") from error
    except MemoryError as error:
        raise MapError(f"{path}: there is not enough memory for this image; crop it, or use larger cells") from error
    what = f"begins with {data[:8]!r}" if data else "is empty"
    raise MapError(f"{path}: the file {what}, so it is neither a PGM (P2, P5) nor a PNG image; save the map as one of these")


def _decode_png(data: bytes) -> Image:
    import cv2

    _check_png(data)
    try:
        decoded = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_UNCHANGED)
    except cv2.error as error:
        raise MapError(f"the PNG image cannot be decoded: {error.err or error}") from error
    if decoded is None:
        raise MapError("the PNG image is damaged; save the map again")
    pixels = np.asarray(decoded)
    if pixels.dtype not in (np.uint8, np.uint16):
        raise MapError(f"the PNG image has pixels of type {pixels.dtype}; save it with 8 or 16 bits")
    maximum = 255 if pixels.dtype == np.uint8 else 65535
    if pixels.ndim == 2:
        return Image(pixels[:, :, None], None, maximum)
    return Image(pixels[:, :, 2::-1], pixels[:, :, 3] if pixels.shape[2] == 4 else None, maximum)


def _check_png(data: bytes) -> None:
    """Raise unless all chunks are there and undamaged: a decoder may fill what is missing with black (PNG specification, section 5)."""
    at, kind = len(_PNG), b""
    kinds: set[bytes] = set()
    while kind != b"IEND":
        length = int.from_bytes(data[at : at + 4], "big")
        kind, body, check = data[at + 4 : at + 8], data[at + 8 : at + 8 + length], data[at + 8 + length : at + 12 + length]
        if len(check) < 4:
            raise MapError(f"the PNG image is cut short after {len(data)} bytes")
        if zlib.crc32(kind + body).to_bytes(4, "big") != check:
            raise MapError(f"the PNG image is damaged: the checksum of its part {kind!r} is wrong")
        if not kinds:
            if kind != b"IHDR" or length != 13:
                raise MapError("the PNG image is damaged: its header is missing")
            columns, rows, _, colour_type = struct.unpack(">IIBB", body[:10])
            check_size(rows, columns)
        kinds.add(kind)
        at += 12 + length
    if b"tRNS" in kinds and colour_type in (0, 2):
        raise MapError("the PNG image declares one colour as transparent, which is not supported; save it with an alpha channel")
