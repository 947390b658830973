"""`Track`: the enclosures of a run, thinned out where it is long, so that hours of scans take no more memory than many minutes."""

from collections import Counter

from ial.lidar.estimate import Status
from ial.results.lidar.enclosures import Enclosure
from ial.results.lidar.thinning import thinned


class Track:
    """What a picture shows of a run.

    Attributes
    ----------
    scans
        Enclosures in the order of the scans: all of them, or of a long run a selection. Changes of the status and of `vanishing` are in it.
    statuses
        The number of scans by status, over all scans.
    vanishing
        The number of scans that have left hardly anything, over all scans.
    """

    def __init__(self) -> None:
        self.scans: list[Enclosure] = []
        self.statuses: Counter[Status] = Counter()
        self.vanishing = 0

    def __repr__(self) -> str:
        return f"<Track of {len(self)} scans>"

    def __len__(self) -> int:
        """Return the number of all scans."""
        return self.statuses.total()

    def add(self, scan: Enclosure) -> None:
        """Take the next scan."""
        self.scans.append(scan)
        self.statuses[scan.status] += 1
        self.vanishing += scan.vanishing
        self.scans = thinned(self.scans, lambda each: (each.status, each.vanishing))
