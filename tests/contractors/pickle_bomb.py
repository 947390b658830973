"""Kept kernels that somebody has replaced by code of his own."""

import hashlib
import pickle
from collections.abc import Callable
from pathlib import Path


class _Bomb:
    """What makes a file where it is unpickled."""

    def __init__(self, file: Path) -> None:
        self.file = file

    def __reduce__(self) -> tuple[Callable[..., None], tuple[Path]]:
        return Path.touch, (self.file,)


def plant(folder: Path, mark: Path) -> list[Path]:
    """Replace every kept kernel by what makes the file `mark` if it is read, and whose checksum is right."""
    files = sorted(folder.rglob("*.kernel"))
    content = pickle.dumps(_Bomb(mark))
    for file in files:
        file.write_bytes(hashlib.sha256(content).digest() + content)
    assert files
    return files
