from pathlib import Path

import cv2
import numpy as np
import numpy.typing as npt
import pytest

from ial.errors import ConfigError, OutputError
from ial.results.active.film import Film

COLOURS = [(200, 30, 30), (30, 200, 30), (30, 30, 200)]


def frames(path: Path) -> list[npt.NDArray[np.uint8]]:
    film = cv2.VideoCapture(str(path))
    found = []
    while True:
        more, frame = film.read()
        if not more:
            return found
        found.append(np.asarray(frame, dtype=np.uint8))


def test_a_gif_has_the_frames_that_it_was_given(tmp_path: Path) -> None:
    with Film(tmp_path / "a.gif") as film:
        for colour in COLOURS:
            film.add(np.full((40, 60, 3), colour, dtype=np.uint8))
    from PIL import Image

    with Image.open(tmp_path / "a.gif") as opened:
        shown = []
        for number in range(opened.n_frames):
            opened.seek(number)
            shown.append(opened.convert("RGB").getpixel((30, 20)))
        assert opened.size == (60, 40)
    assert len(shown) == 3
    assert np.abs(np.array(shown) - COLOURS).max() <= 8
    assert [file.name for file in tmp_path.iterdir()] == ["a.gif"]


def test_an_mp4_has_them_too_and_its_last_one_stays(tmp_path: Path) -> None:
    with Film(tmp_path / "a.MP4") as film:
        for colour in COLOURS:
            film.add(np.full((40, 60, 3), colour, dtype=np.uint8))
    shown = frames(tmp_path / "a.MP4")
    assert len(shown) == 6
    assert {frame.shape for frame in shown} == {(40, 60, 3)}
    wanted = np.array([COLOURS[min(number, 2)] for number in range(6)])[:, ::-1]
    assert np.abs(np.array([frame[20, 30] for frame in shown]).astype(int) - wanted).max() <= 25


@pytest.mark.parametrize("name", ["a.avi", "gif", "a.png", ".gif"])
def test_a_name_that_ends_otherwise_is_refused(tmp_path: Path, name: str) -> None:
    with pytest.raises(ConfigError, match=r"give a name that ends in \.gif or \.mp4"):
        Film(tmp_path / name)


def interrupted(path: Path) -> None:
    with Film(path) as film:
        film.add(np.zeros((40, 60, 3), dtype=np.uint8))
        raise KeyError


@pytest.mark.parametrize("name", ["a.gif", "a.mp4"])
def test_an_error_leaves_no_film_and_one_without_frames_is_none(tmp_path: Path, name: str) -> None:
    with pytest.raises(KeyError):
        interrupted(tmp_path / name)
    with pytest.raises(OutputError, match="no frame"), Film(tmp_path / name):
        pass
    assert list(tmp_path.iterdir()) == []
