import math

import numpy as np
import pytest

from ial.lidar.latencies import Latencies


@pytest.mark.parametrize("count", [1, 2, 99, 5000])
def test_quantiles_are_at_most_a_bucket_too_long(count: int) -> None:
    times = np.random.default_rng(count).lognormal(-5.0, 1.5, count)
    latencies = Latencies()
    for seconds in times:
        latencies.add(float(seconds))
    assert len(latencies) == count
    assert latencies.max_s == times.max()
    for share in (0.01, 0.5, 0.9, 0.99, 1.0):
        exact = np.quantile(times, share, method="inverted_cdf")
        assert exact <= latencies.quantile(share) <= 1.012 * exact


def test_times_beyond_every_bucket_count() -> None:
    latencies = Latencies()
    for seconds in (0.0, 1e-9, 1e6):
        latencies.add(seconds)
    assert latencies.quantile(1.0) >= 1e4
    assert latencies.quantile(0.5) <= 2e-6


def test_without_times_there_is_no_quantile() -> None:
    assert math.isnan(Latencies().quantile(0.5))


def test_in_words() -> None:
    latencies = Latencies()
    for _ in range(10):
        latencies.add(0.002)
    assert str(latencies) == "2.0 ms a scan, 99 % within 2.0, at most 2.0"
