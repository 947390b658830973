import math

import numpy as np
import pytest

from ial.active.robot import Drive
from ial.errors import ConfigError
from ial.particles.markov import HistogramOptions, MarkovLocalization
from ial.pose import Pose
from tests.active.scenes import robot, room

GRID = room()


def test_the_likeliest_cell_is_that_of_the_robot() -> None:
    driving = robot(GRID, Pose(1.5, 1.0, 0.3), 2)
    markov = MarkovLocalization(GRID, 4.0)
    before = markov.entropy
    assert before == pytest.approx(math.log(markov.free.sum() * 36))
    markov.update(driving.look())
    for _ in range(4):
        driven = driving.drive(Drive(0.2, 0.5))
        markov.predict(driven.motion)
        markov.update(driven.reading)
        assert markov.belief.sum() == pytest.approx(1.0)
    ((heading, row, column),), _ = markov.likely(1)
    assert abs((column + 0.5) * 0.25 - driving.pose.x) < 0.3
    assert abs((row + 0.5) * 0.25 - driving.pose.y) < 0.3
    assert abs(math.remainder(heading * 2.0 * math.pi / 36 - driving.pose.theta, 2.0 * math.pi)) < 0.2
    assert markov.entropy < before / 2.0


def test_more_is_to_be_learned_where_readings_differ() -> None:
    markov = MarkovLocalization(GRID, 4.0)
    alike, different = np.array([[0, 4, 8], [18, 4, 8]]), np.array([[0, 4, 4], [0, 12, 20]])
    half = np.array([0.5, 0.5])
    assert markov.expected_entropy(different, half, 0.0, 0.0) < 0.05
    assert markov.expected_entropy(np.repeat(alike[:1], 2, axis=0), half, 0.0, 0.0) == pytest.approx(math.log(2.0))


def test_what_is_impossible_is_left_out() -> None:
    markov = MarkovLocalization(GRID, 4.0)
    possible = np.zeros(markov.belief.shape, dtype=np.bool_)
    possible[3, 5, 6] = True
    markov.keep(possible)
    assert markov.belief[3, 5, 6] == 1.0
    markov.keep(~possible)
    assert markov.belief[3, 5, 6] == 1.0, "that would leave nothing"


@pytest.mark.parametrize("wrong", [{"cell_m": 0.0}, {"sigma_m": -1.0}, {"unexplained": 0.0}, {"headings": 3}, {"beams": 7}])
def test_options_that_cannot_be_meant(wrong: dict[str, float]) -> None:
    with pytest.raises(ConfigError, match="give"):
        HistogramOptions(**wrong)  # type: ignore[arg-type]
