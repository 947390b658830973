"""`CopiedMessages`: what a copy of a recording has to say, so that it reads as the same steps."""

import math
from collections import deque
from collections.abc import Iterator
from dataclasses import replace

from ial.datasets.odometry import Odometry
from ial.datasets.odometry_path import OdometryPath
from ial.datasets.recording import Reading
from ial.datasets.scan import LaserScan
from ial.errors import OutputError

_REMEMBERED = 2**12  # stamps, to be compared with those of a sweep that goes back


class CopiedMessages:
    """The messages of a recording in the order of their stamps, each once: those of a scan's sweep come again before the next scans.

    Parameters
    ----------
    name
        What to call the recording in messages.
    """

    def __init__(self, name: str) -> None:
        self._name = name
        self._last: int | None = None
        self._sweeps: dict[int, Odometry] = {}
        self._swept: list[OdometryPath] = []
        self._written: deque[int] = deque(maxlen=_REMEMBERED)
        self._together: list[Reading] = []  # the scans of several lidars that have one stamp

    def of(self, reading: Reading) -> Iterator[tuple[int, Odometry]]:
        """Yield those before a scan, and that at its stamp.

        Raises
        ------
        OutputError
            If no copy could read as the same: their stamps do not increase, or some were lost.
        """
        together = self._joins(reading)
        self._together = [*self._together, reading] if together else [reading]
        if together:
            self._take_sweep(reading)
            return
        for stamp, message in (*reading.messages, (reading.stamp_ns, reading.odometry)):
            if self._last is not None and stamp <= self._last:
                raise OutputError(f"{self._name}: scan {reading.index} has more odometry messages before it than nanoseconds")
            if not math.isfinite(message.error_m):
                raise OutputError(
                    f"{self._name}: before scan {reading.index} too many odometry messages came without a usable scan to keep all"
                )
            self._last = stamp
            if stamp < reading.stamp_ns or not self.looked_up(reading):
                self._check(reading, stamp)
                self._written.append(stamp)
                yield stamp, message
        self._take_sweep(reading)

    def scan(self, reading: Reading) -> LaserScan:
        """Return the scan of the reading at hand as it is to be written: at the stamp of the scans that it came together with."""
        scan, stamp = reading.scan, self._together[0].stamp_ns
        if scan.sweep is not None and scan.sweep.stamps_ns[0] != stamp:
            raise OutputError(f"{self._name}: the sweep of scan {reading.index} does not begin at its stamp, which no copy can say")
        return scan if scan.stamp_ns == stamp else replace(scan, stamp_ns=stamp)

    def looked_up(self, reading: Reading) -> bool:
        """Return whether the odometry of the reading at hand is no message of the stamp at which it is to be written."""
        return reading.looked_up or self._together[0].raised_ns != 0

    def _joins(self, reading: Reading) -> bool:
        """Return whether a scan has the stamp of the last ones, which are of other lidars; a reader moves it by one nanosecond."""
        if not self._together or reading.scan.frame_id in {each.scan.frame_id for each in self._together}:
            return False
        last = self._together[-1]
        return reading.recorded_ns == last.recorded_ns and reading.stamp_ns == last.stamp_ns + 1 and not len(reading.messages)

    def _check(self, reading: Reading, stamp: int) -> None:
        """Refuse a message that would come into the sweep of a scan before, which has none at that stamp."""
        for sweep in self._swept:
            if sweep.stamps_ns[0] < stamp < sweep.stamps_ns[-1] and stamp not in sweep.stamps_ns:
                raise OutputError(self._mended(reading))

    def _mended(self, reading: Reading) -> str:
        return (
            f"{self._name}: before scan {reading.index} come odometry messages that a scan before it, during which they would be, does not "
            "have, as where stamps go back and are mended; a copy would have other odometry during a scan: copy one lidar alone "
            "(--scan-topic), or only the time in which stamps increase"
        )

    def _take_sweep(self, reading: Reading) -> None:
        """Take note of which messages there are during a scan; refuse a sweep back over others than were written."""
        if reading.scan.sweep is not None:
            first, *during, last = reading.scan.sweep.stamps_ns.tolist()
            if last < first and self._written:
                known = [stamp for stamp in reversed(during) if stamp >= self._written[0]]
                if known != [stamp for stamp in self._written if last < stamp < first]:
                    raise OutputError(self._mended(reading))
            self._swept.append(reading.scan.sweep)
        self._swept = [sweep for sweep in self._swept if sweep.stamps_ns[-1] > reading.stamp_ns]
        sweep = () if reading.scan.sweep is None else list(reading.scan.sweep)[1:-1]
        self._sweeps = {stamp: message for stamp, message in (*self._sweeps.items(), *sweep) if stamp > reading.stamp_ns}

    def rest(self) -> Iterator[tuple[int, Odometry]]:
        """Yield those during the last sweeps, which no scan follows."""
        yield from sorted(self._sweeps.items(), key=lambda message: message[0])
