from pathlib import Path

import pytest

from ial.odometer import Command, OdometerRobot, localize
from ial.odometer.localization import ONLY
from ial.results.odometer.localization_picture import draw_localization
from ial.results.palette import FOUND, TRUTH
from tests.odometer.worlds import HALL
from tests.results.bouncing.drawn_filter import pixels, read


@pytest.mark.slow
def test_hypotheses_and_the_robot_are_drawn(tmp_path: Path) -> None:
    driven = OdometerRobot(HALL, 1, 1, 30)
    places = [(driven.x, driven.y)]

    class Watched:
        def execute(self, command: Command) -> float:
            reading = driven.execute(command)
            places.append((driven.x, driven.y))
            return reading

    found = localize(HALL, Watched())
    draw_localization(tmp_path / "a.png", "hall", {ONLY: HALL}, found, places)
    image = read(tmp_path / "a.png")
    assert pixels(image, FOUND) > 100
    assert pixels(image, TRUTH) > 20
