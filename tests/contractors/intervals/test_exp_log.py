import mpmath
import numpy as np

from ial.contractors.intervals.exp_log import exp_number, log_number
from tests.cases import cases
from tests.contractors.oracles import hard_numbers, numbers

COUNT = cases(1000, 100)


def test_exponentials_have_the_error_they_state() -> None:
    rng = np.random.default_rng(1)
    points = np.concatenate(
        [rng.uniform(-700.0, 700.0, COUNT), rng.uniform(-0.4, 0.4, COUNT), np.clip(hard_numbers(COUNT, 2), -700.0, 700.0)]
    )
    with mpmath.workdps(60):
        for x, ratio in zip(points.tolist(), rng.uniform(-(2.0**-53), 2.0**-53, len(points)).tolist(), strict=True):
            rest = x * ratio
            high, low, error, k = exp_number(x, rest)
            exact = mpmath.exp(mpmath.mpf(x) + rest) * mpmath.mpf(2) ** int(-k)
            assert abs(mpmath.mpf(high) + low - exact) <= error + 2.0**-53 * abs(low), (x, rest)
            assert 0.7 < high + low < 1.42
            assert error <= 2.0**-53


def test_logarithms_have_the_error_they_state() -> None:
    rng = np.random.default_rng(3)
    points = np.abs(np.concatenate([numbers(COUNT, 4), hard_numbers(COUNT, 5), 1.0 + rng.uniform(-0.3, 0.4, COUNT)]))
    with mpmath.workdps(60):
        for x, ratio in zip(points[points > 0.0].tolist(), rng.uniform(-(2.0**-53), 2.0**-53, (points > 0.0).sum()).tolist(), strict=True):
            rest = x * ratio
            for part, exponent in ((0.0, 0.0), (rest, 0.0), (0.0, 1.0)):
                high, low, error = log_number(x, part, exponent)
                exact = mpmath.log((mpmath.mpf(x) + part) * mpmath.mpf(2) ** int(exponent))
                assert abs(mpmath.mpf(high) + low - exact) <= error, (x, part)
                assert error <= 2.0**-55 + 2.0**-80 * abs(high)
