import itertools

import numpy as np
import pytest

from ial.active.direction_choice import DirectionChoice, Weights, largest_classes
from ial.errors import ConfigError


def twin_class(readings: list[float], same: float) -> int:
    """The size of the largest class: cut the sorted readings at gaps, and look at every part."""
    ordered = sorted(readings)
    parts, part = [], [ordered[0]]
    for before, after in itertools.pairwise(ordered):
        if after - before > same:
            parts.append(part)
            part = []
        part.append(after)
    largest = max(len(each) for each in [*parts, part])
    return 0 if largest == 1 else largest


@pytest.mark.parametrize("seed", range(5))
def test_scores_are_those_of_the_paper(seed: int) -> None:
    readings = np.round(np.random.default_rng(seed).uniform(0.0, 4.0, (7, 9)), 1)
    raw = DirectionChoice.of(readings, readings, 20.0, Weights(0.95, 0.05, 0.15, raw=True))
    scaled = DirectionChoice.of(readings, readings, 20.0, Weights(0.95, 0.05, 0.15))
    for k in range(9):
        column = readings[:, k].tolist()
        differing = 7 - twin_class(column, 0.15)
        spread = sum(abs(a - b) for a, b in itertools.combinations(column, 2))
        assert raw.differing[k] == differing
        assert raw.scores[k] == pytest.approx(0.95 * differing + 0.05 * spread)
        assert scaled.scores[k] == pytest.approx(0.95 * differing + 0.05 * 7 * spread / (21 * 20.0))
    assert raw.best.tolist() == np.flatnonzero(np.isclose(raw.scores, raw.scores.max())).tolist()


def test_readings_with_bounds_are_alike_if_they_overlap() -> None:
    lower, upper = np.array([[0.0], [1.0], [2.5], [9.0]]), np.array([[1.5], [2.6], [3.0], [9.5]])
    assert largest_classes(lower, upper, 0.0).tolist() == [3]
    assert largest_classes(lower, upper, 6.0).tolist() == [4]
    assert largest_classes(lower[:1], upper[:1], 0.0).tolist() == [0]


def test_a_reading_inside_of_a_wide_one_does_not_end_its_class() -> None:
    lower, upper = np.array([[0.0], [1.0], [5.0]]), np.array([[9.0], [1.1], [5.1]])
    assert largest_classes(lower, upper, 0.0).tolist() == [3]


@pytest.mark.parametrize("weights", [{"alpha": -1.0}, {"beta": -0.1}, {"alpha": 0.0, "beta": 0.0}, {"same_m": -1.0}])
def test_weights_that_cannot_be_meant(weights: dict[str, float]) -> None:
    with pytest.raises(ConfigError, match="not negative"):
        Weights(**weights)
