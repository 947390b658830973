"""`Mark`: the place in a recording up to which a run has come."""

from dataclasses import dataclass

from ial.datasets.odometry import Odometry


@dataclass(frozen=True)
class Mark:
    """The last processed scan of a run that was interrupted.

    Parameters
    ----------
    index, stamp_ns, odometry
        As in `Step`.
    raised_ns
        By how much its stamp is later than that in the recording, as in `Reading`.
    behind_ns
        How far its stamp in the recording lies behind the latest of a scan before it, because the clock went back.
    """

    index: int
    stamp_ns: int
    odometry: Odometry
    raised_ns: int = 0
    behind_ns: int = 0

    @property
    def recorded_ns(self) -> int:
        """The stamp in the recording."""
        return self.stamp_ns - self.raised_ns

    @property
    def latest_ns(self) -> int:
        """The latest stamp in the recording of all scans up to this."""
        return self.recorded_ns + self.behind_ns
