"""`LocalizerConfig`: all that the localizer assumes and all that it aims at, in one plain record."""

import dataclasses
import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from ial.datasets.motion import MotionBounds
from ial.errors import ConfigError
from ial.lidar.configuration.share import Share, share_of
from ial.lidar.margins import MOST_BEAMS

Domain = Literal["free", "free_or_unknown"]
Recovery = Literal["union", "restart"]
Outliers = Share | Literal["auto"]

LARGEST_HALVINGS = 6  # beyond, pieces are finer than what the bounds of a beam leave open, and the time grows


@dataclass(frozen=True)
class LidarBounds:
    """How wrong the readings of one lidar may be.

    Parameters
    ----------
    range_error_m, bearing_error_rad
        As in `Bounds`.
    """

    range_error_m: float
    bearing_error_rad: float

    def __post_init__(self) -> None:
        for name in ("range_error_m", "bearing_error_rad"):
            _check(f"lidars: {name}", getattr(self, name))


@dataclass(frozen=True)
class Bounds:
    """How wrong the data may be. The guarantee holds while they hold.

    Parameters
    ----------
    range_error_m
        A reading of a good beam is wrong by at most this much.
    bearing_error_rad
        So is its bearing.
    map_error_m
        The obstacle that a good beam hits lies within this distance of an occupied cell.
    motion
        Error of the odometry between two scans.
    lidars
        The errors of lidars that are better or worse than that, by the name of the frame of their scans.
    """

    range_error_m: float = 0.03
    bearing_error_rad: float = 0.005
    map_error_m: float = 0.04
    motion: MotionBounds = field(default_factory=MotionBounds)
    lidars: Mapping[str, LidarBounds] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for name in ("range_error_m", "bearing_error_rad", "map_error_m"):
            _check(name, getattr(self, name))

    def of(self, frame_id: str) -> "Bounds":
        """Return the bounds with the errors of the lidar whose scans have this frame."""
        own = self.lidars.get(frame_id)
        if own is None:
            return self
        return dataclasses.replace(self, range_error_m=own.range_error_m, bearing_error_rad=own.bearing_error_rad)


@dataclass(frozen=True)
class FreeSpace:
    """Whether and how beams say that nothing stands in their way.

    A beam is *blocked* at a pose if its ray, and every ray beside it that is parallel and at most `margin_m` away, meets a closed occupied
    cell more than `margin_m` and the range error before its reading. A blocked beam is bad.

    Parameters
    ----------
    use
        Whether blocked beams count.
    margin_m
        How far beside a ray, and before its end, the map may be wrong.
    max_rays
        How many beams of a scan are looked along at most.
    no_return_m
        Beams without return say that nothing stands within this distance, or within the sensor's range if that is less; 0 to ignore them.
    """

    use: bool = True
    margin_m: float = 0.1
    max_rays: int = 60
    no_return_m: float = 0.0

    @property
    def no_return(self) -> bool:
        """Whether beams without return are used."""
        return self.use and self.no_return_m > 0.0

    def __post_init__(self) -> None:
        _check("free_space.margin_m", self.margin_m)
        _check("free_space.no_return_m", self.no_return_m)
        if not isinstance(self.max_rays, int) or not 1 <= self.max_rays <= MOST_BEAMS:
            raise ConfigError(f"free_space.max_rays is {self.max_rays!r}; give a whole number from 1 to {MOST_BEAMS}")


@dataclass(frozen=True)
class Precision:
    """How fine an answer is: the size below which a box is no longer bisected, and how its border is drawn.

    Parameters
    ----------
    position_m
        Width along x and y.
    heading_rad
        Width of the heading; the circle is divided into a power of two of equal parts of at most this width.
    halvings
        How often the outermost cells of an answer of few cells are halved, to cut off what holds no consistent pose; 0 leaves them whole.
    """

    position_m: float = 0.1
    heading_rad: float = 0.025
    halvings: int = 2

    def __post_init__(self) -> None:
        if isinstance(self.halvings, bool) or not isinstance(self.halvings, int) or not 0 <= self.halvings <= LARGEST_HALVINGS:
            raise ConfigError(f"precision.halvings is {self.halvings!r}; give a whole number from 0 to {LARGEST_HALVINGS}")
        for name, least in (("position_m", 1e-3), ("heading_rad", 1e-3)):
            _check(f"precision.{name}", getattr(self, name), positive=True)
            if getattr(self, name) < least:
                raise ConfigError(
                    f"precision.{name} is {getattr(self, name)!r}; give at least {least:g}: finer cells would fill the memory"
                )


