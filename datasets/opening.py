"""`open_recording`: chooses the reader by what the file holds, not by its name."""

from collections.abc import Sequence
from itertools import islice
from pathlib import Path

from ial.datasets.recording import Recording
from ial.datasets.text_log import lines
from ial.errors import RecordingError
from ial.pose import Pose

_ROS_MAGIC = (b"#ROSBAG V2.0", b"SQLite format 3\x00", b"\x89MCAP0\r\n")
_CARMEN = (b"FLASER", b"ROBOTLASER1", b"ODOM", b"PARAM", b"RLASER", b"SYNC", b"NEFF", b"TRUEPOS")
_BEESOFT = (b"L", b"O")
_LINES_TRIED = 100
_LINE_LIMIT = 2**20
_KNOWN = "a ROS 1 .bag, a ROS 2 folder, .db3 or .mcap, a CARMEN log (plain or .gz), a log of L and O lines, or JSON lines"


def open_recording(
    path: str | Path, scan_topics: Sequence[str] = (), odom_topic: str | None = None, laser_pose: Pose | None = None
) -> Recording:
    """Open a recording of any known format.

    The file is recognized by its first bytes. Topics are chosen when the recording is read, so `info` also works where a choice is needed.

    Parameters
    ----------
    path
        A ROS 1 ``.bag``; a ROS 2 bag folder, ``.db3`` or ``.mcap``; a CARMEN log, a log of L and O lines, or JSON lines, plain or gzip.
    scan_topics
        The topics of the scans; needed only if there are several. Several of them are several lidars of one robot, whose scans follow one
        another by their stamps.
    odom_topic
        The topic of the odometry (``/tf`` takes it from tf); needed only if there are several.
    laser_pose
        ``T_base_laser``, in place of what the recording says.

    Raises
    ------
    RecordingError
        If there is no such file or its kind is not known.
    """
    path = Path(path)
    try:
        if path.is_dir():
            return _open_folder(path, scan_topics, odom_topic, laser_pose)
        with path.open("rb") as file:
            head = file.read(16)
    except FileNotFoundError:
        raise RecordingError(f"{path}: there is no such file or folder; check the path of the recording") from None
    except OSError as error:
        raise RecordingError(f"{path}: cannot be read ({error.strerror or error})") from None
    if not head:
        raise RecordingError(f"{path}: the file is empty; copy the recording again")
    if head.startswith(_ROS_MAGIC):
        return _open_ros(path, scan_topics, odom_topic, laser_pose)
    return _open_text(path, scan_topics, laser_pose)


def _open_ros(path: Path, scan_topics: Sequence[str], odom_topic: str | None, laser_pose: Pose | None) -> Recording:
    from ial.datasets.ros import RosBag  # rosbags is slow to import

    return RosBag(path, scan_topics, odom_topic, laser_pose)


def _open_folder(path: Path, scan_topics: Sequence[str], odom_topic: str | None, laser_pose: Pose | None) -> Recording:
    if (path / "metadata.yaml").exists():
        return _open_ros(path, scan_topics, odom_topic, laser_pose)
    if any(file.suffix in (".db3", ".mcap") for file in path.iterdir()):
        raise RecordingError(
            f"{path}: a ROS 2 bag without metadata.yaml; run `ros2 bag reindex {path}`, or give the .db3 or .mcap file itself"
        )
    raise RecordingError(f"{path}: a folder, but not a ROS 2 bag (no metadata.yaml); give {_KNOWN}")


def _open_text(path: Path, scan_topics: Sequence[str], laser_pose: Pose | None) -> Recording:
    from ial.datasets.beesoft import BeesoftLog
    from ial.datasets.carmen import CarmenLog
    from ial.datasets.scan_stream import ScanStream

    for line in islice(lines(path), _LINES_TRIED):
        if b"\x00" in line or len(line) > _LINE_LIMIT:
            break
        if line.lstrip().startswith(b"{"):
            return ScanStream(path, laser_pose=laser_pose)
        keyword = line.split(maxsplit=1)[:1]
        if not keyword or keyword[0].startswith(b"#"):
            continue
        if keyword[0] in _CARMEN:
            return CarmenLog(path, scan_topics, laser_pose)
        if keyword[0] in _BEESOFT:
            return BeesoftLog(path, laser_pose)
        break
    raise RecordingError(f"{path}: not a recording of a known kind; give {_KNOWN}")
