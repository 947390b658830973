"""`TruePath`: where a simulated robot truly is, as a TUM file that grows."""

from contextlib import AbstractContextManager
from pathlib import Path
from types import TracebackType

from ial.datasets.trajectory import tum_line
from ial.pose import Pose


class TruePath(AbstractContextManager["TruePath"]):
    """``truth.tum``: ``T_map_base`` at each scan.

    Parameters
    ----------
    path
        The file.
    """

    def __init__(self, path: Path) -> None:
        self._file = path.open("w", encoding="utf-8")
        self._last: tuple[int, Pose] | None = None

    def __repr__(self) -> str:
        return f"<TruePath: {self._file.name}>"

    def add(self, stamp_ns: int, pose: Pose) -> None:
        """Write the pose at a time, in nanoseconds."""
        self._file.write(tum_line(stamp_ns, pose))
        self._last = stamp_ns, pose

    def at(self, stamp_ns: int) -> Pose | None:
        """Return the pose that was written last, if that was of this time; else None."""
        return self._last[1] if self._last is not None and self._last[0] == stamp_ns else None

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self._file.close()
