"""`InMemoryRecording`: a recording that is not a file."""

from collections import Counter
from collections.abc import Iterable, Iterator
from itertools import pairwise

from ial.datasets.info import RecordingInfo, Topic
from ial.datasets.recording import Reading
from ial.datasets.survey import survey
from ial.errors import RecordingError


class InMemoryRecording:
    """A recording held in memory, such as a simulated one.

    Parameters
    ----------
    name
        What to call it.
    readings
        Its scans, with strictly increasing stamps.

    Raises
    ------
    RecordingError
        If the stamps do not increase or there is no scan.
    """

    def __init__(self, name: str, readings: Iterable[Reading]) -> None:
        self.name = name
        self.skipped: Counter[str] = Counter()
        self.repaired: Counter[str] = Counter()
        self._readings = list(readings)
        if not self._readings:
            raise RecordingError(f"{name}: there is no scan in it; give at least one")
        stamps = [reading.stamp_ns for reading in self._readings]
        if any(later <= earlier for earlier, later in pairwise(stamps)):
            raise RecordingError(f"{name}: the stamps do not increase; sort the scans by time")

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self.name}>"

    def readings(self) -> Iterator[Reading]:
        """Yield the scans in order."""
        yield from self._readings

    def info(self) -> RecordingInfo:
        """Return what the recording holds."""
        return survey(self, "in memory", [Topic("scans", "LaserScan", len(self._readings))], {})
