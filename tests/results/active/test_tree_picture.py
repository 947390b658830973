from pathlib import Path

import cv2
import numpy as np
import pytest

from ial.results.active.tree_picture import TreePicture
from ial.results.palette import HYPOTHESES, VANISHING, rgb
from tests.results.active.legs import driven, leg


def shows(path: Path, colour: str) -> bool:
    pixels = cv2.imread(str(path))
    assert pixels is not None
    wanted = np.array(rgb(colour))[::-1] * 255.0
    return int((np.abs(pixels - wanted).max(axis=2) < 3.0).sum()) > 20


@pytest.mark.slow
def test_stages_have_their_colours_and_collisions_are_marked(tmp_path: Path) -> None:
    direction, backtrack, frontier = HYPOTHESES[:3]
    with TreePicture(tmp_path / "plain.png", "plain") as picture:
        picture.add(leg(0))
        picture.add(leg(1, driven("frontier", since=1, open=(1, 1, 1, 1, 1, 1))))
    assert [shows(tmp_path / "plain.png", each) for each in (frontier, VANISHING)] == [True, False]
    with TreePicture(tmp_path / "rich.png", "rich") as picture:
        picture.add(leg(0))
        picture.add(leg(1, driven("direction")))
        picture.add(leg(2, driven("frontier", since=2), collided=True))
        picture.add(leg(3, driven("backtrack", since=1)))
    assert [shows(tmp_path / "rich.png", each) for each in (direction, backtrack, frontier, VANISHING)] == [True] * 4


@pytest.mark.slow
def test_a_long_search_does_not_make_an_endless_picture(tmp_path: Path) -> None:
    with TreePicture(tmp_path / "long.png", "long") as picture:
        for number in range(150):
            picture.add(leg(number, driven("view") if number else None))
    pixels = cv2.imread(str(tmp_path / "long.png"))
    assert pixels is not None
    assert pixels.shape[1] <= 60 * 120


def test_an_error_leaves_no_picture(tmp_path: Path) -> None:
    with pytest.raises(KeyError), TreePicture(tmp_path / "none.png", "none"):
        raise KeyError
    assert not (tmp_path / "none.png").exists()
