"""`LocalizerConfig`: all that the localizer assumes and all that it aims at, in one plain record.

This is the one place where a key of the localizer's configuration is described; that of the bounds of motion is `ial.datasets.motion`.
"""

import dataclasses
import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal, get_args

from ial.datasets.motion import MotionBounds
from ial.keys.key import key
from ial.keys.kind import Maybe, Number, Truth, Whole, Word
from ial.keys.record import Named, Part, Record
from ial.lidar.configuration.share import Share, ShareKind
from ial.lidar.margins import MOST_BEAMS

Domain = Literal["free", "free_or_unknown"]
Recovery = Literal["union", "restart"]
Outliers = Share | Literal["auto"]

_BOUND = Number(least=0.0)
_SIZE = Number(above=0.0)
_SHARE = ShareKind()
_WIDTH = Number(least=1e-3, because="finer cells would fill the memory")
_HALVINGS = Whole(0, 6)  # beyond, pieces are finer than what the bounds of a beam leave open, and the time grows


@dataclass(frozen=True)
class LidarBounds(Record):
    """How wrong the readings of one lidar may be."""

    range_error_m: float = field(metadata=key(_BOUND, "as `range_error_m` of all lidars, for this one", "m"))
    bearing_error_rad: float = field(metadata=key(_BOUND, "as `bearing_error_rad` of all lidars, for this one", "rad"))


@dataclass(frozen=True)
class Bounds(Record):
    """How wrong the data may be. The guarantee holds while they hold."""

    range_error_m: float = field(default=0.03, metadata=key(_BOUND, "a reading of a good beam is wrong by at most this much", "m"))
    bearing_error_rad: float = field(default=0.005, metadata=key(_BOUND, "and its bearing by at most this much", "rad"))
    map_error_m: float = field(
        default=0.04, metadata=key(_BOUND, "the obstacle that a good beam hits lies within this distance of an occupied cell", "m")
    )
    motion: MotionBounds = field(default_factory=MotionBounds, metadata=key(Part(MotionBounds), "errors of the odometry between two scans"))
    lidars: Mapping[str, LidarBounds] = field(
        default_factory=dict,
        metadata=key(Named(LidarBounds), "errors of lidars that are better or worse than that, by the name of the frame of their scans"),
    )

    def of(self, frame_id: str) -> "Bounds":
        """Return the bounds with the errors of the lidar whose scans have this frame."""
        own = self.lidars.get(frame_id)
        if own is None:
            return self
        return dataclasses.replace(self, range_error_m=own.range_error_m, bearing_error_rad=own.bearing_error_rad)


@dataclass(frozen=True)
class FreeSpace(Record):
    """Whether and how beams say that nothing stands in their way.

    A beam is *blocked* at a pose if its ray, and every ray beside it that is parallel and at most `margin_m` away, meets a closed occupied
    cell more than `margin_m` and the range error before its reading. A blocked beam is bad.
    """

    use: bool = field(default=True, metadata=key(Truth(), "whether blocked beams count as bad"))
    margin_m: float = field(default=0.1, metadata=key(_BOUND, "how far beside a ray, and before its end, the map may be wrong", "m"))
    max_rays: int = field(
        default=60, metadata=key(Whole(1, MOST_BEAMS), "how many beams of a scan are looked along at most, spread evenly")
    )
    no_return_m: float = field(
        default=0.0,
        metadata=key(
            _BOUND,
            "beams without return say that nothing stands within this distance, or within the sensor's range if that is less;"
            " 0 ignores them",
            "m",
        ),
    )

    @property
    def no_return(self) -> bool:
        """Whether beams without return are used."""
        return self.use and self.no_return_m > 0.0


