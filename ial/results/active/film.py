"""`Film`: frames that become a GIF or an MP4."""

import shutil
import tempfile
from contextlib import AbstractContextManager, ExitStack
from pathlib import Path
from types import TracebackType

import cv2
import numpy as np
import numpy.typing as npt
from PIL import Image

from ial.errors import ConfigError, OutputError
from ial.whole_file import whole_files

Frame = npt.NDArray[np.uint8]

SUFFIXES = (".gif", ".mp4")
_LAST = 4  # so many times the last frame of a film is shown


def check_film_name(path: Path) -> None:
    """Refuse a name by which the kind of the film is not known.

    Raises
    ------
    ConfigError
        If it ends in neither .gif nor .mp4.
    """
    if path.suffix.lower() not in SUFFIXES:
        raise ConfigError(f"{path}: a film is a GIF or an MP4; give a name that ends in {' or '.join(SUFFIXES)}")


class Film(AbstractContextManager["Film"]):
    """A film, which appears under its name when the block ends without an error.

    Parameters
    ----------
    path
        The file, whose name ends in .gif or .mp4.
    frames_per_s
        How many frames a second shows.

    Raises
    ------
    ConfigError
        If the name ends otherwise.
    OutputError
        If the film cannot be written, or there is no frame in it.
    """

    def __init__(self, path: Path, frames_per_s: float = 2.0) -> None:
        check_film_name(path)
        self.path, self.frames_per_s, self.frames = path, frames_per_s, 0
        self._stack = ExitStack()
        self._pictures: list[Image.Image] = []
        self._writer: cv2.VideoWriter | None = None
        self._last: Frame | None = None
        self._draft = Path()

    def __repr__(self) -> str:
        return f"<Film: {self.path}, {self.frames} frames>"

    def __enter__(self) -> "Film":
        self._draft = Path(self._stack.enter_context(tempfile.TemporaryDirectory())) / f"film{self.path.suffix.lower()}"
        return self

    def add(self, frame: Frame) -> None:
        """Add a frame, RGB, uint8 of shape (rows, columns, 3), all of one even size.

        Raises
        ------
        OutputError
            If no film of this kind can be written here.
        """
        if self._draft.suffix == ".gif":
            # Few colours are enough for a drawing; without them a long film would fill the memory.
            self._pictures.append(Image.fromarray(frame).quantize(256, dither=Image.Dither.NONE))
        else:
            self._write(frame)
        self._last = frame
        self.frames += 1

    def _write(self, frame: Frame) -> None:
        if self._writer is None:
            size = frame.shape[1], frame.shape[0]
            self._writer = cv2.VideoWriter(str(self._draft), cv2.VideoWriter.fourcc(*"mp4v"), self.frames_per_s, size)
            if not self._writer.isOpened():
                raise OutputError(f"{self.path}: OpenCV cannot write an MP4 here; give a name that ends in .gif")
        self._writer.write(np.ascontiguousarray(frame[:, :, ::-1]))

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        with self._stack:
            if kind is None:
                self._complete()
            elif self._writer is not None:
                self._writer.release()

    def _complete(self) -> None:
        if self._last is None:
            raise OutputError(f"{self.path}: there is no frame to make a film of")
        if self._writer is None:
            first, *others = self._pictures
            each_ms = round(1000.0 / self.frames_per_s)
            durations = [each_ms] * len(others) + [_LAST * each_ms]
            first.save(self._draft, save_all=True, append_images=others, duration=durations, loop=0)
        else:
            for _ in range(_LAST - 1):
                self._write(self._last)
            self._writer.release()
            held = cv2.VideoCapture(str(self._draft))
            count = 0
            while held.grab():
                count += 1
            held.release()
            wanted = self.frames + _LAST - 1
            if count != wanted:
                raise OutputError(f"{self.path}: OpenCV has written {count} frames of {wanted}; give a name that ends in .gif")
        with whole_files(self.path, what="the film") as (lent,):
            shutil.copyfile(self._draft, lent)
