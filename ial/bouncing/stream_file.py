"""Writing a stream of observations, and the poses behind it, as text."""

from collections.abc import Iterable
from pathlib import Path

from ial.bouncing.real_robot import RealPose
from ial.errors import OutputError

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
    """Write the pose behind each observation as comma-separated values.

    Raises
    ------
    OutputError
        If the file cannot be written.
    """
    lines = ["observation,x_m,y_m,heading_deg\n"]
    lines += [f"{pose.observation},{float(pose.x_m)!r},{float(pose.y_m)!r},{float(360 * pose.turn)!r}\n" for pose in poses]
    _write("".join(lines), path)


def _write(text: str, path: Path) -> None:
    """Write a file under another name first, so that no half file is left under its own."""
    temporary = path.with_name(f".{path.name}.part")
    try:
        temporary.write_text(text, encoding="ascii")
        temporary.replace(path)
    except OSError as error:
        temporary.unlink(missing_ok=True)
        raise OutputError(f"{path}: the file cannot be written ({error.strerror or error}); check the folder") from None
