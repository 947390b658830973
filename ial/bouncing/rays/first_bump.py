"""`FirstBumps`: on which pieces a robot can be after its first bump, and after how many steps, if something is known of its start."""

from dataclasses import dataclass
from fractions import Fraction

import numpy as np
import numpy.typing as npt

from ial.bouncing.rays.legs import Legs
from ial.bouncing.rays.piece_map import PieceMap, grid_pieces, part_numbers
from ial.bouncing.rays.ray_set import RaySet
from ial.bouncing.start import Start
from ial.errors import ConfigError
from ial.maps.polygons.ray_shooting import reaches

IntArray = npt.NDArray[np.int32]
NEVER = np.iinfo(np.int32).max
_FULL_DEG = 360


@dataclass(frozen=True, eq=False)
class FirstBumps:
    """Pieces that a robot can leave from after its first bump.

    Parameters
    ----------
    pieces
        Their numbers, int32, in ascending order.
    least, most
        After how many steps the robot can have bumped there, at least and at most, int32 each.
    """

    pieces: IntArray
    least: IntArray
    most: IntArray

    def __len__(self) -> int:
        return len(self.pieces)

    def __repr__(self) -> str:
        return f"<FirstBumps on {len(self)} pieces>"

    @classmethod
    def of(cls, map_: PieceMap, legs: Legs, start: Start) -> "FirstBumps":
        """Return where a robot can bump first.

        Parameters
        ----------
        map_
            The pieces.
        legs
            How the robot drives, among the walls of the map.
        start
            What is known of its start.

        Raises
        ------
        ConfigError
            If it can have started nowhere.
        """
        part_deg, count = Fraction(_FULL_DEG, map_.headings), int(map_.parts.sum())
        possible = [each for each in range(map_.headings) if start.holds_heading(each * part_deg, (each + 1) * part_deg)]
        numbers = (np.array(possible, dtype=np.int64)[:, None] * count + np.arange(count)).reshape(-1)
        arriving = grid_pieces(map_.parts, map_.headings).only(numbers)
        arriving = RaySet(arriving.walls, arriving.lower, arriving.upper, arriving.steps, ~arriving.arriving, arriving.reach)
        table, links = map_.walls.table
        reach = reaches(arriving.walls, arriving.lower, arriving.upper, arriving.arriving, table, links, map_.walls.margin)
        least, most = np.full(len(map_), NEVER, dtype=np.int32), np.full(len(map_), -1, dtype=np.int32)
        turns = np.arange(map_.turns[0], map_.turns[1] + 1)
        for steps in range(int(map_.longest.max(initial=0)) + 1):
            states = RaySet(
                arriving.walls, arriving.lower, arriving.upper, np.full(len(arriving), steps, np.int32), arriving.arriving, reach
            )
            kept = np.flatnonzero((reach >= 0.0) & legs.can_have_come(states, start))
            of_kept, touched = legs.with_corners(states.only(kept))
            of_touched, parts = part_numbers(touched, map_.parts)
            heading = numbers[kept[of_kept[of_touched]]] // count
            pieces = ((heading[:, None] + turns) % map_.headings * count + parts[:, None]).reshape(-1)
            np.minimum.at(least, pieces, np.int32(steps))
            most[pieces] = steps
        pieces = np.flatnonzero((most >= 0) & (map_.longest >= 0))
        if not len(pieces):
            raise ConfigError("the robot can have started nowhere in the region and the headings; check both, and its radius")
        return cls(pieces.astype(np.int32), least[pieces], most[pieces])
