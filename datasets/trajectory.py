"""`Trajectory`: poses over time, read from and written to TUM files."""

import bisect
import math
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt

from ial.datasets.stamps import format_stamp, parse_stamp
from ial.errors import TrajectoryError
from ial.pose import Pose, wrap
from ial.whole_file import whole_files

MAX_GAP_NS = 500_000_000  # guarantee.md: interpolated when both neighbours are at most 0.5 s away


@dataclass(frozen=True, eq=False)
class Trajectory:
    """Poses at increasing times.

    Parameters
    ----------
    stamps_ns
        Times in nanoseconds, strictly increasing, int64 of shape (n,).
    poses
        Rows (x, y, theta) in metres and radians, float64 of shape (n, 3).

    Raises
    ------
    TrajectoryError
        If the stamps do not increase, a pose is not finite, or the shapes do not fit.
    """

    stamps_ns: npt.NDArray[np.int64]
    poses: npt.NDArray[np.float64]

    def __post_init__(self) -> None:
        stamps = np.array(self.stamps_ns, dtype=np.int64)
        poses = np.array(self.poses, dtype=np.float64).reshape(-1, 3)
        if stamps.shape != (len(poses),):
            raise TrajectoryError(f"{stamps.size} stamps for {len(poses)} poses; give one for each")
        if not (stamps[1:] > stamps[:-1]).all():
            row = int(np.argmin(stamps[1:] > stamps[:-1])) + 1
            raise TrajectoryError(
                f"stamp {format_stamp(int(stamps[row]))} of pose {row} does not come after the one before; sort the poses by time"
            )
        if not np.isfinite(poses).all():
            raise TrajectoryError(f"pose {int(np.argmin(np.isfinite(poses).all(axis=1)))} is not finite; remove it")
        for name, array in (("stamps_ns", stamps), ("poses", poses)):
            array.setflags(write=False)
            object.__setattr__(self, name, array)

    def __repr__(self) -> str:
        span = f", {(int(self.stamps_ns[-1]) - int(self.stamps_ns[0])) / 1e9:.2f} s" if len(self) else ""
        return f"<Trajectory of {len(self)} poses{span}>"

    @classmethod
    def of(cls, samples: Iterable[tuple[int, Pose]]) -> "Trajectory":
        """Return the trajectory of (stamp in nanoseconds, pose) pairs."""
        pairs = list(samples)
        return cls(np.array([stamp for stamp, _ in pairs], dtype=np.int64), np.array([(pose.x, pose.y, pose.theta) for _, pose in pairs]))

    def __len__(self) -> int:
        return len(self.stamps_ns)

    def __getitem__(self, row: int) -> Pose:
        x, y, theta = self.poses[row].tolist()
        return Pose(x, y, theta)

    def at(self, stamp_ns: int) -> Pose | None:
        """Return the pose at a time: the one with exactly this stamp, or linear between two neighbours at most 0.5 s away, or None.

        The heading turns the shorter way.
        """
        after = bisect.bisect_left(self.stamps_ns, stamp_ns)
        if after < len(self) and self.stamps_ns[after] == stamp_ns:
            return self[after]
        if after in (0, len(self)):
            return None
        before = after - 1
        since, until = stamp_ns - int(self.stamps_ns[before]), int(self.stamps_ns[after]) - stamp_ns
        if max(since, until) > MAX_GAP_NS:
            return None
        return interpolate(self[before], self[after], since / (since + until))


def interpolate(start: Pose, end: Pose, share: float) -> Pose:
    """Return the pose a share of the way from start to end: straight in position, the shorter way in heading."""
    turn = math.remainder(end.theta - start.theta, 2.0 * math.pi)
    return Pose(start.x + share * (end.x - start.x), start.y + share * (end.y - start.y), wrap(start.theta + share * turn))


def read_tum(path: str | Path) -> Trajectory:
    """Read ``stamp x y z qx qy qz qw`` lines: seconds, metres, a quaternion; ``#`` starts a comment.

    Stamps keep every nanosecond. Poses are projected to the plane: z is dropped and the quaternion must be a turn about z.

    Raises
    ------
    TrajectoryError
        If the file cannot be read, a line has another form, or the stamps do not increase; the text gives the line.
    """
    path = Path(path)
    samples = []
    try:
        with path.open(encoding="utf-8") as file:
            for number, line in enumerate(file, start=1):
                words = line.split("#", 1)[0].replace(",", " ").split()
                if words:
                    samples.append(_parse(path, number, words))
                    if len(samples) > 1 and samples[-1][0] <= samples[-2][0]:
                        raise TrajectoryError(
                            f"{path}, line {number}: stamp {words[0]} does not come after the one before; sort the lines by time"
                        )
    except OSError as error:
        raise TrajectoryError(f"{path}: cannot be read ({error.strerror or error}); check the path") from None
    except UnicodeDecodeError:
        raise TrajectoryError(f"{path}: not a text file; give a TUM trajectory of lines `stamp x y z qx qy qz qw`") from None
    if not samples:
        raise TrajectoryError(f"{path}: holds no pose; give a TUM trajectory of lines `stamp x y z qx qy qz qw`")
    return Trajectory.of(samples)


def _parse(path: Path, number: int, words: list[str]) -> tuple[int, Pose]:
    try:
        if len(words) != 8:
            raise ValueError(f"{len(words)} words")
        stamp = parse_stamp(words[0])
        x, y, _, qx, qy, qz, qw = values = [float(word) for word in words[1:]]
        if not all(map(math.isfinite, values)) or (qz, qw) == (0.0, 0.0):
            raise ValueError("a number that is not finite, or no rotation about z")
    except ValueError as error:
        raise TrajectoryError(f"{path}, line {number}: {error}; a line must be `stamp x y z qx qy qz qw`, in seconds and metres") from None
    if math.hypot(qx, qy) > 0.1 * math.hypot(qz, qw):
        raise TrajectoryError(
            f"{path}, line {number}: the rotation is tilted out of the plane; project the trajectory to x, y and yaw first"
        )
    return stamp, Pose.from_quaternion(x, y, qz, qw)


def tum_line(stamp_ns: int, pose: Pose) -> str:
    """Return the line of one pose, with its end: the stamp exact to the nanosecond and the rest to the last bit."""
    z, w = pose.quaternion()
    return f"{format_stamp(stamp_ns)} {pose.x!r} {pose.y!r} 0 0 0 {z!r} {w!r}\n"


def write_tum(trajectory: Trajectory, path: str | Path) -> None:
    """Write ``stamp x y z qx qy qz qw`` lines, the stamp exact to the nanosecond and the rest to the last bit.

    The file appears when it is complete.

    Raises
    ------
    OutputError
        If the file cannot be written.
    """
    with whole_files(path, what="the trajectory") as (lent,), lent.open("w", encoding="utf-8") as file:
        for row, stamp in enumerate(trajectory.stamps_ns.tolist()):
            file.write(tum_line(stamp, trajectory[row]))
