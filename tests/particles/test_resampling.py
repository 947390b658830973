import numpy as np
import pytest

from ial.particles.resampling import effective, low_variance


@pytest.mark.parametrize("count", [1, 7, 500])
def test_each_particle_comes_up_as_often_as_its_weight_says_but_for_one(count: int) -> None:
    random = np.random.default_rng(count)
    for _ in range(100):
        weights = random.random(40) ** 4
        rows = low_variance(weights, count, random)
        expected = count * weights / weights.sum()
        assert len(rows) == count
        assert (np.diff(rows) >= 0).all()
        assert (np.abs(np.bincount(rows, minlength=40) - expected) < 1.0 + 1e-9).all()


def test_a_particle_without_weight_never_comes_up() -> None:
    weights = np.array([0.0, 1.0, 0.0, 2.0, 0.0])
    for seed in range(200):
        assert set(low_variance(weights, 5, np.random.default_rng(seed))) <= {1, 3}


def test_equal_particles_are_all_effective() -> None:
    assert effective(np.full(30, 0.2)) == pytest.approx(30.0)
    assert effective(np.eye(30)[4]) == pytest.approx(1.0)