@dataclass(frozen=True)
class LocalizedSize:
    """The half-widths up to which a single hypothesis counts as `localized`."""

    position_m: float = 0.5
    heading_rad: float = math.radians(15.0)

    def __post_init__(self) -> None:
        _check("localized_size.position_m", self.position_m, positive=True)
        _check("localized_size.heading_rad", self.heading_rad, positive=True)


@dataclass(frozen=True)
class LocalizerConfig:
    """The configuration of a localizer.

    Parameters
    ----------
    bounds
        How wrong the data may be.
    outliers
        How many of the used beams may be bad: a whole number, a fraction of them (see `share_of`), or ``"auto"``: for each scan the
        smallest number that leaves a pose, plus `outlier_margin`. The guarantee then holds where the truth has at most so many bad beams.
    outlier_margin
        With ``"auto"``: what is added, a whole number or a fraction.
    max_outliers
        With ``"auto"``: a scan that needs more than this, a whole number or a fraction, is rejected.
    max_jump
        With ``"auto"``: so is a scan that needs this many more than the one before it.
    free_space
        Whether beams also say that nothing stands in their way.
    precision
        How fine the answer shall be.
    max_boxes
        A search with more boxes than this ends with a coarser answer, which is marked.
    max_beams
        How many beams of a scan are used at most.
    deskew
        Whether beams are seen from where the robot was at their own times, where a recording tells that. Only for a lidar whose stamp is
        that of the first beam and whose `time_increment` has the right sign: drivers that turn a scan around often keep it.
    domain
        Where the robot's base may be: in free cells, or in free and unknown ones.
    robot_radius_m
        The base is never nearer to an occupied cell than this.
    check_every
        Every so many scans the whole map is searched for a place where the scan fits better than where the robot is tracked; 0 for never.
    localized_size
        What counts as localized.
    recovery
        What follows a scan that fits nowhere in the prediction: `union` carries the prediction on beside the poses found on the whole map,
        and keeps the truth whichever of the last motion and the last scan broke its bound; `restart` (the paper's) trusts the scan alone.
    max_seconds
        A limit on the time of one scan; None for none. An answer that reaches it is coarser, marked, and not reproducible, nor need be
        those of the scans behind it.
    """

    bounds: Bounds = field(default_factory=Bounds)
    outliers: Outliers = "auto"
    outlier_margin: Share = 0.08
    max_outliers: Share = 0.3
    max_jump: Share = 0.12
    free_space: FreeSpace = field(default_factory=FreeSpace)
    precision: Precision = field(default_factory=Precision)
    max_boxes: int = 4_000_000
    max_beams: int = 180
    deskew: bool = False
    domain: Domain = "free"
    robot_radius_m: float = 0.0
    check_every: int = 0
    localized_size: LocalizedSize = field(default_factory=LocalizedSize)
    recovery: Recovery = "union"
    max_seconds: float | None = None

    def __post_init__(self) -> None:
        for name in ("outliers", "outlier_margin", "max_outliers", "max_jump"):
            value = getattr(self, name)
            if name == "outliers" and isinstance(value, str) and value == "auto":
                continue
            share = share_of(value)
            if share is None:
                also = ", or 'auto'" if name == "outliers" else ""
                raise ConfigError(f"{name} is {value!r}; give a whole number of beams, or a fraction from 0.0 to 1.0{also}")
            object.__setattr__(self, name, share)
        if not isinstance(self.max_boxes, int) or self.max_boxes < 1:
            raise ConfigError(f"max_boxes is {self.max_boxes!r}; give a whole number of at least 1")
        if not isinstance(self.max_beams, int) or not 1 <= self.max_beams <= MOST_BEAMS:
            raise ConfigError(f"max_beams is {self.max_beams!r}; give a whole number from 1 to {MOST_BEAMS}")
        if isinstance(self.check_every, bool) or not isinstance(self.check_every, int) or self.check_every < 0:
            raise ConfigError(f"check_every is {self.check_every!r}; give a whole number, 0 for never")
        _check("robot_radius_m", self.robot_radius_m)
        if self.domain not in ("free", "free_or_unknown"):
            raise ConfigError(f"domain is {self.domain!r}; give 'free' or 'free_or_unknown'")
        if self.recovery not in ("union", "restart"):
            raise ConfigError(f"recovery is {self.recovery!r}; give 'union' or 'restart'")
        if self.max_seconds is not None:
            _check("max_seconds", self.max_seconds, positive=True)


def _check(name: str, value: float, *, positive: bool = False) -> None:
    if not math.isfinite(value) or value < 0.0 or (positive and value == 0.0):
        raise ConfigError(f"{name} is {value!r}; give a finite number {'above' if positive else 'of at least'} 0")
