"""`PoseSets`: what is known of a robot that may be in any of several maps."""

from dataclasses import dataclass

from ial.contractors.paving.limits import Limit
from ial.lidar.pose_set import PoseSet


@dataclass(frozen=True, eq=False)
class PoseSets:
    """One set of poses, in parts that lie in different maps. A scan cuts all parts with one number of beams that may be bad.

    Parameters
    ----------
    by_map
        The part in each map, by its name; at least one.
    """

    by_map: dict[str, PoseSet]

    def __len__(self) -> int:
        return sum(map(len, self.by_map.values()))

    @property
    def limited(self) -> Limit:
        """Which limit stopped the last search in any map, "" if none."""
        return next((each.limited for each in self.by_map.values() if each.limited), "")

    @property
    def unconfirmed(self) -> bool:
        """Whether the set is only a prediction that was carried on although a scan rejected it."""
        return all(each.unconfirmed.all() for each in self.by_map.values())

    @property
    def fewest_bad(self) -> int:
        """How many beams of the last scan are bad at least, wherever in any map the robot is."""
        return min(each.fewest_bad for each in self.by_map.values() if len(each))

    @property
    def outliers(self) -> int:
        """How many beams of the last scan may be bad."""
        return next(iter(self.by_map.values())).outliers

    @property
    def accepted(self) -> int | None:
        """The same of the last scan that has left a pose."""
        return next(iter(self.by_map.values())).accepted

    def within(self, outliers: int) -> "PoseSets":
        """Return the boxes that may hold a pose from which at most so many beams are bad."""
        return PoseSets({name: each.within(outliers) for name, each in self.by_map.items()})
