"""`Surroundings`: the environments that a command of `ial bounce` is about, as its options want them."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Any

from ial.cli.bounce.options import number
from ial.datasets.sample import sample_map_path
from ial.errors import ConfigError, MapError
from ial.maps.grids.picture import is_picture
from ial.maps.polygons.environment import Environment, load_environment
from ial.maps.polygons.simplification import Simplification, simplified

SAMPLE = Path("sample")


@dataclass(frozen=True)
class Surroundings:
    """Environments by their names, and what was done to those that were simplified.

    Parameters
    ----------
    environments
        The environments; each is named after its file.
    simplifications
        By the same names; empty if none was asked for.
    """

    environments: dict[str, Environment]
    simplifications: dict[str, Simplification]

    @classmethod
    def read(cls, paths: Sequence[Path], resolution: str | None, simplify: str | None, radius: Fraction = Fraction(0)) -> "Surroundings":
        """Read environments.

        Parameters
        ----------
        paths
            Their files; `SAMPLE` is the embedded map.
        resolution
            The width of a pixel of those that are pictures, in metres.
        simplify
            The tolerance of a simplification, in metres.
        radius
            The radius of the robot, which cannot be in parts that are narrower, in metres.

        Raises
        ------
        ConfigError
            If two have the same name, an option is no number, or there is no picture that a resolution could be of.
        MapError
            If one cannot be read or simplified.
        """
        if len({path.stem for path in paths}) < len(paths):
            raise ConfigError("two environments have the same name; give each file a name of its own, since the filter tells them by it")
        if resolution is not None and not any(map(is_picture, paths)):
            raise ConfigError("--resolution is the width of a pixel, and no environment is a picture; leave it out")
        width = None if resolution is None else number(resolution, "--resolution")
        loaded = {path.stem: load_environment(_file(path), width if is_picture(path) else None) for path in paths}
        if simplify is None:
            return cls(loaded, {})
        made = {}
        for name, environment in loaded.items():
            try:
                made[name] = simplified(environment, number(simplify, "--simplify"), 2 * radius)
            except MapError as error:
                raise MapError(f"{name}: {error}") from None
        return cls({name: each.environment for name, each in made.items()}, made)

    def record(self) -> dict[str, Any]:
        """Return what was done, as plain values that JSON can hold."""
        return {
            name: {
                "tolerance_m": float(each.tolerance_m),
                "walls_before": each.walls[0],
                "walls": each.walls[1],
                "moved_m": float(each.moved_m),
                "left_out_parts": each.parts,
                "left_out_parts_m2": float(each.parts_m2),
                "left_out_holes": each.holes,
                "left_out_holes_m2": float(each.holes_m2),
            }
            for name, each in self.simplifications.items()
        }

    def lines(self) -> Iterator[str]:
        """Yield the lines to print about what was done."""
        for name, each in self.record().items():
            yield (
                f"{name}: simplified by {each['tolerance_m']:g} m, {each['walls']:,} of {each['walls_before']:,} walls are left, moved "
                f"by up to {each['moved_m']:.9g} m"
            )
            parts, holes = each["left_out_parts"], each["left_out_holes"]
            if parts or holes:
                yield (
                    f"{name}: left out {parts:,} narrow part{'s' * (parts != 1)} of the free space ({each['left_out_parts_m2']:g} m²) and "
                    f"{holes:,} small obstacle{'s' * (holes != 1)} ({each['left_out_holes_m2']:g} m²)"
                )


def _file(path: Path) -> Path:
    if path != SAMPLE:
        return path
    if path.exists():
        raise ConfigError(f"{path} is the name of the embedded map, and a file or folder here has it, too; give that with its folder")
    return sample_map_path()
