from pathlib import Path

import cv2
import numpy as np
import pytest

from ial.results.active.path_picture import PathPicture
from ial.results.palette import TRUTH, rgb
from tests.active.scenes import RADIUS_M, room
from tests.results.active.legs import driven, leg


def pixels(path: Path) -> np.ndarray:
    drawn = cv2.imread(str(path))
    assert drawn is not None
    return drawn.astype(int)


def like(drawn: np.ndarray, colour: str) -> int:
    """How many pixels have a colour."""
    wanted = np.array(rgb(colour))[::-1] * 255.0
    return int((np.abs(drawn - wanted).max(axis=2) < 3.0).sum())


@pytest.mark.slow
def test_moments_stand_two_in_a_row(tmp_path: Path) -> None:
    first, second = leg(0), leg(1, driven("frontier", target=(1.0, 0.5)))
    for count in (1, 2, 3):
        with PathPicture(tmp_path / f"{count}.png", room(), RADIUS_M) as picture:
            for _ in range(count):
                picture.add("a moment", [first], second)
    one, two, three = (pixels(tmp_path / f"{count}.png") for count in (1, 2, 3))
    assert one.shape[0] == two.shape[0] < three.shape[0]
    assert one.shape[1] < two.shape[1] == three.shape[1]
    assert like(two, TRUTH) > 1.5 * like(one, TRUTH) > 0


@pytest.mark.slow
def test_what_was_not_seen_is_shaded_and_surroundings_are_larger(tmp_path: Path) -> None:
    seen, unseen = "#ffffff", "#ccd0da"
    for near in (False, True):
        with PathPicture(tmp_path / f"{near}.png", room(), RADIUS_M) as picture:
            picture.add("a moment", [leg(0)], near=near)
    whole, close = pixels(tmp_path / "False.png"), pixels(tmp_path / "True.png")
    assert like(whole, unseen) > 1000  # behind the pillar, and farther off than the lidar sees
    assert like(whole, seen) > 1000
    assert np.abs(whole - close).max() > 50


def test_an_error_leaves_no_picture(tmp_path: Path) -> None:
    with pytest.raises(KeyError), PathPicture(tmp_path / "none.png", room(), RADIUS_M):
        raise KeyError
    assert not (tmp_path / "none.png").exists()
