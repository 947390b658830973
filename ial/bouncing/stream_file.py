"""Writing a stream of observations, and the poses that belong to it, as text."""

from collections.abc import Iterable
from pathlib import Path

from ial.bouncing.rays.real_robot import RealPose
from ial.whole_file import whole_files

_PER_LINE = 80


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
    lines = ["observation,x_m,y_m,heading_deg\n"]
    lines += [f"{pose.observation},{float(pose.x_m)!r},{float(pose.y_m)!r},{float(360 * pose.turn)!r}\n" for pose in poses]
    _write("".join(lines), path)


def _write(text: str, path: Path) -> None:
    with whole_files(path) as (lent,):
        lent.write_text(text, encoding="ascii")