@dataclass(frozen=True)
class Precision(Record):
    """How fine an answer is: the size below which a box is no longer bisected, and how its border is drawn."""

    position_m: float = field(
        default=0.1, metadata=key(_WIDTH, "width along x and y of a cell of the answer; at most 128 cells of the map", "m")
    )
    heading_rad: float = field(
        default=0.025,
        metadata=key(_WIDTH, "width of its heading: the circle is divided into a power of two of equal parts of at most this width", "rad"),
    )
    halvings: int = field(
        default=2,
        metadata=key(
            _HALVINGS,
            "how often the outermost cells of an answer of few cells are halved, to cut off what holds no consistent pose;"
            " 0 leaves them whole",
        ),
    )


@dataclass(frozen=True)
class LocalizedSize(Record):
    """The half-widths up to which a single hypothesis counts as `localized`."""

    position_m: float = field(default=0.5, metadata=key(_SIZE, "along x and y", "m"))
    heading_rad: float = field(default=math.radians(15.0), metadata=key(_SIZE, "of the heading", "rad"))


@dataclass(frozen=True)
class LocalizerConfig(Record):
    """The configuration of a localizer."""

    bounds: Bounds = field(default_factory=Bounds, metadata=key(Part(Bounds, flat=True), "how wrong the data may be"))
    outliers: Outliers = field(
        default="auto",
        metadata=key(
            ShareKind(auto=True),
            "how many of the used beams may be bad; `auto`: for each scan the smallest number that leaves a pose, and `outlier_margin`."
            " The guarantee then holds where the truth has at most so many bad beams",
        ),
    )
    outlier_margin: Share = field(default=0.08, metadata=key(_SHARE, "with `auto`: what is added"))
    max_outliers: Share = field(default=0.3, metadata=key(_SHARE, "with `auto`: a scan that needs more than this is rejected"))
    max_jump: Share = field(
        default=0.12, metadata=key(_SHARE, "with `auto`: so is a scan that needs this many more than the one before it")
    )
    free_space: FreeSpace = field(
        default_factory=FreeSpace, metadata=key(Part(FreeSpace), "whether and how beams also say that nothing stands in their way")
    )
    precision: Precision = field(default_factory=Precision, metadata=key(Part(Precision), "how fine the answer shall be"))
    max_boxes: int = field(
        default=4_000_000,
        metadata=key(Whole(1), "a search with more boxes than this ends with a coarser answer, which is marked"),
    )
    max_beams: int = field(default=180, metadata=key(Whole(1, MOST_BEAMS), "how many beams of a scan are used at most, spread evenly"))
    deskew: bool = field(
        default=False,
        metadata=key(
            Truth(),
            "whether beams are seen from where the robot was at their own times, where a recording tells that (`time_increment`)."
            " Only for a lidar whose stamp is that of the first beam and whose `time_increment` has the right sign: drivers that turn a"
            " scan around often keep it",
        ),
    )
    domain: Domain = field(
        default="free", metadata=key(Word(get_args(Domain)), "where the robot's base may be: in free cells, or in free and unknown ones")
    )
    robot_radius_m: float = field(default=0.0, metadata=key(_BOUND, "the base is never nearer to an occupied cell than this", "m"))
    check_every: int = field(
        default=0,
        metadata=key(
            Whole(0),
            "every so many scans the whole map is searched for a place where the scan fits better than where the robot is tracked;"
            " 0 for never",
        ),
    )
    localized_size: LocalizedSize = field(
        default_factory=LocalizedSize,
        metadata=key(Part(LocalizedSize), "the half-widths up to which a single hypothesis counts as localized"),
    )
    recovery: Recovery = field(
        default="union",
        metadata=key(
            Word(get_args(Recovery)),
            "what follows a scan that fits nowhere in the prediction: `union` carries the prediction on beside the poses found on the whole"
            " map, and keeps the truth whichever of the last motion and the last scan broke its bound; `restart` (the paper's) trusts the"
            " scan alone",
        ),
    )
    max_seconds: float | None = field(
        default=None,
        metadata=key(
            Maybe(_SIZE),
            "a limit on the time of one scan; null for none. An answer that reaches it is coarser, marked, and not reproducible, nor need"
            " be those of later scans",
            "s",
        ),
    )
