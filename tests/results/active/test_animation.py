from pathlib import Path

import numpy as np
import pytest

from ial.active.decision import Decision
from ial.results.active.animation import ExplorationAnimation
from tests.active.scenes import RADIUS_M, room
from tests.results.active.legs import driven, leg
from tests.results.active.test_film import frames


@pytest.mark.slow
def test_a_frame_for_each_scan_with_the_drive_that_is_decided_there(tmp_path: Path) -> None:
    path = tmp_path / "film.mp4"
    with ExplorationAnimation(path, room(), RADIUS_M, "a room") as film:
        film.add(leg(0))
        film.add(leg(1, driven("direction")))
        film.add(leg(2, driven("frontier", since=2, target=(1.0, 0.5))))
        film.add(leg(3, Decision(None, "exhausted", "nothing is left")))
    shown = frames(path)
    assert len(shown) == 3 + 3  # the last one stays
    first, second, last = (each.astype(int) for each in shown[:3])
    assert np.abs(first - second).max() > 50  # the target, and what is said
    assert np.abs(second - last).max() > 50
    assert first.shape[0] % 2 == first.shape[1] % 2 == 0


@pytest.mark.slow
def test_a_run_that_ends_with_a_drive_shows_where_it_ends(tmp_path: Path) -> None:
    with ExplorationAnimation(tmp_path / "film.mp4", room(), RADIUS_M, "a room") as film:
        film.add(leg(0))
        film.add(leg(1, driven("direction"), collided=True))
    assert len(frames(tmp_path / "film.mp4")) == 2 + 3
