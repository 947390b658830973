from collections.abc import Callable
from pathlib import Path

import cv2
import pytest

from tests.cli.bounce.hall import Cli


@pytest.mark.slow
def test_a_picture_is_written_once(ial: Cli, refused: Callable[..., str]) -> None:
    assert ial("odometer", "show", "--out", "one.png").stdout == "picture in one.png\n"
    assert cv2.imread("one.png") is not None
    assert "one.png" in refused("odometer", "show", "--out", "one.png")
    assert ial("odometer", "show", "--out", "one.png", "--overwrite").exit_code == 0


def test_only_png(refused: Callable[..., str]) -> None:
    assert "a name that ends in .png" in refused("odometer", "show", "--out", "one.svg")
    assert not Path("one.svg").exists()
