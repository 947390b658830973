"""`Latencies`: how long scans took, in constant memory."""

import numpy as np

_SHORTEST_S, _LONGEST_S = 1e-6, 1e4
_PER_DECADE = 200  # so neighbouring buckets differ by 1.2 %


class Latencies:
    """A histogram of times with buckets of equal ratio, so that quantiles of any number of scans are known to 1.2 %."""

    def __init__(self) -> None:
        decades = round(np.log10(_LONGEST_S / _SHORTEST_S))
        self._edges = np.geomspace(_SHORTEST_S, _LONGEST_S, decades * _PER_DECADE + 1)
        self._counts = np.zeros(len(self._edges) + 1, dtype=np.int64)
        self.max_s = 0.0

    def __len__(self) -> int:
        """Return how many times were added."""
        return int(self._counts.sum())

    def add(self, seconds: float) -> None:
        """Take the time of one scan."""
        self._counts[np.searchsorted(self._edges, seconds)] += 1
        self.max_s = max(self.max_s, seconds)

    def quantile(self, share: float) -> float:
        """Return the time (s) that at least this share of the scans kept to, at most 1.2 % too long; NaN if there was none."""
        if not len(self):
            return float("nan")
        bucket = int(np.searchsorted(np.cumsum(self._counts), share * len(self)))
        return min(float(self._edges[min(bucket, len(self._edges) - 1)]), self.max_s)

    def __str__(self) -> str:
        median, p99 = (1e3 * self.quantile(share) for share in (0.5, 0.99))
        return f"{median:.1f} ms a scan, 99 % within {p99:.1f}, at most {1e3 * self.max_s:.1f}"
