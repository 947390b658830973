"""`ConfigKeys`: every key of a configuration file, with its unit and its range."""

from typing import Annotated, Any, Literal

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, PlainValidator

from ial.lidar.configuration.config import LARGEST_HALVINGS, LocalizerConfig
from ial.lidar.configuration.config_record import config_of


def _number(value: Any) -> Any:
    """Refuse what Python takes for a number though nobody means one; YAML leaves 1e-3 a text, which is meant as one."""
    if isinstance(value, bool):
        raise ValueError("give a number, not a truth value")
    return value


def _outliers(value: Any) -> int | float | str:
    """Return the same as `_share`, or the word auto."""
    return "auto" if value == "auto" else _share(value)


def _share(value: Any) -> int | float | str:
    """Keep the difference between 1, one beam, and 1.0 or 1/1, all of them."""
    text = value.strip() if isinstance(value, str) else value
    if isinstance(text, str) and "/" in text:
        return text
    try:
        number = int(text) if isinstance(text, str) and text.isdigit() else float(text) if isinstance(text, str) else text
    except ValueError:
        number = None
    if isinstance(number, bool) or not isinstance(number, int | float):
        raise ValueError("give a whole number of beams, or a fraction of them from 0.0 to 1.0")
    return number


Bound = Annotated[float, BeforeValidator(_number), Field(ge=0.0, allow_inf_nan=False)]
Size = Annotated[float, BeforeValidator(_number), Field(gt=0.0, allow_inf_nan=False)]
Share = Annotated[int | float | str, PlainValidator(_share)]
Count = Annotated[int, BeforeValidator(_number), Field(ge=1)]


class _Keys(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid")


class ErrorBoundKeys(_Keys):
    """What a recorded motion may be wrong by, for each message of the odometry and once for each scan; 0 where a key is left out."""

    per_message: Bound = Field(0.0, description="added for each odometry message: m or rad")
    per_metre: Bound = Field(0.0, description="added for each metre travelled: m/m or rad/m")
    per_radian: Bound = Field(0.0, description="added for each radian turned: m/rad or rad/rad")
    per_second: Bound = Field(0.0, description="added for each second: m/s or rad/s")
    per_scan: Bound = Field(0.0, description="added once for each scan: m or rad")


class MotionKeys(_Keys):
    """How far recorded odometry may be from the truth."""

    translation: ErrorBoundKeys = Field(description="dx, and dy, m")
    rotation: ErrorBoundKeys = Field(description="dθ, rad")
    sideways: ErrorBoundKeys | None = Field(description="dy alone, m; null: as translation")


class LidarKeys(_Keys):
    """How wrong the readings of one lidar may be."""

    range_error_m: Bound = Field(description="bound of a good beam's range error, m")
    bearing_error_rad: Bound = Field(description="bound of its bearing error, rad")


class SizeKeys(_Keys):
    """A size in space and in heading."""

    position_m: Size = Field(description="along x and y, m")
    heading_rad: Size = Field(description="of the heading, rad")


class PrecisionKeys(SizeKeys):
    """How fine an answer is."""

    halvings: Annotated[int, BeforeValidator(_number), Field(ge=0, le=LARGEST_HALVINGS)] = Field(
        description="how often the outermost cells of an answer are halved, to cut off what holds no pose"
    )


class FreeSpaceKeys(_Keys):
    """Whether and how beams say that nothing stands in their way."""

    use: bool = Field(description="whether blocked beams count as bad")
    margin_m: Bound = Field(description="how far beside a ray, and before its end, the map may be wrong, m")
    max_rays: Count = Field(description="how many beams are looked along at most")
    no_return_m: Bound = Field(description="how far beams without return say that nothing stands, m; 0 to ignore them")


class ConfigKeys(_Keys):
    """Every key of a configuration file."""

    range_error_m: Bound = Field(description="bound of a good beam's range error, m")
    bearing_error_rad: Bound = Field(description="bound of its bearing error, rad")
    map_error_m: Bound = Field(description="how far an obstacle may be from its occupied cells, m")
    motion: MotionKeys = Field(description="bounds of the odometry")
    lidars: dict[str, LidarKeys] = Field(description="other errors of single lidars, by the frame of their scans")
    outliers: Annotated[int | float | str, PlainValidator(_outliers)] = Field(
        description="how many beams may be bad: a number, a fraction, or auto"
    )
    outlier_margin: Share = Field(description="with auto: how many more than needed, a number or a fraction")
    max_outliers: Share = Field(description="with auto: a scan that needs more is rejected, a number or a fraction")
    max_jump: Share = Field(description="with auto: so is one that needs so many more than the one before, a number or a fraction")
    free_space: FreeSpaceKeys = Field(description="what beams say about free space")
    precision: PrecisionKeys = Field(description="the widths below which a box is not bisected, and how the border is drawn")
    max_boxes: Count = Field(description="a search with more boxes ends with a coarser answer")
    max_beams: Count = Field(description="how many beams of a scan are used at most")
    deskew: bool = Field(description="whether the motion during a scan is taken out, where it is known")
    domain: Literal["free", "free_or_unknown"] = Field(description="where the base may be")
    robot_radius_m: Bound = Field(description="the base is never nearer to an occupied cell, m")
    check_every: Annotated[int, BeforeValidator(_number), Field(ge=0)] = Field(
        description="every so many scans the whole map is searched for a better place; 0 for never"
    )
    localized_size: SizeKeys = Field(description="half-widths up to which a single hypothesis counts as localized")
    recovery: Literal["union", "restart"] = Field(description="what follows a rejection")
    max_seconds: Size | None = Field(description="a limit on the time of one scan, s; null for none")

    def config(self) -> LocalizerConfig:
        """Return the configuration of a localizer.

        Raises
        ------
        ConfigError
            If a value cannot be used.
        """
        return config_of(self.model_dump())
