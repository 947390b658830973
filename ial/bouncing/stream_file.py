"""A stream of observations, and the poses that belong to it, as text."""

from collections.abc import Iterable
from fractions import Fraction
from pathlib import Path

from ial.bouncing.rays.real_robot import RealPose
from ial.errors import StreamError
from ial.whole_file import whole_files

_PER_LINE = 80
_HEAD = "observation,x_m,y_m,heading_deg"


def write_stream(observations: Iterable[int], path: Path) -> None:
    """Write observations as lines of 0 and 1; `parse_stream` reads them.

    Raises
    ------
    OutputError
        If the file cannot be written.
    """
    text = "".join(map(str, observations))
    _write("".join(f"{text[at : at + _PER_LINE]}\n" for at in range(0, len(text), _PER_LINE)), path)


def write_truth(poses: Iterable[RealPose], path: Path) -> None:
    """Write the pose after each observation as comma-separated values.

    Raises
    ------
    OutputError
        If the file cannot be written.
    """
    lines = [f"{_HEAD}\n"]
    lines += [f"{pose.observation},{float(pose.x_m)!r},{float(pose.y_m)!r},{float(360 * pose.turn)!r}\n" for pose in poses]
    _write("".join(lines), path)


def read_truth(path: Path) -> list[RealPose]:
    """Return the poses that `write_truth` has written.

    Raises
    ------
    StreamError
        If the file cannot be read, or a line is no pose.
    """
    try:
        head, *lines = path.read_text(encoding="ascii").splitlines() or [""]
    except OSError as error:
        raise StreamError(f"{path}: the poses cannot be read ({error.strerror or error}); check the path") from None
    except UnicodeDecodeError:
        raise StreamError(f"{path}: the poses are no text; give what `ial bounce simulate --truth` has written") from None
    if head != _HEAD:
        raise StreamError(f"{path}: the first line is no {_HEAD}; give what `ial bounce simulate --truth` has written")
    poses = []
    for number, line in enumerate(lines, 2):
        observation, *values = line.split(",")
        try:
            x, y, heading = (Fraction(value) for value in values)
        except (ValueError, ZeroDivisionError):
            raise StreamError(f"{path}:{number}: {line!r} is no pose; give {_HEAD}") from None
        if observation not in ("0", "1"):
            raise StreamError(f"{path}:{number}: the observation is {observation!r}; give 0 (a step) or 1 (a bump)")
        poses.append(RealPose(int(observation), x, y, heading / 360))
    return poses


def _write(text: str, path: Path) -> None:
    with whole_files(path) as (lent,):
        lent.write_text(text, encoding="ascii")
